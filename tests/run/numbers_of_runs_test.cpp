// Numbers that a command takes from elsewhere: from the case, its materials, an opening's history, a campaign.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "../refusal.h"
#include "../small_case.h"
#include "ripstop/case/assemble.h"
#include "ripstop/case/opening.h"
#include "ripstop/case/payload.h"
#include "ripstop/core/error.h"
#include "ripstop/core/thread_team.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flight/descent.h"
#include "ripstop/fsi/opening_estimate.h"
#include "ripstop/fsi/summary.h"
#include "ripstop/fsi/uniform_pressure_opening.h"
#include "ripstop/material/library.h"
#include "ripstop/run/descent/descent.h"
#include "ripstop/run/engine.h"
#include "ripstop/run/material/fit.h"
#include "ripstop/run/opening/damping.h"
#include "ripstop/run/opening/filling.h"
#include "ripstop/run/opening/inflation_folder.h"
#include "ripstop/run/opening/load.h"
#include "ripstop/run/quality.h"
#include "ripstop/run/sizing/fabric.h"
#include "ripstop/run/sweep/porosity_sweep.h"
#include "tests/run/steady/finished_run.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

TEST(RunNumbers, OfAnEngineAreThoseOfTheCase) {
  Case given = square_law_case();
  given.flow.mesh = FlowMesh::grid;
  given.flow.cloth_levels = 0;
  EngineOptions options = engine_options(resolve(given));
  EXPECT_FALSE(options.fitted_mesh);
  EXPECT_EQ(options.cloth_levels, 0);
  EXPECT_EQ(options.ranks, 1);
  given.flow.mesh = FlowMesh::fitted;
  given.flow.cloth_levels = 2;
  given.flow.ranks = 5;
  given.flow.time_limit_s = 9;
  for (const Convection convection : {Convection::upwind, Convection::second_order}) {
    given.flow.convection = convection;
    options = engine_options(resolve(given));
    EXPECT_EQ(options.second_order, convection == Convection::second_order);
    EXPECT_TRUE(options.fitted_mesh);
    EXPECT_EQ(options.cloth_levels, 2);
    EXPECT_EQ(options.ranks, 5);
    EXPECT_EQ(options.time_limit_s, 9);
  }
}

TEST(RunNumbers, AHostfileNeedsAnEngineOfRanksAndTwoOfThem) {
  const TemporaryFolder root("hosts");
  write_file(root.path / "hosts", "localhost slots=8\n");
  Case given = square_law_case();
  require_hosts({}, resolve(given));
  given.flow.ranks = 4;
  EXPECT_NE(refusal_of([&] { require_hosts(root.path / "hosts", resolve(given)); }, ExitCode::usage)
                .find("--hostfile: requires"),
            std::string::npos);
  given.flow.engine = "openfoam";
  require_hosts(root.path / "hosts", resolve(given));
  given.flow.ranks = 2;
  require_hosts(root.path / "hosts", resolve(given));
  given.flow.ranks = 1;
  EXPECT_EQ(refusal_of([&] { require_hosts(root.path / "hosts", resolve(given)); }, ExitCode::usage)
                .find("--hostfile: requires"),
            0u);
  given.flow.ranks = 9;
  EXPECT_THROW(require_hosts(root.path / "hosts", resolve(given)), Error);  // more than slots
}

TEST(RunNumbers, OfClothUnderTheStreamsPressureAreItsRelaxations) {
  Case given = square_law_case();
  given.coupling.cloth_tolerance = 0.02;
  int told = 0;
  const FabricSolution cloth = run_fabric(resolve(given), {}, [&](const RelaxProgress&) { ++told; });
  const FabricResult& r = cloth.result;
  const Air stream = air(given);
  EXPECT_EQ(r.title, given.title);
  EXPECT_EQ(r.pressure, 0.5 * stream.density * stream.speed * stream.speed);
  EXPECT_EQ(r.tolerance, 0.02);
  EXPECT_TRUE(r.converged);
  EXPECT_LE(r.residual, 0.02);
  EXPECT_GT(r.residual, 0);
  EXPECT_GT(r.steps, 100);
  EXPECT_GT(r.wall_time, 0);
  EXPECT_GT(told, 0);
  EXPECT_EQ(r.nodes, cloth.mesh.node_count());
  EXPECT_DOUBLE_EQ(r.projected_ratio, r.size.projected_diameter / nominal_diameter(given.parachute));
  const KnownRange known = experience(given.parachute).projected_ratio;
  EXPECT_EQ(r.known_projected_ratio.has_value(), known.low > 0);
  if (known.low > 0) {
    EXPECT_EQ(r.known_projected_ratio->at(0), known.low);
    EXPECT_EQ(r.known_projected_ratio->at(1), known.high);
  }
  double most = 0;
  for (const LineTension& t : line_tensions(cloth.mesh, cloth.tensions))
    most = std::max(most, t.largest_tension);
  EXPECT_EQ(r.max_line_tension, most);
  // All lines together carry the load, and each is aslant.
  EXPECT_GT(most, r.line_tension / given.parachute.lines.count);

  // One law more makes other numbers.
  given.coupling.linear = true;
  EXPECT_NE(run_fabric(resolve(given), {}).result.size.projected_diameter, r.size.projected_diameter);
}

