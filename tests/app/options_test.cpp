// Every option is a key with its range, in every command, and a mistake is reported in one sentence.
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <sstream>

#include "program.h"
#include "ripstop/core/file.h"

namespace ripstop {
namespace {

/// Commands as typed, with the arguments they need in addition to the tested option.
const std::map<std::string, std::vector<std::string>> commands = {
    {"check", {stratos}},
    {"schema", {}},
    {"materials", {}},
    {"steady", {stratos, "--dry-run"}},
    {"fabric", {stratos}},
    {"fit", {examples + "fit-ripstop/bench.toml"}},
    {"coupon", {"f-111"}},
    {"inflate", {stratos, "--check"}},
    {"pattern", {stratos}},
    {"import", {examples + "elliptical/elliptical.chute"}},
    {"flow-parity", {}},
    {"calibrate damping", {stratos}},
    {"calibrate porosity", {stratos}},
    {"sweep", {stratos, "--speeds", "10", "--dry-run"}},
    {"stability", {examples + "flat-circular/case.toml", "--dry-run"}},
    {"fly", {examples + "flat-circular/case.toml"}},
    {"compare", {stratos, "--linear"}},
    {"compare-flight",
     {examples + "flight-log/flight.csv", "--case", examples + "flight-log/main.toml", "--out",
      "/dev/null/none"}},
    {"studio", {examples, "--no-browser"}},
    {"photogrammetry", {RIPSTOP_SOURCE_DIR "/validation/ojf/stratos-iv-images.toml"}},
    {"descent", {"none"}},
    {"report", {"none"}},
    {"load", {stratos}},
    {"recovery", {stratos}},
    {"size", {}},
    {"export", {"json", "none"}}};

std::vector<std::string> words(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

std::vector<std::string> matches(const std::string& text, const char* pattern) {
  const std::regex all(pattern, std::regex::multiline);
  std::vector<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), all), end; i != end; ++i) found.push_back((*i)[1]);
  return found;
}

TEST(Options, TheTableOfThisTestHasEveryCommand) {
  for (const std::string parent : {"", "calibrate "}) {
    std::vector<std::string> help = words(parent);
    help.push_back("--help");
    const std::string text = ripstop_with(help).output;
    const std::size_t list = text.find("Subcommands:");
    ASSERT_NE(list, std::string::npos) << text;
    const std::vector<std::string> names = matches(text.substr(list), "^  ([a-z-]+) ");
    EXPECT_GE(names.size(), 2u);
    for (const std::string& name : names)
      EXPECT_TRUE(name == "calibrate" || commands.contains(parent + name)) << parent + name;
  }
}

TEST(Options, NoNumberOfAnyCommandIsTakenBeyondItsRange) {
  int tried = 0;
  for (const auto& [command, needed] : commands) {
    std::vector<std::string> help = words(command);
    help.push_back("--help");
    const std::string text = ripstop_with(help).output;
    EXPECT_TRUE(matches(text, "^  (--[a-z-]+) (?:FLOAT|INT|UINT)(?![A-Z])").empty())
        << command << ": an option without a range: " << text;
    for (const std::string& option : matches(text, "^  (--[a-z-]+) (?:NUMBER|INTEGER)")) {
      const bool three = option == "--grid" || option == "--cells";
      const bool of_three = three && command != "coupon";
      for (const std::string value : {"nan", "inf", "1e300", "-1e300", "12abc"}) {
        std::vector<std::string> arguments = words(command);
        arguments.insert(arguments.end(), needed.begin(), needed.end());
        arguments.push_back(option + "=" + value + (of_three ? "," + value + "," + value : ""));
        const Finished run = ripstop_with(arguments, RIPSTOP_SOURCE_DIR, 20);
        EXPECT_EQ(run.code, 2) << command << " " << arguments.back() << ": " << run.output;
        EXPECT_NE(run.output.find(option), std::string::npos) << command << " " << run.output;
        EXPECT_LT(run.output.size(), 400u) << run.output;  // no limit of 300 digits
        ++tried;
      }
    }
  }
  EXPECT_GT(tried, 250);  // of some 60 options
}

