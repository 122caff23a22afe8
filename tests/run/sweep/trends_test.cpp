// Textbook trends of the drag of a canopy, on coarse cells: twelve across, first order, walls with slip.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/case/case.h"
#include "ripstop/run/steady/steady.h"

namespace ripstop {
namespace {

/// Of an example with cloth of 3 cubic feet a minute and square foot at half an inch of water [m2].
double drag_area(const std::string& example, const std::vector<Setting>& settings) {
  Overrides overrides;
  overrides.set = {
      {"parachute.mesh.cloth_nodes", "1500"},
      {"parachute.canopy_material", "f-111-physical"},
      {"flow.porosity_model", "sheet"},
      {"flow.box_m", "[2.4,2.4,3.6]"},
      {"flow.canopy_position_m", "1.2"},
      {"flow.cells", "[40,40,60]"},
      {"flow.core.size_m", "[2.4,2.4,3.6]"},
      {"flow.convection", "upwind"},
      {"flow.sides", "slip"},
      {"flow.speed_m_s", "20"},
      {"coupling.load", "uniform"},
      {"coupling.drag_tolerance", "0.005"},
      {"coupling.threads", "1"},
  };
  overrides.set.insert(overrides.set.end(), settings.begin(), settings.end());
  const auto file = std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples" / example / "case.toml";
  SteadyObserver nobody;
  const SteadyResult r = run_steady(read_case(file, overrides), nobody).result;
  EXPECT_TRUE(r.converged) << example << ' ' << settings.back().key << " = " << settings.back().value;
  return r.drag_area;
}

TEST(Trends, DragFallsWithVentAndPermeabilityAndRisesWithTheLines) {
  const double as_it_is = drag_area("flat-circular", {{"parachute.vent_diameter_m", "0.1"}});
  const double wide_vent = drag_area("flat-circular", {{"parachute.vent_diameter_m", "0.35"}});
  const double loose_cloth = drag_area(
      "flat-circular", {{"materials.f-111-physical.pressure_drop_linear_pa_s_m", "82"}});  // 300 CFM
  const double short_lines = drag_area("flat-circular", {{"parachute.lines.length_m", "0.6"}});
  const double long_lines = drag_area("flat-circular", {{"parachute.lines.length_m", "1.5"}});
  EXPECT_LT(wide_vent, 0.98 * as_it_is);
  EXPECT_LT(loose_cloth, 0.98 * as_it_is);
  EXPECT_LT(short_lines, 0.98 * as_it_is);
  EXPECT_GT(long_lines, 1.02 * as_it_is);
}

TEST(Trends, DragFallsWithTheGapOfADiskGapBand) {
  EXPECT_LT(drag_area("stratos-iv", {{"parachute.gap_height_m", "0.2"}}),
            0.98 * drag_area("stratos-iv", {{"parachute.gap_height_m", "0.03"}}));
}

}  // namespace
}  // namespace ripstop
