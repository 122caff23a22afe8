// Small valid cases as text, and ways to spoil them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/case/resolve.h"

namespace ripstop {

// Line numbers of the keys are given next to them, because tests use them.
inline const std::string valid_case =
    R"(title = "small"
[parachute]
type = "disk-gap-band"
disk_diameter_m = 1.0
vent_diameter_m = 0.09
gap_height_m = 0.07
band_height_m = 0.3
gores = 6
[parachute.lines]
count = 18
length_m = 1.5
[parachute.mesh]
cloth_nodes = 2000
[flow]
speed_m_s = 20
box_m = [2, 2, 4]
cells = [20, 20, 30]
[[measured]]
nominal_speed_m_s = 20
measured_speed_m_s = 21
density_kg_m3 = 1.199
)";

inline const std::filesystem::path examples = std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples";

/// Origin of the value of a key.
inline const std::string& source_of(const Settings& resolved, const std::string& key) {
  return resolved.source(key).from;
}

/// Only the required keys.
inline const std::string short_case = R"(
[parachute]
type = "flat-circular"
nominal_diameter_m = 3.0
vent_diameter_m = 0.3
gores = 12
lines = { count = 12, length_m = 3.0 }
[flow]
speed_m_s = 8
density_kg_m3 = 1.2
)";

/// `text` with its only occurrence of `from` replaced.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from << " is not in the text";
  if (at == std::string::npos) return text;
  EXPECT_EQ(text.find(from, at + 1), std::string::npos) << from << " stands twice in the text";
  return text.replace(at, from.size(), to);
}

struct Outcome {
  bool valid = false;
  ExitCode code = ExitCode::done;
  std::string message;
  std::vector<Problem> problems;
};

inline Outcome outcome_of(const std::string& text, const Overrides& overrides = {}) {
  try {
    parse_case(text, "case.toml", overrides);
    return {true, ExitCode::done, "", {}};
  } catch (const InputError& error) {
    return {false, error.code(), error.what(), error.problems()};
  }
}

}  // namespace ripstop