TEST(Options, TheHelpShowsTheRange) {
  EXPECT_NE(ripstop_with({"inflate", "--help"}).output.find("above 0 and at most 1000"), std::string::npos);
  const std::string coupon = ripstop_with({"coupon", "--help"}).output;
  EXPECT_NE(coupon.find("above 0 and at most 2"), std::string::npos) << coupon;
}

TEST(Options, AKeyIsShownAsItWasGiven) {
  const Finished run = ripstop_with({"check", stratos, "--set", "parachute.mesh.cloth_nodes=1e12"});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.output.find("parachute.mesh.cloth_nodes = 1000000000000: must be at least 500 and at most"),
            std::string::npos)
      << run.output;
}

TEST(Options, AMistypedCommandOrOptionIsReportedWithTheNearestOne) {
  const Finished command = ripstop_with({"chekc", stratos});
  EXPECT_EQ(command.code, 2);
  EXPECT_NE(command.output.find("\"chekc\" is not a command; did you mean check?"), std::string::npos)
      << command.output;
  const Finished nested = ripstop_with({"calibrate", "dampign", stratos});
  EXPECT_EQ(nested.code, 2);
  EXPECT_NE(nested.output.find("did you mean damping?"), std::string::npos) << nested.output;
  const Finished option = ripstop_with({"check", stratos, "--sped", "20"});
  EXPECT_EQ(option.code, 2);
  EXPECT_NE(option.output.find("did you mean --speed?"), std::string::npos) << option.output;
  EXPECT_NE(option.output.find("ripstop check --help"), std::string::npos) << option.output;
  // A request for help does not hide the mistake.
  const Finished help = ripstop_with({"chekc", "--help"});
  EXPECT_EQ(help.code, 2);
  EXPECT_NE(help.output.find("\"chekc\" is not a command; did you mean check?"), std::string::npos)
      << help.output;
  EXPECT_EQ(ripstop_with({"calibrate", "dampign", "--help"}).code, 2);
  EXPECT_EQ(ripstop_with({"nosuchcommand", "--version"}).code, 2);
  EXPECT_EQ(ripstop_with({"--help"}).code, 0);
  EXPECT_EQ(ripstop_with({"check", stratos, "--help"}).code, 0);
  for (const Finished& run : {command, nested, option, help, ripstop_with({"check"})})
    EXPECT_LT(run.output.size(), 300u) << run.output;  // one sentence, not a page of help
}

/// Options whose help shows a value as their default, with that value. Those that need another option, and defaults
/// that the command derives, which are described in words, are not among them.
std::vector<std::string> options_with_their_defaults(const std::string& command) {
  std::vector<std::string> help = words(command);
  help.push_back("--help");
  const std::string text = ripstop_with(help).output;
  const std::regex entry("\\n  (--[a-z-]+)([^\\n]*(?:\\n {20,}[^\\n]*)*)");
  const std::regex shown("\\(default: ([^() ]+)\\)(; excludes [a-z, -]+)?$");
  std::vector<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), entry), end; i != end; ++i) {
    const std::string rest = (*i)[2];
    std::smatch value;
    if (std::regex_search(rest, value, shown)) found.push_back((*i)[1].str() + "=" + value[1].str());
  }
  return found;
}

TEST(Options, TheHelpDescribesAnOptionBeforeThoseThatItExcludesOrNeeds) {
  const auto entry = [](const std::string& command, const std::string& option) {
    const std::string text = ripstop_with({command, "--help"}).output;
    const std::regex lines("\n  " + option + "([^\\n]*(?:\\n {20,}[^\\n]*)*)");
    std::smatch found;
    EXPECT_TRUE(std::regex_search(text, found, lines)) << option << "\n" << text;
    return std::regex_replace(found[1].str(), std::regex("\\s+"), " ");
  };
  EXPECT_EQ(entry("size", "--density").find(" NUMBER Density of the air, instead of the height"), 0u)
      << entry("size", "--density");
  EXPECT_TRUE(entry("size", "--density").ends_with("; excludes --height")) << entry("size", "--density");
  EXPECT_TRUE(entry("size", "--height").ends_with("(default: 0); excludes --density"))
      << entry("size", "--height");
  EXPECT_TRUE(entry("export", "--drogue-trigger").ends_with("(default: apogee); needs --drogue"))
      << entry("export", "--drogue-trigger");
  // Several are in alphabetical order.
  EXPECT_TRUE(entry("steady", "--batch").ends_with("; excludes --dry-run, --fresh, --hostfile, --json"))
      << entry("steady", "--batch");
}

