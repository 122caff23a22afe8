#include "ripstop/run/warnings.h"

#include <gtest/gtest.h>

#include "ripstop/case/case.h"

namespace ripstop {
namespace {

TEST(Warnings, ClothBeyondItsTestedStrainIsWarnedOfLinesAreNotByTheCloths) {
  Case given = read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml");
  Fabric cloth = canopy_fabric(given);
  cloth.tested_strain = 0.2;
  given.materials.insert_or_assign(given.parachute.canopy_material, cloth);
  const std::size_t before = strain_warnings(given, 0.19).size();
  const std::vector<std::string> beyond = strain_warnings(given, 0.21);
  ASSERT_EQ(beyond.size(), before + 1);
  int told = 0;
  for (const std::string& warning : beyond)
    told += warning.find(cloth.name + ": strain 0.21") != std::string::npos;
  EXPECT_EQ(told, 1);
  EXPECT_EQ(warnings_of(given, 0.21).size(), case_warnings(given).size() + beyond.size());
}

}  // namespace
}  // namespace ripstop
