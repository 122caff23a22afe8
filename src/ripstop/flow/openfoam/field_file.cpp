#include "ripstop/flow/openfoam/field_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"

namespace ripstop::inline flow::openfoam {
namespace {

/// Walks through one OpenFOAM file: tokens are words, numbers and single punctuation characters; binary
/// blocks are taken by their length.
class Cursor {
 public:
  explicit Cursor(const std::filesystem::path& path) : path_(path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error))
      throw Error(ExitCode::io, fmt::format("OpenFOAM's file {} is missing", path.string()));
    text_ = read_file(path);
    read_header();
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ExitCode::io,
                fmt::format("OpenFOAM's file {}: {} (near byte {} of {}); a full disk or a killed "
                            "solver leaves such files",
                            path_.string(), what, at_, text_.size()));
  }

  /// Empty at the end of the file.
  std::string next() {
    skip_blank();
    if (at_ >= text_.size()) return {};
    const std::size_t begin = at_;
    if (is_mark(text_[at_])) return text_.substr(at_++, 1);
    while (at_ < text_.size() && !is_mark(text_[at_]) &&
           !std::isspace(static_cast<unsigned char>(text_[at_])))
      ++at_;
    return text_.substr(begin, at_ - begin);
  }
  std::string peek() {
    const std::size_t here = at_;
    std::string token = next();
    at_ = here;
    return token;
  }
  void expect(const char* token) {
    const std::string found = next();
    if (found != token) fail(fmt::format("'{}' instead of '{}'", found, token));
  }
  double number() {
    const std::string token = next();
    char* end = nullptr;
    const double value = std::strtod(token.c_str(), &end);
    if (token.empty() || *end != '\0') fail(fmt::format("'{}' is not a number", token));
    return value;
  }
  std::size_t size() {
    const double value = number();
    if (!(value >= 0 && value < 4e9)) fail("a list has no valid length");
    return static_cast<std::size_t>(value);
  }
  /// A length that was damaged is noticed before so much is allocated: a number in text takes two characters.
  void require_room(std::size_t count, std::size_t bytes) const {
    if (count > (text_.size() - std::min(at_, text_.size())) / (binary_ ? bytes : 2))
      fail(fmt::format("a list of {} numbers is longer than the rest of the file", count));
  }

  /// A whole number as OpenFOAM's labels are: 32 bits.
  int label() {
    const double value = number();
    constexpr double most = std::numeric_limits<int>::max();
    if (!(std::abs(value) <= most) || value != std::floor(value))
      fail("a label is not an integer of 32 bits");
    return static_cast<int>(value);
  }
  /// To the end of this entry, over nested braces and brackets. Only for entries without binary blocks.
  void skip_entry() {
    for (int depth = 0;;) {
      const std::string token = next();
      if (token.empty()) fail("ends too early");
      if (token == "(" || token == "{" || token == "[") ++depth;
      if (token == ")" || token == "}" || token == "]") --depth;
      if (depth == 0 && (token == ";" || token == "}")) return;
    }
  }

  /// "List<bool> n(...);" with a byte a flag in binary, or "List<bool> n{flag};".
  void skip_flags() {
    expect("List<bool>");
    const std::size_t count = size();
    if (binary_ && peek() == "(") {
      next();
      if (count > text_.size() - at_) fail("flags are missing");
      at_ += count;
      expect(")");
      expect(";");
    } else {
      const bool uniform = peek() == "{";
      skip_entry();
      if (uniform) expect(";");
    }
  }

  /// count values of `components` numbers: "(binary block)" or ASCII.
  std::vector<double> numbers(std::size_t count, int components) {
    require_room(count * static_cast<std::size_t>(components), sizeof(double));
    std::vector<double> values(count * static_cast<std::size_t>(components));
    if (values.empty()) {
      if (peek() == "(") next(), expect(")");
      return values;
    }
    expect("(");
    if (binary_) {
      block(values.data(), values.size() * sizeof(double));
    } else {
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (components > 1 && i % components == 0) expect("(");
        values[i] = number();
        if (components > 1 && (i + 1) % components == 0) expect(")");
      }
    }
    expect(")");
    return values;
  }
  std::vector<int> labels(std::size_t count) {
    require_room(count, sizeof(int));
    std::vector<int> values(count);
    if (values.empty()) return values;
    expect("(");
    if (binary_) {
      static_assert(sizeof(int) == sizeof(std::int32_t));
      block(values.data(), values.size() * sizeof(int));
    } else {
      for (int& value : values) value = label();
    }
    expect(")");
    return values;
  }

 private:
  static bool is_mark(char c) { return std::strchr("(){}[];", c) != nullptr && c != '\0'; }

  void skip_blank() {
    while (at_ < text_.size()) {
      if (std::isspace(static_cast<unsigned char>(text_[at_]))) {
        ++at_;
      } else if (text_.compare(at_, 2, "//") == 0) {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (text_.compare(at_, 2, "/*") == 0) {
        const std::size_t end = text_.find("*/", at_);
        at_ = end == std::string::npos ? text_.size() : end + 2;
      } else {
        return;
      }
    }
  }

  void block(void* into, std::size_t bytes) {
    if (bytes > text_.size() - at_)
      fail(fmt::format("{} bytes of data are missing", bytes - (text_.size() - at_)));
    std::memcpy(into, text_.data() + at_, bytes);
    at_ += bytes;
  }

  void read_header() {
    if (next() != "FoamFile") fail("has no OpenFOAM header");
    expect("{");
    for (std::string key = next(); key != "}"; key = next()) {
      if (key.empty()) fail("ends within its header");
      std::string value;
      for (std::string token = next(); token != ";"; token = next()) {
        if (token.empty()) fail("ends within its header");
        value += token + " ";
      }
      if (key == "format") binary_ = value.starts_with("binary");
      if (key == "arch") check_arch();
    }
  }

  /// The arch entry is a quoted string with ';' in it ("LSB;label=32;scalar=64"), so it
  /// is looked for as text.
  void check_arch() {
    const std::size_t end = text_.find('}');
    const std::string header = text_.substr(0, end);
    if (header.find("LSB") == std::string::npos || header.find("label=32") == std::string::npos ||
        header.find("scalar=64") == std::string::npos) {
      fail("was written with other number formats than little-endian, 32-bit labels and double precision");
    }
    at_ = end;
  }

  std::filesystem::path path_;
  std::string text_;
  std::size_t at_ = 0;
  bool binary_ = false;
};

