// The first milliseconds of the coupled opening of two small canopies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "ripstop/case/opening.h"
#include "ripstop/case/payload.h"
#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/opening/inflation_folder.h"
#include "tests/refusal.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

constexpr double spread = 24;  // [deg]

Case two_canopies() {
  Case given = flat_circular_case(1, 500, 20);
  given.parachute.riser.length_m = 0.6;
  given.parachute.mesh.line_segment_m = 0.2;
  given.cluster = ClusterKeys{2, spread, false, {}};
  given.flow.box_m = Vec3{4, 2.4, 3.2};
  given.flow.cells = {40, 24, 32};
  given.flow.canopy_position_m = 1.2;
  given.flow.core.size_m = Vec3{};
  given.inflation.air = AirModel::coupled;
  given.inflation.initial_radius_m = 0.2;
  given.inflation.duration_s = 6e-3;
  given.inflation.frames = 3;
  return given;
}

InflationProblem problem_of(const Settings& resolved) {
  return opening_problem(resolved, load_source(resolved), 1);
}

InflationSolution opened(const std::function<void(Case&)>& edit) {
  Case given = two_canopies();
  edit(given);
  const Settings resolved = resolve(opening_case(checked(given)));
  InflationObserver nobody;
  return run_inflation(resolved, load_source(resolved), problem_of(resolved), nobody);
}

// Differences within the tolerance of the pressure solver grow in cloth that flutters: the first block is compared.
TEST(ClusterInflation, OfEqualCanopiesIsSymmetric) {
  const InflationSolution solution = opened([](Case&) {});
  const std::vector<CanopyRow>& rows = solution.history.canopies;
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_GT(rows[0].riser_load, 1);
  EXPECT_NEAR(rows[0].riser_load / rows[1].riser_load, 1, 1e-3);
  EXPECT_NEAR(rows[0].mouth_area / rows[1].mouth_area, 1, 1e-3);
  EXPECT_NEAR(rows[0].spread, rows[1].spread, 1e-3);
  double loads = 0, force = 0;
  for (std::size_t i = 0; i + 1 < rows.size(); i += 2) {
    loads += (rows[i].riser_load + rows[i + 1].riser_load) * std::cos(spread * std::numbers::pi / 180);
    const auto at =
        std::find_if(solution.history.rows.begin(), solution.history.rows.end(),
                     [&](const HistoryRow& row) { return row.time >= rows[i].time * (1 - 1e-9); });
    force += at->mean;
  }
  EXPECT_NEAR(loads / force, 1, 0.05) << "the force on the confluence is that of both risers";
  const InflationResult& r = solution.result;
  ASSERT_TRUE(r.cluster);
  EXPECT_EQ(r.cluster->peak_difference, 0);
  EXPECT_EQ(r.cluster->canopies[0].peak_load, rows[4].riser_load);
  EXPECT_GT(r.cluster->smallest_gap, 0.5);
  EXPECT_LT(r.energy_residual, 0.02);
  EXPECT_LT(r.momentum_residual.value(), 0.01);
}

TEST(ClusterInflation, StartsWithEveryCanopyFoldedAtRestAboutItsOwnAxis) {
  const Settings resolved = resolve(opening_case(checked(two_canopies())));
  InflationProblem both = problem_of(resolved);
  ThreadTeam team(1);
  const OpeningCloth one(both.mesh, both.settings, {}, both.symmetry, false, team, {}),
      two(both.mesh, both.settings, {}, both.symmetry, false, team, both.cluster);
  EXPECT_EQ(two.mesh().node_count(), 2 * one.mesh().node_count() - 1);
  EXPECT_EQ(two.mesh().fixed.size(), 1u);
  EXPECT_NEAR(two.elastic_energy_at_start(), 2 * one.elastic_energy_at_start(), 1e-9);
  const std::vector<Vec3> folded = one.folded().positions;
  for (const std::vector<Vec3>& canopy : two.upright(two.folded().positions)) {
    ASSERT_EQ(canopy.size(), folded.size());
    for (std::size_t n = 0; n < canopy.size(); ++n) EXPECT_LT(norm(canopy[n] - folded[n]), 1e-6);
  }
}

