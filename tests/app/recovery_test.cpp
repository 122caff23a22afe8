// Recovery as a rocketry team types it: pounds and feet in, both units out.
#include <gtest/gtest.h>

#include <regex>

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

TEST(RecoveryCommand, StatesRangesHardwareAndWind) {
  const TemporaryFolder folder("recovery");
  const Finished run =
      ripstop_with(recovery(folder, {"--mass", "22", "--wind", "5", "--set", "flight.wind.exponent=0.14"}));
  EXPECT_EQ(run.code, 0) << run.output;
  for (const char* text : {"\ndrogue: ", "\nmain: ", "range of C_D in descent", "required hardware",
                           "each swivel, link or cord needs a rated load of ",
                           "power law with the exponent 0.14: 11.14 m/s at apogee"})
    EXPECT_NE(run.output.find(text), std::string::npos) << text << "\n" << run.output;
  const std::string page = read_file(folder.path / "out/report.html");
  for (const char* text : {"Stages drogue margins", "Stages main margins"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
}

TEST(RecoveryCommand, RefusesTheFolderOfAnotherCommand) {
  const TemporaryFolder folder("recovery");
  const std::string out = (folder.path / "out").string();
  ASSERT_EQ(ripstop_with({"pattern", examples + "flat-circular/case.toml", "--out", out}).code, 0);
  const std::string before = read_file(folder.path / "out/result.json");
  const Finished run = ripstop_with(recovery(folder, {"--mass", "22"}));
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.output.find("contains results of ripstop pattern"), std::string::npos) << run.output;
  EXPECT_EQ(read_file(folder.path / "out/result.json"), before);
}

TEST(RecoveryCommand, StatesTheReplacedMassTheLoosePackingAndTheSeparation) {
  const TemporaryFolder folder("recovery");
  const Finished run = ripstop_with(
      recovery(folder, {"--mass", "22", "--set", "payload.mass_kg=20", "--bay-diameter", "0.15"}));
  EXPECT_EQ(run.code, 0) << run.output;
  for (const char* text : {"--mass of 22 kg replaces payload.mass_kg = 20 kg of the case",
                           "litres if packed loosely at 250 kg/m3", "F = sqrt(2 E k / L)"})
    EXPECT_NE(run.output.find(text), std::string::npos) << text << "\n" << run.output;
  EXPECT_EQ(run.output.find("drift"), std::string::npos) << run.output;  // no wind is given
  EXPECT_TRUE(std::regex_search(run.output, std::regex("length in the bay +[0-9.]+ m at this density, ")))
      << run.output;
}

TEST(RecoveryCommand, StatesAShortLengthInMillimetres) {
  const TemporaryFolder folder("recovery");
  std::vector<std::string> wide = recovery(folder, {"--mass", "22", "--bay-diameter", "0.5"});
  const Finished run = ripstop_with(wide);
  EXPECT_EQ(run.code, 0) << run.output;
  EXPECT_TRUE(
      std::regex_search(run.output, std::regex("length in the bay +[1-9][0-9.]* mm at this density, ")))
      << run.output;
  wide.insert(wide.end(), {"--units", "us"});
  const Finished us = ripstop_with(wide);
  EXPECT_TRUE(std::regex_search(us.output, std::regex("length in the bay +[0-9.]+ mm \\([0-9.]+ in\\) at")))
      << us.output;
}

// One qualification of every number that follows from the load of a heavy payload.
TEST(RecoveryCommand, QualifiesTheNumbersOfAHeavyPayloadAndTakesAMeasuredLoad) {
  const TemporaryFolder folder("recovery");
  const std::vector<std::string> heavy = recovery(folder, {"--mass", "22"});
  const std::string output = ripstop_with(heavy).output;
  for (const char* row :
       {"margins and hardware", "weakest member", "required hardware", "fastest safe deployment"})
    EXPECT_TRUE(std::regex_search(
        output, std::regex(std::string(row) + ".*the payload is heavy: compute or measure the opening")))
        << row << "\n"
        << output;
  const Finished measured = ripstop_with(
      recovery(folder, {"--mass", "22", "--drogue-measured-load", "500", "--main-measured-load", "5000"}));
  EXPECT_EQ(measured.code, 0) << measured.output;
  EXPECT_EQ(measured.output.find("the payload is heavy"), std::string::npos) << measured.output;
  EXPECT_NE(measured.output.find("not computed: a measured load is that at one speed"), std::string::npos);
}

TEST(SizeCommand, QualifiesTheNumbersOfAHeavyPayload) {
  const TemporaryFolder folder("size-heavy");
  const auto sized = [&](const char* speed, const char* rate, const char* mass) {
    return ripstop_with({"size", "--mass", mass, "--descent-rate", rate, "--deployment-speed", speed,
                         "--force", "--out", (folder.path / "heavy.toml").string()})
        .output;
  };
  const std::string heavy = sized("30", "25", "22"), light = sized("20", "5", "2.4");
  for (const char* row : {"DESIGN LOAD", "weakest member", "\n  tape"})
    EXPECT_TRUE(std::regex_search(
        heavy, std::regex(std::string(row) + ".*the payload is heavy: compute or measure the opening")))
        << row << "\n"
        << heavy;
  EXPECT_EQ(light.find("the payload is heavy"), std::string::npos) << light;
}

TEST(RecoveryCommand, StatesWarningsInBothUnits) {
  const TemporaryFolder folder("recovery");
  const Finished run = ripstop_with(
      recovery(folder, {"--mass", "22", "--units", "us", "--set", "hardware.link.rated_load_n=100"}));
  EXPECT_TRUE(std::regex_search(
      run.output, std::regex("warning: main: link exceeds its allowable load: its load of [0-9.]+ N \\(")))
      << run.output;
}

int count_of(const std::string& part, const std::string& text) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(RecoveryCommand, AdvisesOnceOnTheHeavyPayloadOfSeveralParachutes) {
  const TemporaryFolder folder("recovery");
  const Finished run = ripstop_with(recovery(folder, {"--mass", "300"}));
  EXPECT_EQ(run.code, 0) << run.output;
  for (const char* text :
       {"drogue: the payload is heavy for this canopy (mass ratio R_m = rho (C_D S)^1.5 / m = ",
        "; main: the payload is heavy for this canopy (mass ratio R_m = "})
    EXPECT_EQ(count_of(text, run.output), 1) << text << "\n" << run.output;
  EXPECT_EQ(count_of("Compute the opening: ripstop inflate", run.output), 1) << run.output;
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
  EXPECT_NE(run.output.find("--delay"), std::string::npos) << run.output;
}

TEST(RecoveryCommand, RefusesABayDiameterInInchesWithoutTheirUnit) {
  const TemporaryFolder folder("recovery");
  const Finished run = ripstop_with(recovery(folder, {"--mass", "22", "--bay-diameter", "6"}));
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.output.find("--bay-diameter = 6: must be above 0 and at most 2 m"), std::string::npos)
      << run.output;
}

