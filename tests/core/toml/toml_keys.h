// Tables of keys to read and to write.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/core/toml/fields.h"

namespace ripstop {

struct Height {
  double height = 1;
};
inline void describe(Fields& fields, Height& row) {
  fields.number("height", row.height, Range{}, "");
}

struct PlainKeys {
  std::string text;
  double number = 0.1;
  std::optional<double> absent, given = 2;
  int count = 3;
  bool on = true;
  Vec3 place{1, -2.5, 1e-7};
  std::array<int, 3> cells{4, 5, 6};
  std::vector<double> list{1, 0.25};
};
inline Fields fields_of(PlainKeys& keys) {
  Fields fields;
  fields.text("text", keys.text, 100, "");
  fields.number("number", keys.number, Range{}, "");
  fields.number("absent", keys.absent, Range{}, "");
  fields.number("given", keys.given, Range{}, "");
  fields.integer("count", keys.count, Range{}, "");
  fields.toggle("on", keys.on, "");
  fields.vector("place", keys.place, Range{}, "");
  fields.integers("cells", keys.cells, Range{}, "");
  fields.numbers("list", keys.list, 0, 9, Range{}, "");
  return fields;
}

}  // namespace ripstop