/// Largest distance across the axis of canopy `k` between the positions of its cloth and its folded ones [m].
double unfolded(const Opening& solver, const std::vector<Vec3>& x, int k) {
  const double azimuth = ClusterLayout{2, 0}.azimuth(k), tilt = spread * std::numbers::pi / 180;
  const Vec3 axis{std::cos(azimuth) * std::sin(tilt), std::sin(azimuth) * std::sin(tilt), std::cos(tilt)};
  double most = 0;
  std::vector<char> tied(x.size(), 0);  // they follow other nodes
  for (const Tie& tie : solver.mesh().ties) tied[tie.node] = 1;
  for (const Patch& patch : solver.mesh().patches) {
    if (patch.piece != k) continue;
    for (int node = patch.first_node; node < patch.first_node + patch.rows * patch.columns; ++node) {
      if (tied[node]) continue;
      const Vec3 moved = x[node] - solver.folded().positions[node];
      most = std::max(most, norm(moved - dot(moved, axis) * axis));
    }
  }
  return most;
}

TEST(ClusterInflation, ACanopyStaysFoldedUntilItsDelayAndThenOpens) {
  Case given = two_canopies();
  given.cluster->delays_s = {0, 3e-3};
  const Settings resolved = resolve(opening_case(checked(given)));
  const auto solver = make_opening(with_engine(resolved, problem_of(resolved)));
  InflationState state = solver->start();
  const auto open_until = [&](double time) {
    while (state.cloth.time < time * (1 - 1e-9)) solver->advance(state);
    return positions(state.cloth, solver->cloth());
  };
  const std::vector<Vec3> held = open_until(2e-3);
  EXPECT_LT(unfolded(*solver, held, 1), 1e-9);
  EXPECT_GT(unfolded(*solver, held, 0), 2e-3);
  const std::vector<CanopyRow> rows = solver->canopy_rows(state);
  EXPECT_GT(rows[1].riser_load, 1) << "the air pulls at the folded canopy, and it at its lines";
  const std::vector<Vec3> released = open_until(6e-3);
  EXPECT_GT(unfolded(*solver, released, 1), 2e-3);
}

TEST(ClusterInflation, CanopiesOfTwoSizesStartAsSmallerOnesOfTheSameFolds) {
  constexpr double ratio = 0.7;
  const InflationSolution solution = opened([](Case& given) {
    given.cluster->size_ratios = {1, ratio};
    given.parachute.riser.length_m = 0.53;  // no whole number of segments: rounding would decide
    given.flow.cells = {64, 40, 52};
    given.inflation.duration_s = 2e-3, given.inflation.frames = 1;
  });
  const std::vector<CanopyRow>& rows = solution.history.canopies;
  ASSERT_GE(rows.size(), 2u);
  EXPECT_NEAR(rows[1].mouth_area / rows[0].mouth_area, ratio * ratio, 0.02);
  // The axis of the cluster points to the mean of the centres of the skirts, nearer to the larger canopy.
  EXPECT_NEAR(rows[1].spread / rows[0].spread, 1 / ratio, 0.1);
  EXPECT_NEAR(rows[0].spread + rows[1].spread, 2 * spread, 2);
  const ClusterOpening& cluster = solution.result.cluster.value();
  EXPECT_EQ(cluster.canopies[0].size_ratio.value(), 1);
  EXPECT_EQ(cluster.canopies[1].size_ratio.value(), ratio);
  EXPECT_LT(solution.result.start_strain, 1e-3);
  EXPECT_LT(solution.result.energy_residual, 0.02);
}

TEST(ClusterInflation, APayloadOfCanopiesOfTwoSizesHasTheMassBeyondBothMeshes) {
  Case given = two_canopies();
  given.payload.mass_kg = 2, given.payload.deployment_speed_m_s = 20;
  given.inflation.mass = InflationSettings::Mass::payload;
  given.cluster->size_ratios = {1, 0.7};
  given.flow.cells = {64, 40, 52};
  const Settings resolved = resolve(opening_case(checked(given)));
  const InflationProblem problem = problem_of(resolved);
  double cloth = 0;
  for (const SizedCanopy& canopy : problem.sizes)
    for (const double node : canopy.mesh.mass) cloth += node;
  EXPECT_NEAR(problem.air->payload->mass + cloth, 2 + mass_of_canopies(resolved), 1e-9);
}