TEST(RecoveryCommand, RefusesAPartWithTwoStrengths) {
  const TemporaryFolder folder("recovery");
  const Finished run = ripstop_with(recovery(folder, {"--mass", "22", "--set", "hardware.link.rated_load_n=1",
                                                      "--set", "hardware.link.breaking_load_n=2"}));
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.output.find("has breaking_load_n and rated_load_n: give only one of them"), std::string::npos)
      << run.output;
}

// A light payload under a large canopy: the design load is that of infinite mass, although the speed decreases.
TEST(LoadCommand, MarksTheMethodOfTheDesignLoad) {
  const TemporaryFolder folder("load");
  const Finished run = ripstop_with({"load", examples + "flat-circular/case.toml", "--mass", "2.4", "--speed",
                                     "25", "--out", (folder.path / "out").string()});
  EXPECT_EQ(run.code, 0) << run.output;
  EXPECT_TRUE(std::regex_search(run.output, std::regex("\n  infinite mass +[0-9.]+ N +- +design +\\(1\\)")))
      << run.output;
  EXPECT_NE(run.output.find("required hardware"), std::string::npos) << run.output;
}

TEST(LoadCommand, StatesTheFillingConstantBelow46MetresPerSecond) {
  const TemporaryFolder folder("load");
  const auto at = [&](const char* speed, const std::vector<std::string>& more = {}) {
    std::vector<std::string> all = {
        "load",  examples + "flat-circular/case.toml", "--mass", "2.4", "--speed", speed, "--height", "1000",
        "--out", (folder.path / "out").string()};
    all.insert(all.end(), more.begin(), more.end());
    return ripstop_with(all).output;
  };
  const std::string form = "(n = 8 above 46 m/s; below it from t_f = 4.00 D0 / v^0.85 in ft and ft/s)";
  EXPECT_NE(at("25").find("= 7.75 D0 / speed " + form), std::string::npos) << at("25");
  EXPECT_NE(at("40").find("= 8.31 D0 / speed " + form), std::string::npos) << at("40");
  EXPECT_EQ(at("50").find("v^0.85"), std::string::npos) << at("50");
  EXPECT_EQ(at("40", {"--filling-constant", "8"}).find("above 46 m/s"), std::string::npos);
}

TEST(LoadCommand, StatesTheHeightThatIsLostUntilTheSteadyDescent) {
  const TemporaryFolder folder("load");
  const Finished run =
      ripstop_with({"load", examples + "flat-circular/case.toml", "--mass", "2.4", "--speed", "25", "--angle",
                    "0", "--height", "1000", "--out", (folder.path / "out").string()});
  EXPECT_TRUE(std::regex_search(
      run.output, std::regex("the trajectory ends [0-9.]+ s after line stretch, [0-9.]+ m lower\n")))
      << run.output;
}

/// The text after the name of a row.
std::string row_of(const std::string& name, const std::string& output) {
  std::smatch found;
  return std::regex_search(output, found, std::regex("\n  " + name + " +([^\n]*)")) ? found[1].str() : "";
}

