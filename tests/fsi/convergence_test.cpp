// Criteria that a run without convergence does not meet, and the last changes of a run.
#include "ripstop/fsi/convergence.h"

#include <gtest/gtest.h>

#include <limits>

namespace ripstop {
namespace {

/// An iteration that meets every criterion.
SteadyIteration converged() {
  SteadyIteration now;
  now.shape_change = 1e-4, now.drag_change = 1e-5;
  now.fluid_force = now.nodal_load = now.line_tension = now.momentum_deficit = 100;
  now.flow_converged = true;
  return now;
}

TEST(UnmetCriteria, ListsOnlyUnmetCriteria) {
  CouplingSettings settings;
  settings.drag_tolerance = 1e-3;
  const auto only = [&](const SteadyIteration& now, const std::string& words) {
    const std::vector<std::string> unmet = unmet_criteria(now, settings);
    ASSERT_EQ(unmet.size(), 1u) << words;
    EXPECT_NE(unmet[0].find(words), std::string::npos) << unmet[0];
  };
  SteadyIteration now = converged();
  only(now, "not solved to the full tolerance");
  now.shape_change = 2e-3;
  only(now, "the shape changes by 2 mm (limit 1 mm)");
  now = converged(), now.drag_change = 0.0067;
  only(now, "the drag changes by 0.67 % (limit 0.1 %)");
  now = converged(), now.drag_change = std::numeric_limits<double>::infinity();
  only(now, "the drag is known from one iteration only");
  settings.load = CanopyLoad::of_flow;
  now = converged(), now.drag_change = 0.0019, now.nodal_load = now.line_tension = 100.09;
  only(now, "not solved to the full tolerance");
  now.nodal_load = now.line_tension = 100.11;
  only(now, "the drag changes by 0.19 % (limit 0.1 %)");
  now = converged(), now.drag_change = 0.0021;
  only(now, "the drag changes by 0.21 % (limit 0.1 %)");
  now = converged(), now.drag_change = std::numeric_limits<double>::infinity();
  only(now, "the drag is known from one iteration only");
  now = converged(), now.regularisation_share = 0.05;
  only(now, "by 5 % (limit 2 %) of the load");
  now = converged(), now.nodal_load = 90;
  only(now, "air load, cloth load and line load differ by 10 % (limit 1 %)");
  now = converged(), now.flow_converged = false;
  only(now, "the flow has not converged");
}

TEST(LastChanges, StateDragAndShapeWithTheLimitsThatApply) {
  CouplingSettings settings;
  settings.drag_tolerance = 5e-3, settings.shape_tolerance_m = 1e-3;
  SteadyIteration now = converged();
  now.drag_change = 1.8e-3, now.shape_change = 2.5e-4;
  EXPECT_EQ(last_changes(now, settings),
            "last change of the drag 0.18 % (limit 0.5 %), of the shape 0.25 mm (limit 1 mm)");
  now.drag_change = 4.996e-3;
  EXPECT_EQ(last_changes(now, settings).find("last change of the drag 0.4996 % (limit 0.5 %)"), 0u)
      << last_changes(now, settings);
  now.drag_change = 1e-8;
  EXPECT_EQ(last_changes(now, settings).find("last change of the drag less than 0.005 % (limit 0.5 %), of"),
            0u)
      << last_changes(now, settings);
  now.drag_change = 7e-3, settings.load = CanopyLoad::of_flow;
  EXPECT_EQ(last_changes(now, settings),
            "last change of the drag 0.7 % (limit 1 %), of the shape 0.25 mm (limit 1 mm)");
  now.drag_change = std::numeric_limits<double>::infinity();
  EXPECT_EQ(last_changes(now, settings), "last change of the shape 0.25 mm (limit 1 mm)");
  now.in_time = true, now.drag_change = 1.8e-3;
  EXPECT_EQ(last_changes(now, settings),
            "last change of the shape 0.25 mm (limit 1 mm and the scatter of the means)");
}

}  // namespace
}  // namespace ripstop