TEST(ClusterInflation, DelaysAreInTheResult) {
  const InflationSolution solution = opened([](Case& given) {
    given.cluster->delays_s = {0, 3e-3}, given.inflation.duration_s = 4e-3;
  });
  const ClusterOpening& cluster = solution.result.cluster.value();
  EXPECT_EQ(cluster.canopies[1].delay.value(), 3e-3);
  EXPECT_LT(solution.result.energy_residual, 0.02);
  EXPECT_NE(to_json(solution.result).find("\"delay_s\": 0.003"), std::string::npos);
}

TEST(ClusterInflation, WithoutADelayIsThatOfDelaysOfZero) {
  const auto short_one = [](Case& given) { given.inflation.duration_s = 2e-3, given.inflation.frames = 1; };
  const InflationSolution without = opened(short_one), with = opened([&](Case&given) {
                                                         short_one(given), given.cluster->delays_s = {0, 0};
                                                       });
  EXPECT_EQ(with.state.cloth.x, without.state.cloth.x);
}

TEST(ClusterInflation, RandomImperfectionsOfTheCanopiesDiffer) {
  Case given = two_canopies();
  given.inflation.imperfection_m = 0.01, given.inflation.imperfection_seed = 1;
  const Settings resolved = resolve(opening_case(checked(given)));
  const InflationProblem both = problem_of(resolved);
  ThreadTeam team(1);
  const OpeningCloth one(both.mesh, both.settings, {}, both.symmetry, false, team, {}),
      two(both.mesh, both.settings, {}, both.symmetry, false, team, both.cluster);
  const std::vector<Vec3> alone = one.upright(positions(one.start(), one.open())).front();
  const auto canopies = two.upright(positions(two.start(), two.open()));
  double same = 0, other = 0;
  // Without the rotation that brings the centre of the skirt to the axis, which is small.
  for (std::size_t n = 0; n < alone.size(); ++n) {
    same = std::max(same, norm(canopies[0][n] - alone[n]));
    other = std::max(other, norm(canopies[1][n] - canopies[0][n]));
  }
  EXPECT_LT(same, 0.002);
  EXPECT_GT(other, 0.005);
}

TEST(ClusterInflation, RefusesUniformPressureReefingAndDeployment) {
  const auto refused = [](const std::function<void(Case&)>& edit) {
    Case given = two_canopies();
    edit(given);
    const Settings resolved = resolve(opening_case(checked(given)));
    return refusal_of([&] { problem_of(resolved); }, ExitCode::usage);
  };
  const auto uniform = [](Case& given) {
    given.inflation.air = AirModel::uniform, given.inflation.pressure_pa = 100;
  };
  const auto reefed = [](Case& given) { given.inflation.reefing = {{1.4, 3e-3, {}}}; };
  const auto deployed = [](Case& given) {
    given.deployment.emplace(), given.payload.mass_kg = 2, given.payload.deployment_speed_m_s = 20;
    given.inflation.initial_radius_m.reset();
  };
  EXPECT_EQ(refused(uniform).find("inflation.air = \"uniform\""), 0u) << refused(uniform);
  EXPECT_EQ(refused(reefed).find("inflation.reefing"), 0u) << refused(reefed);
  EXPECT_EQ(refused(deployed).find("deployment"), 0u) << refused(deployed);
  const auto too_late = [](Case& given) { given.cluster->delays_s = {0, 6e-3}; };
  EXPECT_EQ(
      refused(too_late).find("cluster.delays_s[1] = 0.006: must be below inflation.duration_s = 0.006 s"), 0u)
      << refused(too_late);
}

TEST(ClusterInflation, InAFolderHasARowForEachCanopy) {
  const TemporaryFolder folder("cluster-inflation");
  Case given = two_canopies();
  given.inflation.duration_s = 2e-3, given.inflation.frames = 1;
  const Settings resolved = resolve(opening_case(checked(given)));
  InflationObserver nobody;
  InflationFolderSettings settings;
  settings.run.folder = folder.path / "run", settings.threads = 1;
  ASSERT_TRUE(run_inflation_in(
      settings, resolved, load_source(resolved), [&] { return problem_of(resolved); }, nobody));
  const CsvTable rows = read_csv(folder.path / "run" / "canopies.csv");
  EXPECT_GE(rows.rows.size(), 2u);
  EXPECT_EQ(rows.rows.size() % 2, 0u);
  EXPECT_NE(read_file(folder.path / "run" / "result.json").find("peak_riser_load_n"), std::string::npos);
}

}  // namespace
}  // namespace ripstop
