// The runs of a porosity calibration stand in the box and on the cells of the case that is calibrated.
#include "ripstop/run/sweep/porosity_sweep.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "../../refusal.h"
#include "ripstop/case/resolve.h"
#include "ripstop/core/file.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;
const fs::path examples = fs::path(RIPSTOP_SOURCE_DIR) / "examples";

std::vector<SweepPoint> points_of(const char* example, const PorositySweep& sweep) {
  const fs::path file = examples / example / "case.toml";
  const Case given = read_case(file);
  return sweep_points(file, {}, porosity_axes(resolve(given), sweep, {{5, 5, 1.2, 10}, {8, 7.5, 1.1, 20}}));
}

TEST(PorositySweep, LeavesTheBoxAndTheCellsOfTheCaseAsTheyAre) {
  for (const char* example : {"flat-circular", "cross", "stratos-iv", "adept"}) {
    const FlowGrid own = flow_grid(resolve(read_case(examples / example / "case.toml")).flow());
    const std::vector<SweepPoint> points =
        points_of(example, {PorosityKnob::permeability, {1, 5}, 1.2e-4, 3});
    ASSERT_EQ(points.size(), 12u);
    for (const SweepPoint& point : points) EXPECT_EQ(flow_grid(point.resolved.flow()), own) << example;
  }
}

TEST(MeasuredDragFile, IsReadHoweverItIsWritten) {
  const TemporaryFolder folder("measured");
  const fs::path file = folder.path / "drag.csv";
  for (const char* text :
       {"speed_m_s,density_kg_m3,drag_n\n10,1.2,43.5\n20,1.199,152.3\n",
        "\xef\xbb\xbf"
        "Tunnel B\nGeschwindigkeit (km/h);Luftdichte (kg/m³);Widerstand (N)\n36;1,2;43,5\n72;1,199;152,3\n",
        "Velocity\tDensity\tForce\nm/s\tkg/m3\tkN\n10\t1.2\t0.0435\n20\t1.199\t0.1523\n"}) {
    write_file(file, text);
    const MeasuredFile measured = read_measured_drag(file);
    ASSERT_EQ(measured.points.size(), 2u) << text;
    EXPECT_NEAR(measured.points[1].speed, 20, 1e-12) << text;
    EXPECT_EQ(measured.points[1].nominal_speed, measured.points[1].speed);
    EXPECT_NEAR(measured.points[1].density, 1.199, 1e-12) << text;
    EXPECT_NEAR(measured.points[1].drag, 152.3, 1e-10) << text;
    EXPECT_EQ(measured.understood.size(), 3u);
  }
  write_file(file, "v;rho;D\n10;1,2;43,5\n");
  EXPECT_EQ(read_measured_drag(file, table::parse_columns("speed=v [m/s],density=rho [kg/m3],drag=D [N]"))
                .points.at(0)
                .drag,
            43.5);
}

TEST(MeasuredDragFile, IsRefusedWithItsLine) {
  const TemporaryFolder folder("measured-bad");
  const fs::path file = folder.path / "drag.csv";
  for (const auto& [text, place] : std::vector<std::pair<const char*, const char*>>{
           {"speed_m_s,density_kg_m3,drag_n\n10,1.2,43.5\n20,1.2,-3\n", "drag.csv:3:"},
           {"speed_m_s,density_kg_m3,drag_n\n10,1.2,43.5\n20,,3\n", "drag.csv:3:"},
           {"speed_m_s,density_kg_m3\n10,1.2\n", "no column for the drag"},
           {"speed_m_s,drag_n,speed_m_s,density_kg_m3\n1,2,3,4\n", "two columns can be speed"},
           {"speed_m_s,density_kg_m3,drag_n\n10,1.2,43.5\n20,1.2,15", "may be incomplete"}}) {
    write_file(file, text);
    const std::string message = refusal_of([&] { read_measured_drag(file); }, ExitCode::bad_data);
    EXPECT_NE(message.find(place), std::string::npos) << message;
  }
}

TEST(PorositySweep, NamesItsKnobAsItsKey) {
  EXPECT_EQ(knob_name(PorosityKnob::gamma), "gamma");
  EXPECT_EQ(knob_name(PorosityKnob::permeability), "permeability_cfm");
}

TEST(PorositySweep, ShiftsTheCanopyEvenlyOverOneOfTheCellsThatItLiesIn) {
  for (const char* example : {"flat-circular", "stratos-iv"}) {
    const Case given = read_case(examples / example / "case.toml");
    const double cell = flow_grid(resolve(given).flow()).spacing().z,
                 place = resolve(given).flow().canopy_position_m;
    const std::vector<SweepPoint> points = points_of(example, {PorosityKnob::gamma, {0.2}, 1.2e-4, 3});
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_NEAR(points[i].resolved.flow().canopy_position_m - place, cell * (double(i % 3) - 1) / 3,
                  1e-9 * place)
          << example;
  }
}

TEST(PorositySweep, GivesItsResultsBackAsTrialsOfTheirPoint) {
  const Case given = read_case(examples / "flat-circular" / "case.toml");
  const PorositySweep sweep{PorosityKnob::gamma, {0.18, 0.22}, 1.2e-4, 3};
  std::vector<SweepRow> rows(12);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].result.drag_area = double(i);
  const std::vector<PorosityTrial> trials = porosity_trials(resolve(given), sweep, rows);
  const std::vector<SweepPoint> points = points_of("flat-circular", sweep);
  ASSERT_EQ(trials.size(), rows.size());
  for (std::size_t i = 0; i < trials.size(); ++i) {
    EXPECT_EQ(trials[i].drag_area, double(i));
    EXPECT_EQ(trials[i].condition, i / 6);
    const PressureDrop law = cloth_of(PorosityKnob::gamma, trials[i].knob, 1.2e-4);
    EXPECT_EQ(as_sheet(points[i].resolved.materials().canopy.resistance).linear, law.linear);
    EXPECT_NEAR(points[i].resolved.flow().canopy_position_m,
                resolve(given).flow().canopy_position_m + trials[i].shift, 1e-9);
  }
}

}  // namespace
}  // namespace ripstop
