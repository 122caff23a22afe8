// Every command that takes the folder of a run: it repeats the warnings of that run, and neither computes from nor
// silently shows the numbers of one that must not be used.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/flight/flight.h"
#include "ripstop/run/run_folder.h"
#include "tests/app/program.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

constexpr const char* made_up = "a warning that was made up";

using UseOfARun = std::pair<std::string, std::string>;  // command and option

/// A use of each option; "RUN" is the folder, "STEADY" another one without warnings.
struct Use {
  std::string command, option;
  std::vector<std::string> arguments;
  enum class Kind { computes, shows, only_refused } kind = Kind::computes;
};

/// The suite writes the folders once: of steady, inflate and fly, as `warned` and as `refused`.
class UsedRuns : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    root_ = std::make_unique<TemporaryFolder>("used-runs");
    Case given = checked(flat_circular_case(1, 500, 15));
    given.inflation.initial_radius_m = 0.1;
    given.inflation.duration_s = 0.01;
    write_file(file(), case_toml(resolve(given)));
    const auto run = ripstop_with({"steady", file(), "--out", in("steady"), "--grid", "16,16,24", "--set",
                                   "coupling.max_iterations=1", "--set", "flow.max_iterations=60", "--set",
                                   "coupling.threads=1"});
    ASSERT_EQ(run.code, 4) << run.output;
    end("steady", {}, true);
    for (const std::string name : {"warned", "refused"}) {
      fs::copy(in("steady"), in("steady-" + name), fs::copy_options::recursive);
      end("steady-" + name, {made_up}, name == "warned");
      write_opening("inflate-" + name, given);
      end("inflate-" + name, {made_up}, name == "warned");
      write_flight("fly-" + name, given);
      end("fly-" + name, {made_up}, name == "warned");
    }
    write_file(in("load-cell.csv"), "time_s,force_n\n0,0\n0.1,30\n0.2,200\n0.3,120\n");
  }
  static void TearDownTestSuite() { root_.reset(); }

  static std::string in(const std::string& name) { return (root_->path / name).string(); }
  static std::string file() { return in("case.toml"); }

  /// The result of a folder with these warnings, as if the run had ended so.
  static void end(const std::string& name, const std::vector<std::string>& warnings, bool usable) {
    auto result = nlohmann::ordered_json::parse(read_file(root_->path / name / "result.json"));
    result["warnings"] = warnings, result["usable"] = usable;
    if (result.contains("converged")) result["converged"] = true;
    ClaimedFolder claimed(root_->path / name);
    write_file(claimed.own("result.json"), result.dump(2));
    claimed.seal();
  }
  static void write_opening(const std::string& name, const Case& given) {
    const auto claimed = open_run_folder({in(name)}, resolve(given), "inflation", 1);
    write_csv(claimed->own("history.csv"), {{"time_s", "load_mean_n", "load_largest_n"},
                                            {{0.1, 30, 40}, {0.2, 200, 230}, {0.3, 120, 130}}});
    write_file(claimed->own("result.json"),
               R"({"title": "an opening", "peak_load_n": 230, "filling_time_s": 0.5,
                   "area_growth_exponent": 2.0})");
    claimed->seal();
  }
  static void write_flight(const std::string& name, const Case& given) {
    FlightResult flight;
    flight.title = "a flight", flight.ended_by = "duration", flight.descent = 5, flight.coefficient = 0.7;
    flight.reference_area = nominal_area(given.parachute), flight.density = 1.2;
    flight.parachute_mass = 0.05;
    const auto claimed = open_run_folder({in(name)}, resolve(given), "flight", 1);
    write_file(claimed->own("result.json"), to_json(flight));
    claimed->seal();
  }

  /// Of every option that the help describes as a folder of runs.
  static std::set<UseOfARun> documented() {
    const std::regex command("## `ripstop ([a-z -]+)`"), option("\\| `([a-z-]+)` \\|[^|]*\\| (.*) \\|"),
        folder("(Run folder|Folders?) of .*(run|runs|ripstop [a-z]+)\\b.*", std::regex::icase);
    std::set<UseOfARun> all;
    std::string line, now;
    for (std::istringstream page(read_file(RIPSTOP_SOURCE_DIR "/docs/reference/commands.md"));
         std::getline(page, line);) {
      std::smatch found;
      if (std::regex_match(line, found, command)) now = found[1];
      if (std::regex_match(line, found, option) && found[1] != "--out") {
        const std::string text = found[2];
        if (std::regex_match(text, folder)) all.insert({now, found[1]});
      }
    }
    return all;
  }
  static inline std::unique_ptr<TemporaryFolder> root_;
};

