// The table of the material library as it is printed.
#include <gtest/gtest.h>

#include "program.h"

namespace ripstop {
namespace {

void expect_all(const Finished& run, std::initializer_list<const char*> texts) {
  EXPECT_EQ(run.code, 0) << run.output;
  for (const char* text : texts)
    EXPECT_NE(run.output.find(text), std::string::npos) << text << "\n" << run.output;
}

TEST(MaterialsCommand, ListsNamesForEachKeyWithMassStrengthAirAndSource) {
  const Finished all = ripstop_with({"materials"});
  expect_all(all, {"parachute.canopy_material", "parachute.lines.material", "parachute.tape.material",
                   "f-111-physical", "0.0407 kg/m2", "7881 N/m", "CFM/ft2", "spectra-line", "2 g/m", "3180 N",
                   "PIA-C-44378D"});
  EXPECT_EQ(ripstop_with({"materials", "--kind", "cloth"}).output,
            ripstop_with({"materials", "--kind", "fabric"}).output);
  const Finished lines = ripstop_with({"materials", "--kind", "line", "--units", "us"});
  expect_all(lines, {"3180 N (714.9 lbf)", "2 g/m (1.34 lb/1000 ft)"});
  EXPECT_EQ(lines.output.find("f-111"), std::string::npos) << lines.output;
}

TEST(MaterialsCommand, PrintsOneWithItsCurveAndItsFile) {
  expect_all(
      ripstop_with({"materials", "mil-c-7020-type-iii", "--units", "us"}),
      {"load along warp", "lbf/in)", "1000 Pa", "kind = \"fabric\"", "materials/mil-c-7020-type-iii.toml"});
  expect_all(ripstop_with({"materials", "spectra-line"}), {"tension", "breaking load", "Deep mooring paper"});
  const Finished unknown = ripstop_with({"materials", "spectra"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.output.find("did you mean"), std::string::npos) << unknown.output;
}

}  // namespace
}  // namespace ripstop
