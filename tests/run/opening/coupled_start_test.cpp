// Starts of coupled openings.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "ripstop/case/opening.h"
#include "ripstop/core/error.h"
#include "ripstop/run/engine.h"
#include "ripstop/run/opening/inflation_folder.h"
#include "tests/refusal.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

// Without a cell centre between the layers of its folds the air passes as if there were no canopy.
TEST(CoupledStart, FoldsWithBothLayersBetweenTheSameCellCentresAreRefused) {
  Case given = small_payload_case(20);
  given.parachute.gores = given.parachute.lines.count = 8;
  given.inflation.air = AirModel::coupled, given.inflation.initial_radius_m = 0.108;
  const auto make = [&](std::array<int, 3> cells) {
    given.flow.cells = cells;
    const Settings resolved = resolve(opening_case(checked(given)));
    make_opening(with_engine(resolved, opening_problem(resolved, load_source(resolved), 1)));
  };
  const std::string message = refusal_of([&] { make({40, 40, 50}); }, ExitCode::usage);
  EXPECT_NE(message.find("do not resolve the 8 folds"), std::string::npos) << message;
  EXPECT_NO_THROW(make({64, 64, 80}));
}

}  // namespace
}  // namespace ripstop