TEST(Options, ADefaultInTheHelpIsTheValueThatIsUsed) {
  const TemporaryFolder folder("defaults");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path);
  const std::string flat = examples + "flat-circular/case.toml";
  const std::map<std::string, std::vector<std::string>> cheap = {
      {"size", {"--mass", "2.4", "--descent-rate", "5", "--force"}},
      {"load", {flat, "--mass", "2.4", "--speed", "20"}},
      {"recovery", {flat, "--mass", "2.4", "--apogee", "500"}},
      {"pattern", {flat}},
      {"compare-flight", {examples + "flight-log/flight.csv", "--case", examples + "flight-log/main.toml"}},
      {"photogrammetry", {RIPSTOP_SOURCE_DIR "/validation/ojf/stratos-iv-images.toml"}},
      {"coupon", {"f-111", "--strain", "0.02"}}};
  int tried = 0;
  for (const auto& [command, needed] : cheap) {
    std::vector<std::string> arguments = {command};
    arguments.insert(arguments.end(), needed.begin(), needed.end());
    const Finished omitted = ripstop_with(arguments);
    EXPECT_EQ(omitted.code, 0) << omitted.output;
    const std::vector<std::string> defaults = options_with_their_defaults(command);
    EXPECT_FALSE(defaults.empty()) << command;
    arguments.insert(arguments.end(), defaults.begin(), defaults.end());
    EXPECT_EQ(ripstop_with(arguments).output, omitted.output) << command;
    tried += int(defaults.size());
  }
  EXPECT_GE(tried, 35);
  std::filesystem::current_path(before);
}

TEST(Options, AMistakeIsReportedWithTheMeaningOfTheOptionAndAnExample) {
  const std::map<std::string, std::vector<std::string>> mistakes = {
      {"--descent-rate (Required rate of descent [m/s]; above 0 and at most 100) is missing",
       {"size", "--mass", "2"}},
      {"needs a value", {"size", "--descent-rate"}},
      {"--mass is given more than once", {"size", "--mass", "2", "--mass", "3", "--descent-rate", "5"}},
      {"argument case (Case file (TOML)) is missing", {"steady"}},
      {"did you mean uniform?", {"inflate", stratos, "--air", "unform"}},
      {"folder \"nowhere\" does not exist; give the folder of a finished run",
       {"inflate", stratos, "--steady", "nowhere"}},
      {"--speed and --fastest exclude each other: give one of them",
       {"load", stratos, "--speed", "3", "--fastest"}},
      {"--margin needs --fastest: give both", {"load", stratos, "--speed", "3", "--margin", "1"}},
      {"for example 40,40,50 (case key flow.cells); at least 4 and at most 2000) needs 3 values",
       {"steady", stratos, "--grid", "24,24"}}};
  for (const auto& [message, arguments] : mistakes) {
    const Finished run = ripstop_with(arguments);
    EXPECT_EQ(run.code, 2) << run.output;
    EXPECT_NE(run.output.find(message), std::string::npos) << run.output;
    EXPECT_NE(run.output.find("Example: ripstop " + arguments.front()), std::string::npos) << run.output;
  }
  EXPECT_NE(ripstop_with({"calibrate"}).output.find("damping or porosity"), std::string::npos);
}

TEST(Options, OfOneKeyAreNotGivenTwice) {
  const std::vector<std::vector<std::string>> twice = {
      {"check", stratos, "--speed", "20", "--set", "flow.speed_m_s=30"},
      {"inflate", stratos, "--check", "--duration", "0.2", "--set", "inflation.duration_s=0.3"}};
  for (const std::vector<std::string>& arguments : twice) {
    const Finished run = ripstop_with(arguments);
    EXPECT_EQ(run.code, 2) << run.output;
    EXPECT_NE(run.output.find("is also given by " + arguments[arguments.size() - 4]), std::string::npos)
        << run.output;
  }
}

}  // namespace
}  // namespace ripstop