std::vector<Use> uses(const std::string& file, const std::string& load_cell, const std::string& out) {
  const std::vector<std::string> load = {"load", file,    "--mass", "2",     "--speed",
                                         "25",   "--out", out,      "--json"};
  const auto with = [](std::vector<std::string> arguments, const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  const std::vector<std::string> recovery = {"recovery", file, "--mass", "2", "--apogee", "1000",
                                             "--drogue", file, "--out",  out, "--json"};
  constexpr auto computes = Use::Kind::computes, shows = Use::Kind::shows, only = Use::Kind::only_refused;
  const std::string flight = examples + "flight-log/";
  return {
      {"inflate", "--steady", {"inflate", file, "--check", "--steady", "RUN steady", "--out", out}, computes},
      {"fly", "--from", {"fly", file, "--mass", "2", "--from", "RUN inflate", "--out", out}, only},
      {"stability",
       "--steady",
       {"stability", file, "--dry-run", "--steady", "RUN steady", "--out", out},
       only},
      {"load", "--steady", with(load, {"--steady", "RUN steady"}), computes},
      {"load", "--steady", with(load, {"--steady", "RUN fly"}), computes},
      {"load", "--opening", with(load, {"--drag-coefficient", "0.7", "--opening", "RUN inflate"}), computes},
      {"load", "--from", with(load, {"--drag-coefficient", "0.7", "--from", "RUN inflate"}), computes},
      {"load",
       "--steady",
       {"load", file, "--mass", "2", "--fastest", "--out", out, "--json", "--steady", "RUN steady"},
       computes},
      {"recovery", "--steady", with(recovery, {"--steady", "RUN steady"}), computes},
      {"recovery", "--drogue-steady", with(recovery, {"--drogue-steady", "RUN fly"}), computes},
      {"recovery", "--main-opening", with(recovery, {"--main-opening", "RUN inflate"}), computes},
      {"recovery", "--drogue-opening", with(recovery, {"--drogue-opening", "RUN inflate"}), computes},
      {"descent", "run", {"descent", "RUN steady", "--mass", "2", "--json"}, computes},
      {"descent", "run", {"descent", "RUN fly", "--mass", "2", "--json"}, computes},
      {"export", "run", {"export", "json", "RUN steady"}, computes},
      {"export", "run", {"export", "rocketpy", "RUN steady"}, computes},
      {"export", "--flight", {"export", "json", "STEADY", "--flight", "RUN fly"}, computes},
      {"export", "--drogue", {"export", "json", "STEADY", "--drogue", "RUN steady"}, computes},
      {"export",
       "--drogue-flight",
       {"export", "json", "STEADY", "--drogue", "STEADY", "--drogue-flight", "RUN fly"},
       computes},
      {"report", "runs", {"report", "RUN steady", "--out", out + ".html"}, shows},
      {"compare", "case", {"compare", "RUN steady", "STEADY", "--json"}, shows},
      {"compare", "case", {"compare", "RUN inflate", "--measured", load_cell, "--json"}, shows},
      {"compare", "others", {"compare", "STEADY", "RUN steady", "--json"}, shows},
      {"compare-flight",
       "--run",
       {"compare-flight", flight + "flight.csv", "--case", flight + "main.toml", "--ground", "200", "--run",
        "RUN steady", "--out", out, "--json"},
       computes},
      {"photogrammetry",
       "--run",
       {"photogrammetry", "--run", "RUN steady", "--out", out, "--json"},
       computes},
      {"calibrate damping",
       "--steady",
       {"calibrate", "damping", file, "--set", "inflation.measured_peak_n=300", "--steady", "RUN steady",
        "--out", out},
       only},
  };
}

TEST_F(UsedRuns, AreThoseThatTheHelpOfEveryCommandNames) {
  std::set<UseOfARun> tested;
  for (const Use& use : uses("", "", "")) tested.insert({use.command, use.option});
  EXPECT_EQ(documented(), tested);
}

TEST_F(UsedRuns, AreExportedWithATriggerInAnyUnitAndForTheDiameterOfABay) {
  const auto exported = [](const std::string& format, const std::vector<std::string>& more) {
    std::vector<std::string> all = {"export", format, in("steady")};
    all.insert(all.end(), more.begin(), more.end());
    return ripstop_with(all);
  };
  EXPECT_NE(exported("rocketpy", {"--trigger", "1000 ft"}).output.find("trigger=304.8,"), std::string::npos);
  const Finished design = exported("openrocket-design", {"--trigger", "300", "--bay-diameter", "5.9 in"});
  EXPECT_NE(design.output.find("<packedradius>0.07493</packedradius>"), std::string::npos) << design.output;
  const Finished refused = exported("rocketpy", {"--bay-diameter", "0.15"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.output.find("has no packed size"), std::string::npos) << refused.output;
}

TEST_F(UsedRuns, PassTheirWarningsOnAndAreRefusedOrMarkedWhereTheyMustNotBeUsed) {
  int number = 0;
  for (const Use& use : uses(file(), in("load-cell.csv"), in("out"))) {
    for (const std::string end : {"warned", "refused"}) {
      if (use.kind == Use::Kind::only_refused && end == "warned") continue;
      std::vector<std::string> arguments = use.arguments;
      std::string folder;
      for (std::string& one : arguments) {
        if (one == "STEADY") one = in("steady");
        if (one == in("out") || one == in("out.html")) one.insert(in("out").size(), std::to_string(++number));
        if (one.starts_with("RUN ")) folder = one = in(one.substr(4) + "-" + end);
      }
      const Finished run = ripstop_with(arguments);
      const bool refused = end == "refused" && use.kind != Use::Kind::shows;
      EXPECT_EQ(run.code, refused ? 3 : 0) << use.command << " " << use.option << "\n" << run.output;
      // Lines of the terminal are wrapped.
      std::string text;
      for (const char c : run.output)
        if (!std::isspace(static_cast<unsigned char>(c))) text += c;
      const auto holds = [&](std::string wanted) {
        std::erase(wanted, ' ');
        return text.find(wanted) != std::string::npos;
      };
      EXPECT_TRUE(holds(folder + ": ")) << use.command << " " << use.option << "\n" << run.output;
      if (end == "refused") {
        EXPECT_TRUE(holds("must not be used")) << use.command << "\n" << run.output;
      }
      if (refused) continue;
      EXPECT_TRUE(holds("warning: " + folder + ": " + made_up)) << use.command << "\n" << run.output;
      const bool as_json = std::any_of(arguments.begin(), arguments.end(), [](const std::string& one) {
        return one == "--json" || one == "json";
      });
      if (as_json) {
        EXPECT_TRUE(holds("\"" + folder + ": " + made_up + "\"")) << use.command << "\n" << run.output;
      }
    }
  }
}

}  // namespace
}  // namespace ripstop
