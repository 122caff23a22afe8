#include "ripstop/flow/stl.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <locale>
#include <sstream>
#include <string>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"

namespace ripstop::inline flow {
namespace {

constexpr std::size_t header_size = 80, triangle_size = 50;

void append(std::string& bytes, Vec3 v) {
  const float values[3] = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  bytes.append(reinterpret_cast<const char*>(values), sizeof(values));
}

Vec3 corner(const char* bytes) {
  float values[3];
  std::memcpy(values, bytes, sizeof(values));
  return {values[0], values[1], values[2]};
}

bool fits_single(Vec3 v) {
  constexpr double largest = std::numeric_limits<float>::max();
  return is_finite(v) && std::abs(v.x) <= largest && std::abs(v.y) <= largest && std::abs(v.z) <= largest;
}

}  // namespace

void write_stl(const std::filesystem::path& path, const std::vector<Triangle>& surface) {
  std::string bytes = "Ripstop surface, metres";  // must not start with "solid", which means text
  bytes.resize(header_size, ' ');
  if (surface.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ExitCode::bad_data, fmt::format("{} was not written: too many triangles", path.string()));
  }
  const auto count = static_cast<std::uint32_t>(surface.size());
  bytes.append(reinterpret_cast<const char*>(&count), sizeof(count));
  bytes.reserve(bytes.size() + surface.size() * triangle_size);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const Triangle& triangle = surface[i];
    if (!fits_single(triangle.a) || !fits_single(triangle.b) || !fits_single(triangle.c)) {
      throw Error(ExitCode::bad_data,
                  fmt::format("{} was not written: a corner of triangle {} is not a finite number",
                              path.string(), i));
    }
    const Vec3 normal = cross(triangle.b - triangle.a, triangle.c - triangle.a);
    const double length = norm(normal);
    append(bytes, length > 0 ? normal / length : Vec3{});
    for (Vec3 v : {triangle.a, triangle.b, triangle.c}) append(bytes, v);
    bytes.append(2, '\0');
  }
  write_file(path, bytes);
}

namespace {

/// Of a text STL: its corners in the order of the file; all other words are skipped.
std::vector<Triangle> read_text(const std::string& bytes, const std::filesystem::path& path) {
  std::vector<Vec3> corners;
  std::istringstream text(bytes);
  text.imbue(std::locale::classic());
  for (std::string word; text >> word;) {
    if (word != "vertex") continue;
    Vec3 p;
    if (!(text >> p.x >> p.y >> p.z))
      throw Error(ExitCode::bad_data, fmt::format("{}: corner {} of the text STL is not three numbers",
                                                  path.string(), corners.size() + 1));
    corners.push_back(p);
  }
  if (corners.empty() || corners.size() % 3 != 0)
    throw Error(ExitCode::bad_data,
                fmt::format("{} is a text STL with {} corners, three are needed for each triangle",
                            path.string(), corners.size()));
  std::vector<Triangle> surface;
  for (std::size_t n = 0; n < corners.size(); n += 3)
    surface.push_back({corners[n], corners[n + 1], corners[n + 2]});
  return surface;
}

}  // namespace

std::vector<Triangle> read_stl(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  std::uint32_t count = 0;
  const std::size_t begin = header_size + sizeof(count);
  if (bytes.size() >= begin) std::memcpy(&count, bytes.data() + header_size, sizeof(count));
  if (bytes.size() < begin || bytes.size() != begin + count * triangle_size) {
    if (bytes.starts_with("solid")) return read_text(bytes, path);
    throw Error(ExitCode::bad_data, fmt::format("{} is not a complete binary STL", path.string()));
  }
  if (count == 0) throw Error(ExitCode::bad_data, fmt::format("{} contains no triangle", path.string()));
  std::vector<Triangle> surface(count);
  const char* at = bytes.data() + begin + sizeof(float) * 3;
  for (Triangle& triangle : surface) {
    triangle = {corner(at), corner(at + 12), corner(at + 24)};
    at += triangle_size;
    if (!is_finite(triangle.a) || !is_finite(triangle.b) || !is_finite(triangle.c))
      throw Error(ExitCode::bad_data, fmt::format("{}: a corner of triangle {} is not a finite number",
                                                  path.string(), &triangle - surface.data() + 1));
  }
  return surface;
}

}  // namespace ripstop::inline flow
