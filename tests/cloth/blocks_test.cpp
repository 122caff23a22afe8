// The blocks in which wrinkling cloth moves while it is relaxed.
#include "ripstop/cloth/blocks.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <random>
#include <set>
#include <string>

#include "builders.h"
#include "ripstop/cloth/kernel.h"

namespace ripstop {
namespace {

using namespace testing;

AlignedDoubles random_numbers(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> to(-1, 1);
  AlignedDoubles result(count);
  for (double& x : result) x = to(random);
  return result;
}

TEST(Blocks, EveryFreeNodeBelongsToOneAndFixedNodesToNone) {
  const Mesh mesh = medley(0, true);
  const ClothPtr cloth = make_cloth(mesh);
  const Blocks blocks(*cloth);
  std::set<int> met;
  for (int node = 0; node < mesh.node_count(); ++node) {
    const int block = blocks.block_of(node);
    EXPECT_EQ(block >= 0, !cloth->is_fixed[node] && !cloth->is_tied[node]) << node;
    EXPECT_LT(block, blocks.count());
    if (block >= 0) met.insert(block);
  }
  EXPECT_EQ(static_cast<int>(met.size()), blocks.count());
  for (std::size_t k = 0; k < cloth->irregular.size(); ++k) {
    const int block = blocks.block_of(cloth->irregular[k].node);
    if (block < 0) continue;
    EXPECT_EQ(blocks.block_of_sum(blocks.sum_of_irregular(static_cast<int>(k))), block) << k;
  }
}

// With r = C y: (I y)^T K I y <= y . r, the left side from the energy of the cloth that moves with its blocks.
TEST(Blocks, TheirStiffnessBoundsThatOfTheClothThatMovesWithThem) {
  Mesh mesh = medley(0, true);
  for (Vec3& x : mesh.start) x = 1.01 * x;
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  Blocks blocks(*cloth);
  ThreadTeam team(2);
  blocks.set_stiffness(*cloth, state, {}, 1, team);
  const int padded = blocks.padded();
  const std::vector<Vec3> x = positions(state, *cloth);
  const auto energy = [&](const AlignedDoubles& y, double step) {
    std::vector<Vec3> moved = x;
    for (int node = 0; node < mesh.node_count(); ++node)
      if (const int i = blocks.block_of(node); i >= 0)
        moved[node] += step * Vec3{y[i], y[padded + i], y[2 * padded + i]};
    set_positions(state, *cloth, moved);
    return elastic_energy(*cloth, state);
  };
  double largest = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    AlignedDoubles r = random_numbers(3 * padded, seed), y(r.size());
    for (int axis = 0; axis < 3; ++axis)
      for (int i = blocks.count(); i < padded; ++i) r[axis * padded + i] = 0;
    multiply_blocks({padded, blocks.inverse(), r.data(), y.data()}, 0, padded);
    double bound = 0, size = 0;
    for (std::size_t i = 0; i < r.size(); ++i) bound += r[i] * y[i], size = std::max(size, std::abs(y[i]));
    const double step = 1e-5 / size;
    const double curvature = (energy(y, step) - 2 * energy(y, 0) + energy(y, -step)) / (step * step);
    EXPECT_LT(curvature, bound) << seed;
    largest = std::max(largest, curvature / bound);
  }
  EXPECT_GT(largest, 0.25);
}

TEST(Blocks, TheirKernelsAgreeWithPlainCodeOnEveryInstructionSet) {
  const int vectors = 7, chunks = 3, padded = 48;
  const std::vector<int> edge = {0, 2, 5, 7};
  const std::size_t row = 3 * lanes * vectors;
  AlignedDoubles inverse_mass = random_numbers(2 * row, 1);
  const AlignedDoubles f = random_numbers(row, 2), motion = random_numbers(3 * lanes * chunks, 3);
  const AlignedDoubles matrix = random_numbers(padded * padded, 4), r = random_numbers(3 * padded, 5);
  const auto moves = [&](int vector, int lane) { return inverse_mass[6 * lanes * vector + lane] > 0; };
  std::set<std::string> tried;
  for (const auto target : {HWY_AVX3, HWY_AVX2, HWY_SSE4, HWY_SCALAR}) {
    if ((hwy::SupportedTargets() & target) == 0 && target != HWY_SCALAR) continue;
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    tried.insert(kernel_target());
    SCOPED_TRACE(kernel_target());
    AlignedDoubles sum(3 * lanes * chunks), x = random_numbers(row, 6), v = random_numbers(row, 7),
                                            y(3 * padded);
    const AlignedDoubles x0 = x, v0 = v;
    sum_blocks({chunks, edge.data(), inverse_mass.data(), f.data(), sum.data()});
    move_blocks({chunks, edge.data(), inverse_mass.data(), motion.data(), x.data(), v.data()});
    multiply_blocks({padded, matrix.data(), r.data(), y.data()}, 0, padded);
    for (int chunk = 0; chunk < chunks; ++chunk)
      for (int lane = 0; lane < lanes; ++lane)
        for (int axis = 0; axis < 3; ++axis) {
          const int in_chunk = axis * lanes + lane;
          double expected = 0;
          for (int m = edge[chunk]; m < edge[chunk + 1]; ++m) {
            const int i = 3 * lanes * m + in_chunk;
            if (moves(m, lane)) expected += f[i];
            const double u = moves(m, lane) ? motion[3 * lanes * chunk + in_chunk] : 0.0;
            EXPECT_EQ(x[i], x0[i] + u);
            EXPECT_EQ(v[i], v0[i] + u);
          }
          EXPECT_NEAR(sum[3 * lanes * chunk + in_chunk], expected, 1e-14);
        }
    for (int i = 0; i < padded; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        double expected = 0;
        for (int j = 0; j < padded; ++j)
          expected += matrix[lanes * (i / lanes * padded + j) + i % lanes] * r[axis * padded + j];
        EXPECT_NEAR(y[axis * padded + i], expected, 1e-13);
      }
    hwy::SetSupportedTargetsForTest(0);
  }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  EXPECT_GE(tried.size(), 2u);
}

// A tied node, lines of nodes outside the patch: everything that blocks have to follow.
TEST(Blocks, ARelaxationWithThemIsTheSameToTheLastBitOnAnyNumberOfThreads) {
  FabricSpec fabric;
  fabric.buckling_strain = 1e-6;
  Mesh mesh = rectangle(31, 33, 0.01, fabric);
  const Patch& p = mesh.patches[0];
  mesh.laws.push_back({{2000}, 0});
  mesh.parts = {"line"};
  for (const int corner : {p.node(0, 0), p.node(0, 32), p.node(30, 0), p.node(30, 32)}) {
    const Vec3 outward = 0.1 * (mesh.start[corner] - mesh.start[p.node(15, 16)]);
    int last = corner;
    for (int i = 0; i < 5; ++i) {
      mesh.start.push_back(mesh.start[last] + outward);
      mesh.mass.push_back(1e-5);
      mesh.springs.push_back({last, mesh.node_count() - 1, 1.05 * norm(outward), 1, 0, 0, 0});
      last = mesh.node_count() - 1;
    }
    mesh.fixed.push_back(last);
  }
  mesh.ties.push_back({p.node(12, 12), {{p.node(12, 11), 0.5}, {p.node(12, 13), 0.5}}});
  const ClothPtr cloth = make_cloth(mesh);
  const Loads loads{std::vector<double>(mesh.cell_count(), 20.0), {}};
  const auto relaxed = [&](int threads) {
    ClothState state = start_state(*cloth);
    ThreadTeam team(threads);
    relax(state, *cloth, loads, {1e-4, 250}, team);
    return positions(state, *cloth);
  };
  const std::vector<Vec3> alone = relaxed(1);
  for (const int threads : {2, 3}) EXPECT_EQ(relaxed(threads), alone) << threads;
}

}  // namespace
}  // namespace ripstop
