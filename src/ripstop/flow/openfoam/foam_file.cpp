#include "ripstop/flow/openfoam/foam_file.h"

#include <fmt/format.h>

#include <bit>

namespace ripstop::inline flow::openfoam {
namespace {

static_assert(std::endian::native == std::endian::little && sizeof(int) == 4 && sizeof(double) == 8);

template <class T>
std::string list(const std::vector<T>& values, std::size_t count) {
  std::string text = fmt::format("{}\n(", count);
  text.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  return text + ")\n";
}

}  // namespace

std::string foam_header(const std::string& kind, const std::string& object, const std::string& format,
                        const std::string& note) {
  return fmt::format(
      "// Written by Ripstop; manual changes are lost at the next solution.\n"
      "FoamFile\n{{\n    version 2.0;\n    format {};\n{}{}    class {};\n    object {};\n}}\n\n",
      format, format == "binary" ? "    arch \"LSB;label=32;scalar=64\";\n" : "",
      note.empty() ? "" : fmt::format("    note \"{}\";\n", note), kind, object);
}

std::string binary_list(const std::vector<int>& labels) {
  return list(labels, labels.size());
}

std::string binary_list(const std::vector<double>& numbers, int components) {
  return list(numbers, numbers.size() / static_cast<std::size_t>(components));
}

}  // namespace ripstop::inline flow::openfoam
