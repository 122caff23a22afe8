// A short flight of a small canopy with a rocket as its payload, in a folder.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "ripstop/case/flying.h"
#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/flight/flight_folder.h"
#include "tests/refusal.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

/// On cells as coarse as can show a canopy, for some steps of the flow.
Case with_rocket() {
  Case given = small_payload_case(5);
  given.bodies["rocket"].shape = CylinderKeys{0.2, 0.5, 0.1};
  given.flow.max_iterations = 30;
  given.coupling.max_iterations = 2;
  given.flight.cells_across = 8;
  given.flight.duration_s = 0.06;
  given.flight.shapes_per_s = 40;
  return given;
}

/// Ends in the middle, after a checkpoint.
struct KilledBodyFlight : FlightObserver {
  void advanced(FreeFlight&, const FreeFlightState& state, const FlightHistory&, bool) override {
    if (state.coupled.air.steps == 6) throw std::runtime_error("killed");
  }
};
struct ResumedBodyFlight : FlightObserver {
  std::size_t rows = 0;
  void begin(FreeFlight&, FreeFlightState&, FlightHistory& history) override { rows = history.bodies.size(); }
};

TEST(BodyFlightRun, HasItsBodyInResultAndFilesAndResumesByteForByte) {
  const TemporaryFolder folder("body-flight");
  const Settings resolved = flight_settings(checked(with_rocket()));
  EXPECT_GT(resolved.flow().core.size_m.z, 1.2 * resolved.flow().core.size_m.x)
      << "the body is in fine cells";
  FlightObserver nobody;
  const auto result = run_flight_in({{folder.path / "whole"}, 1, 0}, resolved, nobody);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->ended_by, "duration");
  EXPECT_LT(result->momentum_residual, 0.01);
  ASSERT_TRUE(result->bodies);
  ASSERT_EQ(result->bodies->size(), 1u);
  const FlightBody& rocket = result->bodies->front();
  EXPECT_EQ(rocket.name, "rocket");
  EXPECT_NEAR(rocket.reference_area, 0.0314, 0.001);
  EXPECT_NEAR(rocket.drag_coefficient, rocket.drag_area / rocket.reference_area, 1e-12);
  EXPECT_GT(rocket.drag_coefficient, 0.1);
  EXPECT_LT(rocket.drag_coefficient, 3);
  EXPECT_NEAR(rocket.resolved, 1, 1e-12);
  const CsvTable rows = read_csv(folder.path / "whole" / "bodies.csv"),
                 path = read_csv(folder.path / "whole" / "path.csv");
  EXPECT_EQ(rows.rows.size(), path.rows.size());
  EXPECT_TRUE(std::filesystem::exists(folder.path / "whole" / "vtk/body-rocket_0002.vtp"));
  EXPECT_NE(read_file(folder.path / "whole" / "body-rocket.pvd").find("body-rocket_0001.vtp"),
            std::string::npos);

  KilledBodyFlight killed;
  EXPECT_THROW(run_flight_in({{folder.path / "parts"}, 1, 0}, resolved, killed), std::runtime_error);
  ResumedBodyFlight resumed;
  ASSERT_TRUE(run_flight_in({{folder.path / "parts"}, 1, 0}, resolved, resumed));
  EXPECT_GE(resumed.rows, 4u);
  for (const char* file : {"path.csv", "bodies.csv", "result.json", "vtk/body-rocket_0002.vtp"})
    EXPECT_EQ(read_file(folder.path / "whole" / file), read_file(folder.path / "parts" / file)) << file;
}

}  // namespace
}  // namespace ripstop