TEST(RunNumbers, OfAFamilyThatNoTableHasTheFillingIsThatOfSolidCloth) {
  const KnownFilling unknown = known_filling("parasol");
  EXPECT_EQ(unknown.constant, 8);
  EXPECT_EQ(unknown.exponent, 2);
  EXPECT_EQ(unknown.ludtke_exponent, 6);
  EXPECT_EQ(std::string(unknown.source).find("not in the tables"), 0u);
  for (const char* type : {"ringslot", "ringsail", "disk-gap-band"})
    EXPECT_EQ(known_filling(type).ludtke_exponent, 2);
}

TEST(RunNumbers, HowWellADragIsKnownIsTheLargestOfItsShares) {
  SteadyIteration last;
  last.fluid_force = last.nodal_load = last.momentum_deficit = 200;
  EXPECT_EQ(drag_uncertainty(last), 0);
  last.drag_change = 0.001;
  EXPECT_DOUBLE_EQ(drag_uncertainty(last), 0.001);
  last.drag_deviation = 0.4;
  EXPECT_DOUBLE_EQ(drag_uncertainty(last), 0.002);
  last.nodal_load = 199.4;
  EXPECT_NEAR(drag_uncertainty(last), 0.003, 1e-12);
  last.momentum_deficit = 201;
  EXPECT_NEAR(drag_uncertainty(last), 0.005, 1e-12);
  last.momentum_deficit = 198;
  EXPECT_NEAR(drag_uncertainty(last), 0.01, 1e-12);
  last.drag_change = INFINITY;  // the first iteration has no change
  EXPECT_NEAR(drag_uncertainty(last), 0.01, 1e-12);
}

TEST(RunNumbers, OfARunInMemoryAreThoseOfItsResult) {
  SteadyObserver quiet;
  const Case given = square_law_case();
  SteadyResult result = run_steady(given, quiet).result;
  const FinishedSteady run = finished_steady(resolve(given), result);
  EXPECT_TRUE(run.folder.empty());
  EXPECT_EQ(run.result.drag, result.drag);
  EXPECT_EQ(run.drag_uncertainty, drag_uncertainty(result.last));
  EXPECT_GT(run.parachute_mass, 0);
  result.converged = false;
  EXPECT_EQ(refusal_of([&] { finished_steady(resolve(given), result); }, ExitCode::bad_data)
                .find("the steady run has not"),
            0u);
}

TEST(RunNumbers, OfADescentAreThoseOfItsRun) {
  SteadyObserver quiet;
  const Case given = square_law_case();
  FinishedSteady run = finished_steady(resolve(given), run_steady(given, quiet).result);
  run.drag_uncertainty = 0.04;
  const Descent d = run_descent(run, 3, {500, 501, 499}, 500);
  EXPECT_EQ(d.payload_mass, 3);
  EXPECT_EQ(d.parachute_mass, run.parachute_mass);
  EXPECT_EQ(d.drag_area, run.result.drag_area);
  EXPECT_DOUBLE_EQ(d.drag_area_uncertainty, 0.04 * d.drag_area);
  EXPECT_EQ(d.run_speed, run.result.speed);
  EXPECT_EQ(d.ground, 500);
  EXPECT_EQ(d.rows[0].height, 500);
  EXPECT_FALSE(d.rows[0].time || d.rows[2].time);
  ASSERT_TRUE(d.rows[1].time && d.rows[1].time_uncertainty);
  EXPECT_NEAR(*d.rows[1].time * d.rows[1].speed, 1, 1e-3);
  EXPECT_DOUBLE_EQ(*d.rows[1].time_uncertainty, 0.02 * *d.rows[1].time);
  // Warned of beyond a quarter of the run's dynamic pressure, on either side.
  const double q = 0.5 * run.result.density * run.result.speed * run.result.speed;
  const auto warned = [&](double share) {
    return run_descent(run, share * q * d.drag_area / standard_gravity - run.parachute_mass, {0})
               .warnings.size() -
           run.warnings.size();
  };
  EXPECT_EQ(warned(1.24), 0u);
  EXPECT_EQ(warned(1.26), 1u);
  EXPECT_EQ(warned(0.76), 0u);
  EXPECT_EQ(warned(0.74), 1u);
}

