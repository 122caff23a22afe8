// What every textbook says of a canopy's drag, on coarse cells.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/case/case.h"
#include "ripstop/run/steady.h"

namespace ripstop {
namespace {

/// Drag area of an example of the `sheet` model, on some ten cells across.
double drag_area(const std::string& example, std::vector<Setting> settings) {
  Overrides overrides;
  overrides.set = {{"parachute.mesh.cloth_nodes", "1500", ""},
                   {"parachute.canopy_material", "f-111-physical", ""},
                   {"flow.porosity_model", "sheet", ""},
                   {"flow.box_m", "[6,6,8]", ""},
                   {"flow.cells", "[36,36,44]", ""},
                   {"flow.canopy_position_m", "3", ""},
                   {"flow.speed_m_s", "20", ""},
                   {"coupling.drag_tolerance", "0.01", ""},
                   {"coupling.threads", "1", ""}};
  for (Setting& setting : settings) overrides.set.push_back(setting);
  const Case given =
      read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples" / example / "case.toml", overrides);
  SteadyObserver nobody;
  const SteadyResult r = run_steady(given, nobody).result;
  EXPECT_TRUE(r.converged) << example << ' ' << settings.back().key << " = " << settings.back().value;
  return r.drag_area;
}

std::vector<double> over(const std::string& example, const std::string& key,
                         const std::vector<std::string>& values) {
  std::vector<double> drags;
  for (const std::string& value : values) drags.push_back(drag_area(example, {{key, value, ""}}));
  return drags;
}

TEST(Trends, DragFallsWithTheVent) {
  const auto drag = over("flat-circular", "parachute.vent_diameter_m", {"0.05", "0.2", "0.35"});
  EXPECT_GT(drag[0], 1.01 * drag[1]);
  EXPECT_GT(drag[1], 1.01 * drag[2]);
}

TEST(Trends, DragFallsWithTheGap) {
  const auto drag = over("stratos-iv", "parachute.gap_height_m", {"0.03", "0.1", "0.25"});
  EXPECT_GT(drag[0], 1.01 * drag[1]);
  EXPECT_GT(drag[1], 1.01 * drag[2]);
}

// 3, 100 and 400 cubic feet a minute and square foot at half an inch of water.
TEST(Trends, DragFallsWithPermeability) {
  const auto drag = over("flat-circular", "materials.f-111-physical.darcy", {"8169", "245", "61"});
  EXPECT_GT(drag[0], 1.01 * drag[1]);
  EXPECT_GT(drag[1], 1.01 * drag[2]);
}

// From 0.6 to 1.5 nominal diameters: the lines pull the skirt in less.
TEST(Trends, DragRisesWithTheLines) {
  const auto drag = over("flat-circular", "parachute.lines.length_m", {"0.6", "1", "1.5"});
  EXPECT_GT(drag[1], 1.01 * drag[0]);
  EXPECT_GT(drag[2], 1.01 * drag[1]);
}

}  // namespace
}  // namespace ripstop