/// "uniform v;", "nonuniform List<type> n (...);", "nonuniform 0();".
std::vector<double> read_values(Cursor& file, int components) {
  const std::string kind = file.next();
  std::vector<double> values;
  if (kind == "uniform") {
    if (components > 1) file.expect("(");
    for (int i = 0; i < components; ++i) values.push_back(file.number());
    if (components > 1) file.expect(")");
  } else if (kind == "nonuniform") {
    if (file.peek().starts_with("List<")) file.next();
    values = file.numbers(file.size(), components);
  } else {
    file.fail(fmt::format("'{}' is neither uniform nor nonuniform", kind));
  }
  file.expect(";");
  return values;
}

}  // namespace

FieldData read_field(const std::filesystem::path& path, int components, std::size_t count) {
  Cursor file(path);
  FieldData field;
  field.components = components;
  bool inner = false, faces = false;
  for (std::string key = file.next(); !key.empty(); key = file.next()) {
    if (key == "internalField") {
      field.inner = read_values(file, components);
      inner = true;
    } else if (key == "boundaryField") {
      file.expect("{");
      for (std::string patch = file.next(); patch != "}"; patch = file.next()) {
        if (patch.empty()) file.fail("ends within its boundary");
        file.expect("{");
        for (std::string entry = file.next(); entry != "}"; entry = file.next()) {
          if (entry.empty()) file.fail("ends within its boundary");
          const std::string kind = file.peek();
          if (kind == "uniform" || kind == "nonuniform") {
            std::vector<double> values = read_values(file, components);
            if (entry == "value") field.patches[patch] = std::move(values);
          } else {
            file.skip_entry();
          }
        }
      }
      faces = true;
    } else {
      file.skip_entry();
    }
  }
  if (!inner || !faces) file.fail("has no internalField or no boundaryField");
  const std::size_t numbers = field.inner.size() / static_cast<std::size_t>(components);
  if (numbers != count && numbers != 1) {
    file.fail(fmt::format("contains {} values, but the mesh has {}", numbers, count));
  }
  return field;
}

std::vector<int> read_labels(const std::filesystem::path& path) {
  Cursor file(path);
  const std::size_t count = file.size();
  return file.labels(count);
}

std::vector<Vec3> read_points(const std::filesystem::path& path) {
  Cursor file(path);
  const std::size_t count = file.size();
  const std::vector<double> numbers = file.numbers(count, 3);
  std::vector<Vec3> points(count);
  for (std::size_t n = 0; n < count; ++n)
    points[n] = {numbers[3 * n], numbers[3 * n + 1], numbers[3 * n + 2]};
  return points;
}

FaceList read_faces(const std::filesystem::path& path) {
  Cursor file(path);
  FaceList faces;
  const std::size_t begins = file.size();
  faces.begins = file.labels(begins);
  const std::size_t corners = file.size();
  faces.corners = file.labels(corners);
  bool ordered = !faces.begins.empty() && faces.begins.front() == 0;
  for (std::size_t n = 1; n < faces.begins.size(); ++n)
    ordered = ordered && faces.begins[n] >= 3 && faces.begins[n] - 3 >= faces.begins[n - 1];
  if (!ordered || static_cast<std::size_t>(faces.begins.back()) != corners)
    file.fail("the number of corners of the faces differs from the stated one");
  return faces;
}

std::vector<FaceZone> read_face_zones(const std::filesystem::path& path) {
  Cursor file(path);
  const std::size_t count = file.size();
  file.require_room(count, 1);
  std::vector<FaceZone> zones(count);
  if (count == 0) return zones;
  file.expect("(");
  for (FaceZone& zone : zones) {
    zone.name = file.next();
    file.expect("{");
    for (std::string key = file.next(); key != "}"; key = file.next()) {
      if (key.empty()) file.fail("ends within a zone");
      if (key == "faceLabels") {
        file.expect("List<label>");
        const std::size_t faces = file.size();
        zone.faces = file.labels(faces);
        file.expect(";");
      } else if (key == "flipMap") {
        file.skip_flags();
      } else {
        file.skip_entry();
      }
    }
  }
  return zones;
}

std::vector<Patch> read_boundary(const std::filesystem::path& path) {
  Cursor file(path);
  const std::size_t count = file.size();
  file.require_room(count, 1);
  std::vector<Patch> patches(count);
  file.expect("(");
  for (Patch& patch : patches) {
    patch.name = file.next();
    file.expect("{");
    for (std::string key = file.next(); key != "}"; key = file.next()) {
      if (key.empty()) file.fail("ends within a patch");
      if (key == "nFaces" || key == "startFace") {
        (key == "nFaces" ? patch.faces : patch.start) = file.label();
        file.expect(";");
      } else {
        file.skip_entry();
      }
    }
  }
  return patches;
}

}  // namespace ripstop::inline flow::openfoam