/// "+4.02" and the member of "margin of safety +4.02, tape" or "tape: load ...; margin of safety +4.02; ...".
std::string margin_in(const std::string& text) {
  std::smatch found;
  return std::regex_search(text, found, std::regex("margin of safety ([+-][0-9.]+)")) ? found[1].str() : "";
}

// One part has one margin in the summary, that under the highest design load.
TEST(LoadAndSizeCommands, StateOneMarginOfTheWeakestMember) {
  const TemporaryFolder folder("margin");
  const std::string file = (folder.path / "my.toml").string();
  const Finished size = ripstop_with({"size", "--mass", "2.4", "--descent-rate", "5", "--out", file});
  ASSERT_EQ(size.code, 0) << size.output;
  const std::string highest = row_of("highest design load", size.output),
                    weakest = row_of("weakest member", size.output);
  EXPECT_NE(margin_in(highest), "") << size.output;
  EXPECT_EQ(margin_in(weakest), margin_in(highest)) << size.output;
  EXPECT_EQ(weakest.find("under the highest design load, "), 0u) << size.output;
  const Finished load =
      ripstop_with({"load", file, "--speed", "20", "--out", (folder.path / "out").string()});
  ASSERT_EQ(load.code, 0) << load.output;
  const std::string selected = load.output.substr(load.output.find("Select lines"));
  EXPECT_EQ(margin_in(row_of("weakest member", load.output)), margin_in(selected)) << load.output;
  EXPECT_EQ(margin_in(selected), margin_in(highest)) << load.output;
}

// The infinite-mass load has no filling distance, so that it is not in a range for one.
TEST(LoadAndSizeCommands, StateTheRangeOfTheFiniteMassMethodsBelowTheDesignLoad) {
  const TemporaryFolder folder("range");
  // A drogue for which the infinite-mass method applies too.
  const Finished size =
      ripstop_with({"size", "--mass", "22", "--descent-rate", "25", "--height", "1500", "--deployment-speed",
                    "30", "--out", (folder.path / "my.toml").string()});
  ASSERT_EQ(size.code, 0) << size.output;
  std::smatch design, range;
  const std::string load = row_of("DESIGN LOAD", size.output), opening = row_of("opening load", size.output);
  ASSERT_TRUE(std::regex_search(load, design, std::regex("^([0-9.]+) N"))) << size.output;
  ASSERT_TRUE(
      std::regex_search(opening, range, std::regex("^([0-9.]+) to ([0-9.]+) N if the canopy fills over")))
      << size.output;
  EXPECT_LT(std::stod(range[2]), std::stod(design[1])) << size.output;
  EXPECT_NE(opening.find("(finite-mass methods of ripstop load); not for design"), std::string::npos)
      << opening;
}

TEST(PatternCommand, ListsTheCutOfEachPieceAndTheHems) {
  const TemporaryFolder folder("pattern");
  const Finished run =
      ripstop_with({"pattern", examples + "annular/case.toml", "--out", (folder.path / "out").string()});
  EXPECT_EQ(run.code, 0) << run.output;
  // 0.95 m to the confluence and 0.1 m at each end.
  EXPECT_TRUE(std::regex_search(run.output, std::regex("apex line +[a-z0-9-]+ +12 +1\\.150 m")))
      << run.output;
  for (const char* text : {"cut each", "hem, skirt: ", "hem, vent: "})
    EXPECT_NE(run.output.find(text), std::string::npos) << text << "\n" << run.output;
  EXPECT_EQ(read_file(folder.path / "out/bill.csv").find("part,material,count,cut_each,"), 0u);
}

TEST(LoadCommand, NeedsASpeedOrFindsTheFastestOne) {
  const std::string circular = examples + "flat-circular/case.toml";
  const Finished none = ripstop_with({"load", circular, "--mass", "5"});
  EXPECT_EQ(none.code, 2);
  for (const char* remedy : {"--speed", "payload.deployment_speed_m_s", "--fastest"})
    EXPECT_NE(none.output.find(remedy), std::string::npos) << remedy << "\n" << none.output;
  const TemporaryFolder folder("fastest");
  const Finished fastest =
      ripstop_with({"load", circular, "--mass", "5", "--fastest", "--out", (folder.path / "out").string()});
  EXPECT_EQ(fastest.code, 0) << fastest.output;
  const Finished of_case =
      ripstop_with({"load", circular, "--mass", "5", "--set", "payload.deployment_speed_m_s=31", "--out",
                    (folder.path / "case").string()});
  EXPECT_EQ(of_case.code, 0) << of_case.output;
  EXPECT_NE(of_case.output.find("at line stretch: 31 m/s (payload.deployment_speed_m_s of the case)"),
            std::string::npos)
      << of_case.output;
  for (const char* text : {"FASTEST SAFE DEPLOYMENT", "USE ", "the safe speed for infinite mass"})
    EXPECT_NE(fastest.output.find(text), std::string::npos) << text << "\n" << fastest.output;
}

}  // namespace
}  // namespace ripstop
