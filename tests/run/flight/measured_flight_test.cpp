// The example log of a known flight through the table reader, with the drag area of a run.
#include "ripstop/run/flight/measured_flight.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include "ripstop/case/case.h"
#include "ripstop/case/resolve.h"
#include "ripstop/core/file.h"
#include "tests/refusal.h"
#include "tests/run/steady/finished_run.h"

namespace ripstop {
namespace {

const std::filesystem::path log_folder = std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/flight-log";

MeasuredFlightRequest request_for(const std::filesystem::path& log) {
  MeasuredFlightRequest request;
  request.logs = {log}, request.mass = 22, request.ground = 200;
  return request;
}
Settings flown_case() {
  return resolve(read_case(log_folder / "main.toml"));
}

TEST(MeasuredFlight, TheExampleHasTheDragAreasThatItWasMadeWith) {
  const MeasuredFlight f = compare_flight(flown_case(), request_for(log_folder / "flight.csv"));
  ASSERT_EQ(f.phases.size(), 2u);
  ASSERT_TRUE(f.phases[0].drag_area && f.phases[1].drag_area);
  EXPECT_NEAR(*f.phases[0].drag_area / 0.30, 1, 0.03);
  EXPECT_NEAR(*f.phases[1].drag_area / 6.0, 1, 0.03);
  ASSERT_EQ(f.deployments.size(), 1u);
  EXPECT_NEAR(f.deployments[0].height, 300, 60);
  EXPECT_TRUE(f.deployments[0].peak_load) << f.deployments[0].problem;
  EXPECT_NEAR(f.highest, 1500, 3);
}

TEST(MeasuredFlight, SeparateLogsOfOneClockAndAHeightAboveSeaLevelGiveTheSame) {
  const TemporaryFolder folder("measured-flight");
  std::istringstream rows(read_file(log_folder / "flight.csv"));
  std::string row, heights = "Time (s);Altitude (ft)\n", loads = "Time (s);Acceleration (g)\n";
  std::getline(rows, row);
  while (std::getline(rows, row)) {
    std::istringstream cells(row);
    double time = 0, height = 0, felt = 0;
    char comma = 0;
    cells >> time >> comma >> height >> comma >> felt;
    heights += fmt::format("{};{:.3f}\n", time, (height + 200) / 0.3048);
    loads += fmt::format("{};{:.5f}\n", time, felt / 9.80665);
  }
  write_file(folder.path / "altimeter.csv", heights), write_file(folder.path / "logger.csv", loads);
  MeasuredFlightRequest request = request_for(folder.path / "altimeter.csv");
  request.logs.push_back(folder.path / "logger.csv");
  request.height_zero = -200;
  const MeasuredFlight one = compare_flight(flown_case(), request_for(log_folder / "flight.csv"));
  const MeasuredFlight both = compare_flight(flown_case(), request);
  ASSERT_EQ(both.phases.size(), 2u);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(*both.phases[i].drag_area / *one.phases[i].drag_area, 1, 1e-4);
  EXPECT_NEAR(*both.deployments[0].peak_load / *one.deployments[0].peak_load, 1, 1e-3);
}

TEST(MeasuredFlight, AComputedDragAreaIsComparedWithTheNearestPhaseAndReported) {
  const TemporaryFolder folder("measured-flight");
  fly_square_law(folder.path / "run", {});
  MeasuredFlightRequest request = request_for(log_folder / "flight.csv");
  request.runs = {folder.path / "run"};
  const MeasuredFlight f = compare_flight(flown_case(), request);
  ASSERT_EQ(f.computed.size(), 1u);
  EXPECT_EQ(f.computed[0].phase, std::abs(std::log(f.computed[0].drag_area / 0.3)) <
                                         std::abs(std::log(f.computed[0].drag_area / 6.0))
                                     ? 1
                                     : 2);
  EXPECT_NEAR(*f.computed[0].difference,
              f.computed[0].drag_area / *f.phases[f.computed[0].phase - 1].drag_area - 1, 1e-12);
  write_measured_flight(folder.path / "out", f);
  for (const char* name : {"result.json", "drag-area.csv", "drag-area.png", "height.svg", "report.html"})
    EXPECT_TRUE(std::filesystem::exists(folder.path / "out" / name)) << name;
  EXPECT_NE(read_file(folder.path / "out/report.html").find("Flight log"), std::string::npos);
}

TEST(MeasuredFlight, ALogWithoutHeightAndACaseWithoutMassAreRefused) {
  const TemporaryFolder folder("measured-flight");
  write_file(folder.path / "loads.csv", "Time (s),Force (N)\n0,1\n1,2\n2,3\n");
  EXPECT_NE(refusal_of([&] { compare_flight(flown_case(), request_for(folder.path / "loads.csv")); },
                       ExitCode::bad_data)
                .find("no log has a column of the altitude"),
            std::string::npos);
  Case given = read_case(log_folder / "main.toml");
  given.payload.mass_kg.reset();
  MeasuredFlightRequest request = request_for(log_folder / "flight.csv");
  request.mass.reset();
  EXPECT_NE(refusal_of([&] { compare_flight(resolve(given), request); }, ExitCode::usage).find("use --mass"),
            std::string::npos);
}

}  // namespace
}  // namespace ripstop
