// Recovery as a rocketry team types it: pounds and feet in, both units out.
#include <gtest/gtest.h>

#include "program.h"
#include "ripstop/core/file.h"

namespace ripstop {
namespace {

std::vector<std::string> recovery(const TemporaryFolder& folder, std::vector<std::string> more) {
  std::vector<std::string> all = {
      "recovery", examples + "flat-circular/case.toml", "--set",    "parachute.nominal_diameter_m=3.5",
      "--set",    "parachute.vent_diameter_m=0.35",     "--set",    "parachute.lines.length_m=4",
      "--drogue", examples + "flat-circular/case.toml", "--apogee", "10000 ft",
      "--out",    (folder.path / "out").string()};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

TEST(RecoveryCommand, PrintsBothUnitsAndWritesFilesInSi) {
  const TemporaryFolder folder("recovery");
  const Finished run = ripstop_with(recovery(folder, {"--mass", "48.5 lb", "--units", "us"}));
  EXPECT_EQ(run.code, 0) << run.output;
  for (const char* text :
       {"apogee 3048 m (10000 ft)", "22 kg (48.5 lb)", " J (", " ft lbf)", " lbf)", " ft/s)"})
    EXPECT_NE(run.output.find(text), std::string::npos) << text << "\n" << run.output;
  const Finished si = ripstop_with(recovery(folder, {"--mass", "22"}));
  EXPECT_EQ(si.output.find("lbf"), std::string::npos) << si.output;
  for (const char* file : {"result.json", "trajectory.csv", "height.png", "speed.png", "report.html"})
    EXPECT_TRUE(std::filesystem::exists(folder.path / "out" / file)) << file;
}

TEST(RecoveryCommand, RefusesAUnitOfAnotherQuantityAndAnUnknownChoiceOfUnits) {
  const TemporaryFolder folder("recovery");
  const Finished wrong = ripstop_with(recovery(folder, {"--mass", "48.5 ft"}));
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(
      wrong.output.find("--mass = 48.5 ft: must be a number, or one with a unit that can be converted to kg"),
      std::string::npos)
      << wrong.output;
  EXPECT_EQ(ripstop_with(recovery(folder, {"--mass", "22", "--units", "imperial"})).code, 2);
}

TEST(RecoveryCommand, RefusesAHeightOfTheMainWithoutADrogue) {
  const Finished run = ripstop_with({"recovery", examples + "flat-circular/case.toml", "--mass", "5",
                                     "--apogee", "1000", "--main-height", "300"});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.output.find("--main-height"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("--drogue"), std::string::npos) << run.output;
}

TEST(LoadCommand, NeedsASpeedOrFindsTheFastestOne) {
  const std::string circular = examples + "flat-circular/case.toml";
  const Finished none = ripstop_with({"load", circular, "--mass", "5"});
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.output.find("--fastest"), std::string::npos) << none.output;
  const TemporaryFolder folder("fastest");
  const Finished fastest =
      ripstop_with({"load", circular, "--mass", "5", "--fastest", "--out", (folder.path / "out").string()});
  EXPECT_EQ(fastest.code, 0) << fastest.output;
  for (const char* text : {"FASTEST SAFE DEPLOYMENT", "USE ", "the lower end for infinite mass"})
    EXPECT_NE(fastest.output.find(text), std::string::npos) << text << "\n" << fastest.output;
}

}  // namespace
}  // namespace ripstop