TEST(RunNumbers, MeasuredDragIsThatOfTheCasesBasisWhereThereIsOne) {
  Case given = square_law_case();
  given.measured = {
      {10, 10.5, 1.1, 100.0, {}, {}}, {20, 21, 1.2, {}, 400.0, {}}, {30, 31, 1.3, 900.0, {}, {}}};
  given.flow.speed_basis = SpeedBasis::measured;
  std::vector<MeasuredDrag> points = measured_drag(resolve(given));
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].nominal_speed, 10);
  EXPECT_EQ(points[0].speed, 10.5);
  EXPECT_EQ(points[1].nominal_speed, 30);
  EXPECT_EQ(points[1].speed, 31);
  EXPECT_EQ(points[1].density, 1.3);
  EXPECT_EQ(points[1].drag, 900);
  given.flow.speed_basis = SpeedBasis::nominal;
  points = measured_drag(resolve(given));
  EXPECT_EQ(points[0].speed, 10);
  EXPECT_EQ(points[1].speed, 30);
}

TEST(RunNumbers, ACalibrationsConditionsHaveNamesAndItsCoreStaysWhereItIs) {
  const Case given = read_case(fs::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml");
  const PorositySweep sweep{PorosityKnob::gamma, {0.2, 0.3}, 1.2e-4, 1};
  const std::vector<SweepAxis> axes = porosity_axes(
      resolve(given), sweep, {{5, 5.5, 1.2, 10}, {5, 5.6, 1.1, 20}, {5, 5.7, 1.1, 20}, {8, 8, 1.1, 20}});
  ASSERT_EQ(axes.size(), 3u);
  EXPECT_EQ(axes[0].values, (std::vector<std::string>{"5", "5-2", "5-3", "8"}));
  const auto value = [](const std::vector<Setting>& settings, const std::string& key) -> std::string {
    for (const Setting& setting : settings)
      if (setting.key == key) return setting.value;
    return "none";
  };
  EXPECT_EQ(value(axes[0].settings[1], "flow.speed_m_s"), "5.6");
  EXPECT_EQ(value(axes[0].settings[1], "flow.density_kg_m3"), "1.1");
  EXPECT_EQ(value(axes[0].settings[1], "flow.speed_basis"), "nominal");
  EXPECT_EQ(axes[1].name, "gamma");
  EXPECT_EQ(axes[1].values, (std::vector<std::string>{"0.2", "0.3"}));
  EXPECT_EQ(axes[2].name, "shift_m");
  EXPECT_EQ(axes[2].values, std::vector<std::string>{"0"});
  Case graded = read_case(fs::path(RIPSTOP_SOURCE_DIR) / "examples/flat-circular/case.toml");
  graded.flow.core.size_m = Vec3{1, 1, 2};
  const FlowSettings flow = resolve(graded).flow();
  EXPECT_EQ(value(porosity_axes(resolve(graded), sweep, {})[2].settings[0], "flow.core.start_m"),
            fmt::format("{}", flow.core.start_m));
  graded.flow.core.size_m = Vec3{1, 1, 0};
  EXPECT_EQ(value(porosity_axes(resolve(graded), sweep, {})[2].settings[0], "flow.core.start_m"), "none");
  EXPECT_THROW(require_slope({PorosityKnob::gamma, {0.2}, 1.2e-4, 1}), Error);
  require_slope(sweep);
}

TEST(RunNumbers, AReefedOpeningIsNoRecordOfADragArea) {
  const TemporaryFolder root("reefed-record");
  Case given = small_opening();
  given.inflation.reefing = {{0.5, 0.0035, {}}};
  given.inflation.duration_s = 4e-3;
  given.inflation.frames = 2;
  const Case opening = opening_case(given);
  const LoadSource source = load_source(resolve(opening));
  InflationObserver quiet;
  run_inflation_in(
      {{root.path / "run"}, 1, 1e6}, resolve(opening), source,
      [&] { return opening_problem(resolve(opening), source, 1); }, quiet);
  LoadRequest asked;
  asked.payload_mass = 2, asked.speed = 30, asked.height = 500, asked.opening = root.path / "run";
  EXPECT_NE(
      refusal_of([&] { run_load(resolve(opening), asked); }, ExitCode::usage).find("is a reefed opening"),
      std::string::npos);
}

TEST(RunNumbers, OfAnOpeningTheDeepestAndLargestOfItsFramesCount) {
  Case given = small_opening();
  given.inflation.cloth_damping_s = 1e-6;
  given.inflation.low_pass_hz = 0;
  InflationObserver quiet;
  InflationProblem problem{parachute_mesh(resolve(given)), given.inflation, 500, false, 1, 6};
  const UniformPressureOpening solver(problem);
  const auto [result, state, history] = run_inflation(resolve(given), {"asked for", {}}, problem, quiet);
  double deepest = 0, pierced = 0;
  for (const InflationFrame& frame : history.frames)
    deepest = std::max(deepest, frame.contact_depth), pierced = std::max(pierced, frame.pierced);
  EXPECT_EQ(result.contact_depth, deepest);
  EXPECT_EQ(result.pierced, pierced);
  EXPECT_EQ(result.viscosity_limit.least_share, solver.viscosity_limit().least_share);
  EXPECT_EQ(result.viscosity_limit.reduced_cells, solver.viscosity_limit().reduced_cells);
  EXPECT_EQ(result.start_strain, start_strain(solver.mesh(), solver.folded().positions).largest);
  EXPECT_EQ(result.source.text, "asked for");
  EXPECT_FALSE(result.steady_drag_returned || result.drag_area || result.end_speed || result.stages);
  EXPECT_FALSE(result.settled);  // so short: nothing that rests on a steady load is there
  EXPECT_FALSE(result.steady_load || result.overshoot || result.summary.inflation_time ||
               result.estimate.load);
  EXPECT_FALSE(result.start_up_time);
  EXPECT_EQ(result.peak_time, state.peak_time);
  EXPECT_EQ(result.settings.damping_n_s_m3, given.inflation.damping_n_s_m3);
  EXPECT_FALSE(result.low_pass || result.smooth_peak);
  EXPECT_DOUBLE_EQ(opening_seconds(solver, solver.start()),
                   8e-3 / solver.start().step * solver.mesh().node_count() / 1.25e8);
}

TEST(RunNumbers, OfACoupledInflationAreItsLargestDragAreaAndThePayloadsEnd) {
  Case given = small_opening_in_air();
  given.inflation.mass = InflationSettings::Mass::payload;
  given.payload.mass_kg = 3;
  given.inflation.flight_angle_deg = 30;
  given.inflation.duration_s = 2e-3;
  given.inflation.frames = 2;
  const Case opening = opening_case(given);
  const LoadSource source = load_source(resolve(opening));
  InflationObserver quiet;
  const auto [r, state, history] =
      run_inflation(resolve(opening), source, opening_problem(resolve(opening), source, 1), quiet);
  ASSERT_GT(history.air.size(), 1u);
  double largest = -INFINITY;
  for (const AirRow& row : history.air) largest = std::max(largest, row.drag_area);
  EXPECT_EQ(r.drag_area, largest);
  EXPECT_FALSE(r.pressure);
  ASSERT_TRUE(r.end_speed && r.end_angle && r.height_lost);
  EXPECT_EQ(*r.end_speed, state.air.flight.speed);
  EXPECT_NEAR(*r.end_angle, 30, 1);
  EXPECT_DOUBLE_EQ(*r.end_angle, state.air.flight.angle * 180 / std::numbers::pi);
  EXPECT_EQ(*r.height_lost, state.air.flight.fallen);
  EXPECT_GT(*r.height_lost, 0);
  // After 2 ms the canopy is folded still: nothing is relative to a full canopy, and a warning names the duration.
  EXPECT_EQ(r.filled, false);
  EXPECT_FALSE(r.filling_time || r.opening_force_coefficient || r.finite_mass_factor);
  EXPECT_TRUE(std::any_of(r.warnings->begin(), r.warnings->end(), [](const std::string& text) {
    return text.find("has not filled within inflation.duration_s = 0.002 s") != std::string::npos;
  }));
}

// Air of a cell has fifty times the mass of its cloth. The faces of the flow that are nearly parallel to folded cloth
// must not drive it: without the compliance of such faces the peak is several times the load of the open canopy.
TEST(RunNumbers, InHeavyAirAFoldedCanopyIsLoadedLessThanTheOpenOne) {
  Case given = small_opening_in_air();
  given.flow.density_kg_m3 = 20, given.flow.speed_m_s = 20;
  given.inflation.duration_s = 0.012;
  const Settings resolved = resolve(opening_case(given));
  const LoadSource source = load_source(resolved);
  InflationObserver quiet;
  const auto opened = run_inflation(resolved, source, opening_problem(resolved, source, 1), quiet);
  const double open =
      0.5 * 0.5 * 20 * 20 * 20 * nominal_area(resolved.parachute());  // C_D q S0, C_D = 0.5 [N]
  EXPECT_LT(opened.result.peak_load, open);
  EXPECT_GT(opened.result.peak_load, 0.01 * open);
  EXPECT_FALSE(opened.result.filled.value_or(true) || opened.result.opening_force_coefficient);
}

// Values that were not finite have been used as the number of a cell or as a size here: large and light canopies at
// high speed, and stiff lines.
TEST(RunNumbers, OfLargeFastOpeningsWithStiffLinesAreFinite) {
  struct Drop {
    double diameter, mass, speed;
    const char* line;
  };
  for (const Drop& drop :
       {Drop{11.4, 120, 40, "spectra-line-1000-lbf"}, Drop{20, 310, 20, "aramid-line-1000-lbf"}}) {
    SCOPED_TRACE(drop.diameter);
    Case given = flat_circular_case(drop.diameter, 2000, drop.speed);
    given.parachute.canopy_material = "f-111-physical";
    given.parachute.lines.material = drop.line;
    given.parachute.mesh.line_segment_m = drop.diameter / 20;
    given.flow.cells = {40, 40, 50};
    given.payload.mass_kg = drop.mass;
    given.inflation.air = AirModel::coupled;
    given.inflation.mass = InflationSettings::Mass::payload;
    given.inflation.initial_radius_m = 0.1 * drop.diameter;
    given.inflation.duration_s = 0.004;
    given.inflation.frames = 4;
    const Settings resolved = resolve(opening_case(checked(given)));
    const LoadSource source = load_source(resolved);
    InflationObserver quiet;
    const auto [r, state, history] =
        run_inflation(resolved, source, opening_problem(resolved, source, 1), quiet);
    EXPECT_NEAR(history.rows.back().time, 0.004, 1e-3);
    for (const HistoryRow& row : history.rows) ASSERT_TRUE(std::isfinite(row.largest)) << row.time;
    EXPECT_GT(r.peak_load, 0);
    EXPECT_LT(r.energy_residual, 0.05);
    EXPECT_GT(state.step, 0);
  }
}

TEST(RunNumbers, ADampingIsSearchedOnTheMeasuredOpeningUnderThePressureOfTheProblem) {
  Case given = small_opening();
  given.inflation.duration_s = 2e-3;
  given.inflation.frames = 2;
  EXPECT_NE(refusal_of(
                [&] {
                  Case none = given;
                  none.inflation.measured_peak_n.reset();
                  damping_target(resolve(none));
                },
                ExitCode::usage)
                .find("measured_peak_n"),
            std::string::npos);
  given.inflation.measured_peak_n = 700;
  given.inflation.measured_inflation_time_s = 0.05;
  given.inflation.low_pass_hz = 1000;
  InflationProblem problem{parachute_mesh(resolve(given)), given.inflation, 321, false, 1, 6};
  DampingSearch search;
  search.from = 5, search.to = 9, search.points = 3, search.refinements = 0;
  int told = 0;
  const DampingResult r =
      run_damping(resolve(given), {"a source", {}}, problem, search, [&](const DampingTrial&) { ++told; });
  EXPECT_EQ(told, 3);
  ASSERT_EQ(r.found.trials.size(), 3u);
  EXPECT_EQ(r.title, given.title);
  EXPECT_EQ(r.target.peak, 700);
  EXPECT_EQ(r.target.inflation_time, 0.05);
  EXPECT_EQ(r.low_pass_hz, 1000);
  EXPECT_EQ(r.pressure, 321);
  EXPECT_EQ(r.pressure_from, "a source");
  EXPECT_EQ(r.nodes, problem.mesh.node_count());
  ASSERT_TRUE(r.inputs_hash);
  search.to = 10;
  EXPECT_NE(run_damping(resolve(given), {"a source", {}}, problem, search).inputs_hash, r.inputs_hash);
  problem.air = AirProblem{};
  EXPECT_NE(
      refusal_of([&] { run_damping(resolve(given), {}, problem, search); }, ExitCode::usage).find("coupled"),
      std::string::npos);
}

TEST(RunNumbers, OfAFitWithCouponsAreInItsTextItsJsonAndItsFolder) {
  Bench bench = read_bench(fs::path(RIPSTOP_SOURCE_DIR) / "examples/fit-ripstop/bench.toml");
  bench.shear_fraction = 0.2, bench.bending_fraction = 0.01;
  ThreadTeam team(1);
  FitResult result = run_fit(bench, true, team);
  ASSERT_TRUE(result.coupons);
  CouponFit& c = *result.coupons;
  c.searched = true, c.shear_low = 0.18, c.shear_high = 0.23, c.bending_effect = 0.004, c.evaluations = 17;
  c.notes = {"a note on coupons"};
  const std::string text = material_toml(result);
  const auto has = [&](const std::string& line) {
    EXPECT_NE(text.find("# " + line + "\n"), std::string::npos) << line << "\n" << text.substr(0, 4000);
  };
  has(fmt::format("xi {:.4f} (95 % interval 0.1800 .. 0.2300), eps {:.4f}, from virtual coupons",
                  c.fabric.shear_fraction, c.fabric.bending_fraction));
  has(fmt::format("coefficients multiplied by {:.5f} for the clamps", c.rescale));
  ASSERT_FALSE(c.coupons.empty());
  for (const CouponComparison& one : c.coupons)
    has(fmt::format("virtual {} coupon against the mean record: R2 {:.4f}", one.name, one.r2));
  has("a note on coupons");
  const auto json = nlohmann::json::parse(to_json(result)).at("coupons");
  EXPECT_EQ(json.at("xi"), c.fabric.shear_fraction);
  EXPECT_EQ(json.at("xi_low"), 0.18);
  EXPECT_EQ(json.at("xi_high"), 0.23);
  EXPECT_EQ(json.at("eps"), c.fabric.bending_fraction);
  EXPECT_EQ(json.at("searched"), true);
  EXPECT_EQ(json.at("rescale"), c.rescale);
  EXPECT_EQ(json.at("effect_of_eps"), 0.004);
  EXPECT_EQ(json.at("evaluations"), 17);
  ASSERT_EQ(json.at("coupons").size(), c.coupons.size());
  for (std::size_t i = 0; i < c.coupons.size(); ++i) {
    const auto& one = json["coupons"][i];
    const CouponPoint& end = c.coupons[i].pull.points.back();
    EXPECT_EQ(one.at("name"), c.coupons[i].name);
    EXPECT_EQ(one.at("r2"), c.coupons[i].r2);
    EXPECT_EQ(one.at("waist"), end.waist);
    EXPECT_EQ(one.at("corner_peak"), end.corner_peak);
    EXPECT_EQ(one.at("strain"), c.coupons[i].strain);
    EXPECT_EQ(one.at("measured_n_per_m"), c.coupons[i].measured);
    EXPECT_EQ(one.at("simulated_n_per_m"), c.coupons[i].simulated);
  }
  c.searched = false;
  EXPECT_EQ(material_toml(result).find("interval 0.18"), std::string::npos);
  c.shear_low = std::nan("");
  EXPECT_TRUE(nlohmann::json::parse(to_json(result)).at("coupons").at("xi_low").is_null());

  const TemporaryFolder root("fit-with-coupons");
  write_fit(root.path / "fit", result);
  for (const CouponComparison& one : c.coupons)
    for (const char* ending : {"png", "vtp"})
      EXPECT_TRUE(fs::exists(root.path / fmt::format("fit/coupon-{}.{}", one.name, ending))) << one.name;
  const std::string asked = coupons_json(c.fabric, bench, result.fit, "asked", c.coupons);
  const auto of_coupons = nlohmann::json::parse(asked);
  EXPECT_EQ(of_coupons.at("material"), c.fabric.name);
  EXPECT_EQ(of_coupons.at("coupons").size(), c.coupons.size());
  EXPECT_NE(coupons_json(c.fabric, bench, result.fit, "else", c.coupons), asked);
}

}  // namespace
}  // namespace ripstop
