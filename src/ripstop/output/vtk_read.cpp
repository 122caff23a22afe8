#include "ripstop/output/vtk_read.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"

namespace ripstop::inline output {
namespace {

using Path = std::filesystem::path;

[[noreturn]] void reject(const Path& path, const std::string& reason) {
  throw Error(ExitCode::bad_data, fmt::format("{}: {}; write it again with --fresh", path.string(), reason));
}

/// The value of `name="..."` within one element.
std::string_view attribute(std::string_view element, std::string_view name) {
  const std::string start = fmt::format(" {}=\"", name);
  const std::size_t at = element.find(start);
  if (at == std::string_view::npos) return {};
  const std::size_t begin = at + start.size();
  return element.substr(begin, element.find('"', begin) - begin);
}

std::vector<double> numbers(std::string_view text) {
  std::vector<double> values;
  const char* at = text.data();
  const char* end = at + text.size();
  while (at < end) {
    double value = 0;
    const auto [stop, error] = std::from_chars(at, end, value);
    if (error == std::errc()) values.push_back(value);
    at = error == std::errc() ? stop : at + 1;
  }
  return values;
}

std::uint64_t word(const Path& path, std::string_view data, std::size_t at) {
  if (data.size() < 8 || at > data.size() - 8) reject(path, "is incomplete");
  std::uint64_t value = 0;
  std::memcpy(&value, data.data() + at, sizeof value);
  return value;
}

/// [#blocks][block size][size of a last, partial block or 0][compressed sizes...][blocks...]
std::string inflate(const Path& path, std::string_view data, std::size_t at) {
  const std::uint64_t blocks = word(path, data, at), block = word(path, data, at + 8),
                      rest = word(path, data, at + 16);
  if (blocks > data.size() / 8 || block > (1U << 24) || rest > block) reject(path, "has damaged data");
  std::string bytes;
  std::size_t from = at + 24 + 8 * blocks;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    const std::uint64_t packed = word(path, data, at + 24 + 8 * b);
    if (from > data.size() || packed > data.size() - from) reject(path, "is incomplete");
    uLongf size = b + 1 == blocks && rest > 0 ? rest : block;
    const std::size_t done = bytes.size();
    bytes.resize(done + size);
    if (uncompress(reinterpret_cast<Bytef*>(bytes.data() + done), &size,
                   reinterpret_cast<const Bytef*>(data.data() + from), packed) != Z_OK ||
        done + size != bytes.size())
      reject(path, "has damaged data");
    from += packed;
  }
  return bytes;
}

template <class T>
std::vector<double> as_doubles(const std::string& bytes) {
  std::vector<double> values(bytes.size() / sizeof(T));
  for (std::size_t i = 0; i < values.size(); ++i) {
    T value;
    std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
    values[i] = static_cast<double>(value);
  }
  return values;
}

std::vector<double> decoded(const Path& path, std::string_view type, const std::string& bytes) {
  if (type == "Float64") return as_doubles<double>(bytes);
  if (type == "Float32") return as_doubles<float>(bytes);
  if (type == "Int32") return as_doubles<std::int32_t>(bytes);
  if (type == "Int64") return as_doubles<std::int64_t>(bytes);
  if (type == "UInt8") return as_doubles<std::uint8_t>(bytes);
  reject(path, fmt::format("has an array of the unknown type {}", type));
}

/// A whole number of the head, before anything is made of so many.
std::size_t whole(const Path& path, double value, double most) {
  if (!(value >= 0 && value <= most) || value != std::floor(value)) reject(path, "has a damaged header");
  return static_cast<std::size_t>(value);
}

/// Of an ImageData; a RectilinearGrid has them as arrays.
std::array<std::vector<double>, 3> image_edges(const Path& path, std::string_view element) {
  const std::vector<double> extent = numbers(attribute(element, "WholeExtent")),
                            origin = numbers(attribute(element, "Origin")),
                            spacing = numbers(attribute(element, "Spacing"));
  if (extent.size() != 6 || origin.size() != 3 || spacing.size() != 3) reject(path, "has a damaged header");
  std::array<std::vector<double>, 3> edges;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0, end = whole(path, extent[2 * axis + 1], 1e6); i <= end; ++i)
      edges[axis].push_back(origin[axis] + double(i) * spacing[axis]);
  return edges;
}

}  // namespace

const VtkData* VtkFile::find(const std::string& section, const std::string& name) const {
  const auto found = std::find_if(arrays.begin(), arrays.end(), [&](const VtkData& array) {
    return array.section == section && array.name == name;
  });
  return found == arrays.end() ? nullptr : &*found;
}

VtkFile read_vtk(const Path& path) {
  const std::string bytes = read_file(path);
  const std::string_view all = bytes;
  const std::string_view mark = "<AppendedData encoding=\"raw\">\n_";
  const std::size_t raw = all.find(mark);
  if (!all.starts_with("<?xml") || raw == std::string_view::npos ||
      all.find("vtkZLibDataCompressor") == std::string_view::npos)
    reject(path, "was not written by Ripstop");
  const std::string_view head = all.substr(0, raw), data = all.substr(raw + mark.size());
  VtkFile file;
  std::string section;
  for (std::size_t at = head.find('<'); at != std::string_view::npos; at = head.find('<', at + 1)) {
    const std::string_view element = head.substr(at, head.find('>', at) - at);
    const std::string name(element.substr(1, element.find_first_of(" />", 1) - 1));
    if (name == "ImageData") file.edges = image_edges(path, element);
    if (name != "DataArray") {
      section = name;
      continue;
    }
    const std::vector<double> where = numbers(attribute(element, "offset"));
    const std::vector<double> components = numbers(attribute(element, "NumberOfComponents"));
    if (where.size() != 1 || components.size() != 1) reject(path, "has a damaged header");
    file.arrays.push_back({section, std::string(attribute(element, "Name")),
                           static_cast<int>(whole(path, components[0], 1000)),
                           decoded(path, attribute(element, "type"),
                                   inflate(path, data, whole(path, where[0], double(data.size()))))});
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (const VtkData* edges = file.find("Coordinates", std::string(1, "xyz"[axis])))
      file.edges[axis] = edges->values;
  return file;
}

}  // namespace ripstop::inline output
