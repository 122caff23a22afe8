#include <gtest/gtest.h>

#include "fixture.h"
#include "ripstop/case/case.h"

namespace ripstop {
namespace {

Case with(const std::string& setting) {
  Overrides overrides;
  overrides.set = {parse_setting(setting, "--set")};
  return parse_case(valid_case, "small.toml", overrides);
}

std::string refusal(const std::string& setting) {
  try {
    with(setting);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.what();
  }
  return "accepted";
}

TEST(Set, ReplacesAnyKindOfKey) {
  EXPECT_DOUBLE_EQ(with("flow.box_m=[2.5, 2, 4]").flow.box_m->x, 2.5);
  EXPECT_DOUBLE_EQ(with("flow.box_m[1]=2.25").flow.box_m->y, 2.25);
  EXPECT_EQ(with("flow.convection=upwind").flow.convection, Convection::upwind);
  EXPECT_TRUE(with("coupling.linear=true").coupling.linear);
  EXPECT_EQ(with("title=a word or two").title, "a word or two");
  EXPECT_DOUBLE_EQ(with("measured[0].density_kg_m3=1.3").measured[0].density_kg_m3, 1.3);
}

TEST(Set, RemovesAKeyOrATable) {
  Overrides overrides;
  overrides.set = {parse_setting("payload.mass_kg=3", "--set"), {"payload", "", "--unset", true}};
  EXPECT_FALSE(parse_case(valid_case, "small.toml", overrides).payload.mass_kg);
  overrides.set = {{"title", "", "--unset", true}};
  EXPECT_NE(parse_case(valid_case, "small.toml").title, "");
  EXPECT_EQ(parse_case(valid_case, "small.toml", overrides).title, Case().title);
  for (const char* key : {"payload", "flow.nothing", "flow.box_m[0]", "title.x"}) {
    overrides.set = {{key, "", "--unset", true}};
    EXPECT_THROW(parse_case(valid_case, "small.toml", overrides), InputError) << key;
  }
}

TEST(Set, OfAMaterialOfTheLibraryLeavesItsOtherValues) {
  const Fabric plain = canopy_fabric(parse_case(valid_case, "small.toml"));
  const Case changed = with("materials." + plain.name + ".pressure_drop_linear_pa_s_m=12.5");
  EXPECT_DOUBLE_EQ(as_sheet(canopy_fabric(changed).resistance).linear, 12.5);
  EXPECT_EQ(canopy_fabric(changed).coefficients_n_m, plain.coefficients_n_m);
  EXPECT_EQ(as_sheet(canopy_fabric(changed).resistance).quadratic, as_sheet(plain.resistance).quadratic);
}

TEST(Set, OfAKeyThatDoesNotExistNamesTheNearestAndTheOption) {
  const std::string text = refusal("flow.cels=[1,2,3]");
  EXPECT_NE(text.find("--set"), std::string::npos) << text;
  EXPECT_NE(text.find("\"cells\""), std::string::npos) << text;
  EXPECT_NE(refusal("materials.f-11.darcy_1_m2=1").find("f-111"), std::string::npos);
  EXPECT_NE(refusal("flow.engine=opnfoam").find("\"openfoam\""), std::string::npos);
  for (const char* wrong :
       {"flow", "flow.cells=", "flow..x=1", "flow.cells[9]=1", "flow.cells[a]=1", "flow.cells[0)=20", "=3",
        "flow.cells=[1", "flow.speed_m_s.x=1", "flow=1", "flow.speed_m_s=-3"})
    EXPECT_NE(refusal(wrong), "accepted") << wrong;
}

TEST(Set, SplitsValuesOutsideBracketsAndQuotes) {
  EXPECT_EQ(split_values("1, 2,[3, 4],\"a,b\""), (std::vector<std::string>{"1", "2", "[3, 4]", "\"a,b\""}));
  EXPECT_THROW(split_values("1,,2"), Error);
}

}  // namespace
}  // namespace ripstop
