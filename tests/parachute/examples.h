// The examples of the canopy families: one of every family in the program's list.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/case/case.h"

namespace ripstop {

inline std::vector<std::string> family_examples() {
  std::vector<std::string> names;
  for (const CanopyFamily* family : families()) names.emplace_back(family->example);
  names.emplace_back("quarter-spherical");  // a second shape of the spherical ones
  return names;
}

inline std::string name_of_example(const testing::TestParamInfo<std::string>& example) {
  std::string name = example.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

inline Case example(const std::string& name, int cloth_nodes = 0) {
  Case given = read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples" / name / "case.toml");
  if (cloth_nodes > 0) given.parachute.mesh.cloth_nodes = cloth_nodes;
  return given;
}

}  // namespace ripstop
