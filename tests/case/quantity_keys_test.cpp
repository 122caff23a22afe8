// Errors of solvers name quantities; people who wrote a case read the keys.
#include "ripstop/case/quantity_keys.h"

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <string>
#include <vector>

#include "ripstop/case/case.h"
#include "ripstop/core/quantity.h"
#include "ripstop/core/quantity_error.h"
#include "ripstop/flow/engines.h"
#include "ripstop/fsi/summary.h"

namespace ripstop {
namespace {

TEST(QuantityKeys, ASolversErrorIsReportedWithTheKeysOfTheCase) {
  try {
    low_pass({1, 2, 3}, 1e-3, 900);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "low-pass cutoff = 900: must be above 0 and below half the rate of the history, 500 Hz; "
              "increase the history rate");
    EXPECT_EQ(message_of(error),
              "inflation.low_pass_hz = 900: must be above 0 and below half the rate of the history, 500 Hz; "
              "increase inflation.history_hz");
  }
}

TEST(QuantityKeys, AnErrorThatIsRestatedKeepsItsQuantities) {
  const QuantityError first(ExitCode::diverged, "upwind convection may help", {"upwind convection"});
  const auto again =
      restated(first, "at 3 s: " + std::string(first.what()) + ", or a finer flow grid", {"flow grid"});
  EXPECT_EQ(again.code(), ExitCode::diverged);
  EXPECT_EQ(message_of(again), "at 3 s: flow.convection = \"upwind\" may help, or a finer grid (flow.cells)");
  EXPECT_EQ(message_of(restated(Error(ExitCode::io, "no disk"), "no disk here")), "no disk here");
}

TEST(QuantityKeys, EveryAbilityOfAnEngineHasAKey) {
  EngineRecord none = engines().front();
  none.can = {};
  Abilities all = engines().front().can;
  all.sheets = all.jets = all.averages = all.time = all.ranks = all.fitted_meshes = true;
  const std::vector<Lack> missing = lacks(none, all);
  EXPECT_GE(missing.size(), 8u);
  for (const Lack& lack : missing) EXPECT_NO_THROW(key_of_quantity(lack.quantity)) << lack.quantity;
}

TEST(QuantityKeys, AnErrorWithoutQuantitiesStaysAsItIs) {
  EXPECT_EQ(message_of(Error(ExitCode::io, "no low-pass cutoff here")), "no low-pass cutoff here");
}

TEST(QuantityKeys, AQuantityWithoutAKeyIsABug) {
  EXPECT_THROW(message_of(QuantityError(ExitCode::usage, "the weather is bad", {"the weather"})),
               std::out_of_range);
}

TEST(QuantityKeys, AreKeysOfTheSchema) {
  const std::string schema = case_schema();
  for (const auto& [quantity, key] : quantity_keys()) {
    const std::size_t dot = key.rfind('.') + 1, end = key.find_first_of(") ", dot);
    EXPECT_NE(schema.find('"' + key.substr(dot, end - dot) + '"'), std::string::npos) << quantity;
  }
}

// A key whose name ends with other units than its unit would read "3 ms" as 0.003 of them.
TEST(QuantityKeys, EveryKeyHasTheUnitThatItsNameEndsWith) {
  const std::map<std::string, std::string> units = {{"", ""},
                                                    {"_m", "m"},
                                                    {"_m2", "m2"},
                                                    {"_kg", "kg"},
                                                    {"_kg_m", "kg/m"},
                                                    {"_kg_m2", "kg/m2"},
                                                    {"_kg_m3", "kg/m3"},
                                                    {"_n", "N"},
                                                    {"_n_m", "N/m"},
                                                    {"_n_s", "N s"},
                                                    {"_n_s_m", "N s/m"},
                                                    {"_n_s_m3", "N s/m3"},
                                                    {"_n_s2_m4", "N s2/m4"},
                                                    {"_pa", "Pa"},
                                                    {"_pa_s", "Pa s"},
                                                    {"_pa_s_m", "Pa s/m"},
                                                    {"_pa_s2_m2", "Pa s2/m2"},
                                                    {"_s", "s"},
                                                    {"_m_s", "m/s"},
                                                    {"_deg", "deg"},
                                                    {"_deg_s", "deg/s"},
                                                    {"_per_s", "1/s"},
                                                    {"_hz", "Hz"},
                                                    {"_k", "K"},
                                                    {"_cfm", "cfm"},
                                                    {"_1_m", "1/m"},
                                                    {"_1_m2", "1/m2"}};
  const std::string schema = case_schema();
  const std::regex key("\"([a-z0-9_]+)\": \\{"),
      ending("((?:_(?:m|m2|m3|m4|kg|n|pa|s|s2|deg|hz|k|cfm|per|1))+)$");
  int found = 0;
  for (std::sregex_iterator i(schema.begin(), schema.end(), key), end; i != end; ++i) {
    const std::string name = (*i)[1];
    std::smatch parts;
    const std::string run = std::regex_search(name, parts, ending) ? parts[1].str() : "";
    ASSERT_TRUE(units.contains(run)) << name;
    EXPECT_EQ(unit_of_key(name), units.at(run)) << name;
    found += !run.empty();
  }
  EXPECT_GT(found, 80);
}

}  // namespace
}  // namespace ripstop
