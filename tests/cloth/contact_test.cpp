// Cloth in contact: potential, momentum and energy, no penetration; and its measure.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "builders.h"
#include "ripstop/cloth/step_memory.h"

namespace ripstop {
namespace {

using namespace testing;

constexpr double node_spacing = 0.01;  // [m]

/// Two square sheets, one `height` above the other, which is wider by a cell at every side.
Mesh two_sheets(double height, int cells = 12) {
  Mesh mesh;
  for (const int more : {2, 0}) {
    PatchSpec spec;
    spec.name = more == 0 ? "upper" : "lower";
    spec.rows = spec.columns = cells + 1 + more;
    const double shift = more == 0 ? 0 : -node_spacing;
    spec.position = [=](int row, int column) {
      // Not node above node, as no two layers lie.
      const double askew = more == 0 ? 0.3 * node_spacing : 0;
      return Vec3{column * node_spacing + shift + askew, row * node_spacing + shift, more == 0 ? height : 0};
    };
    add_patch(mesh, spec, {});
  }
  return mesh;
}

ClothOptions with_contact(const Mesh& mesh, double friction = 0.2) {
  ClothOptions options;
  options.contact = ContactOptions{20e3, friction, mesh.start};
  return options;
}

std::vector<Vec3> lowered(const Mesh& mesh, double by) {
  std::vector<Vec3> x = mesh.start;
  for (int i = mesh.patches[1].first_node; i < mesh.node_count(); ++i) x[i].z -= by;
  return x;
}

/// Folded over along a line, the one half near the other.
std::vector<Vec3> folded_over(const Mesh& mesh, double apart) {
  double low = mesh.start[0].x, high = low;
  for (const Vec3 x : mesh.start) low = std::min(low, x.x), high = std::max(high, x.x);
  std::vector<Vec3> x = mesh.start;
  for (Vec3& p : x)
    if (p.x > 0.5 * (low + high)) p.x = low + high - p.x, p.z += apart;
  return x;
}

// Sheets as cut one spacing apart are neighbours within one piece, but not as two pieces, such as two canopies.
TEST(Contact, PiecesThatAreCutNextToEachOtherTouch) {
  Mesh mesh = two_sheets(node_spacing);
  const auto energy = [&] {
    const ClothPtr cloth = make_cloth(mesh, with_contact(mesh));
    ClothState state = start_state(*cloth);
    set_positions(state, *cloth, lowered(mesh, 0.7 * node_spacing));
    return contact_report(*cloth, state).energy;
  };
  EXPECT_EQ(energy(), 0);
  mesh.patches[1].piece = 1;
  EXPECT_GT(energy(), 0);
}

TEST(Contact, TheForceIsMinusTheGradientOfTheEnergy) {
  const Mesh mesh = two_sheets(5 * node_spacing);
  const ClothPtr touching = make_cloth(mesh, with_contact(mesh)), free = make_cloth(mesh);
  ClothState state = start_state(*touching);
  const std::vector<Vec3> x = lowered(mesh, 4.5 * node_spacing);
  set_positions(state, *touching, x);
  EXPECT_GT(contact_report(*touching, state).pairs, 100);
  EXPECT_GT(elastic_energy(*touching, state), 0);
  ASSERT_NEAR(contact_report(*free, state).pairs, 0, 0);
  constexpr double dt = 1e-9, h = 1e-7;
  ThreadTeam team(1);
  ClothState kicked = state;
  step(kicked, *touching, {}, dt, 1, team);
  const std::vector<Vec3> v = velocities(kicked, *touching);
  double largest = 0;
  for (const int node : {20, 100, 150, mesh.patches[1].first_node + 5, mesh.patches[1].first_node + 84}) {
    const auto energy = [&](Vec3 shift) {
      std::vector<Vec3> moved = x;
      moved[node] += shift;
      set_positions(state, *touching, moved);
      return contact_report(*touching, state).energy;
    };
    const Vec3 force = (mesh.mass[node] / dt) * v[node];
    const Vec3 slope{(energy({h, 0, 0}) - energy({-h, 0, 0})) / (2 * h),
                     (energy({0, h, 0}) - energy({0, -h, 0})) / (2 * h),
                     (energy({0, 0, h}) - energy({0, 0, -h})) / (2 * h)};
    EXPECT_LT(norm(force + slope), 1e-5 * norm(force) + 1e-7) << node;
    largest = std::max(largest, norm(force));
  }
  EXPECT_GT(largest, 0.1);
}

TEST(Contact, TheFoldedStartHasNoForce) {
  const Mesh mesh = rectangle(9, 30, node_spacing);
  ClothOptions options = with_contact(mesh);
  options.contact->folded = folded_over(mesh, 0.1 * node_spacing);
  const ClothPtr cloth = make_cloth(mesh, options);
  ClothState state = start_state(*cloth);
  set_positions(state, *cloth, options.contact->folded);
  EXPECT_LT(contact_report(*cloth, state).energy, 1e-20);
  set_positions(state, *cloth, folded_over(mesh, 0.05 * node_spacing));
  EXPECT_GT(contact_report(*cloth, state).energy, 1e-9) << "a little nearer";
}

struct Collision {
  double pierced, gap, momentum_error, energy_before, energy_after, damped;
};

/// Thrown onto each other at `speed` down and `across` it, for as long as they would take to pass each other twice.
Collision thrown(bool contact, double speed, double across, double friction = 0.2) {
  const Mesh mesh = two_sheets(4 * node_spacing);
  const ClothPtr cloth = make_cloth(mesh, contact ? with_contact(mesh, friction) : ClothOptions{});
  ClothState state = start_state(*cloth);
  std::vector<Vec3> v(mesh.node_count());
  for (int i = mesh.patches[1].first_node; i < mesh.node_count(); ++i) v[i] = {0, across, -speed};
  set_velocities(state, *cloth, v);
  const Vec3 before = momentum(*cloth, state);
  Collision result{0, 0, 0, kinetic_energy(*cloth, state), 0, 0};
  ThreadTeam team(2);
  StepRecord record;
  const double dt = 0.3 * stability_limit(*cloth, state).stable_step;
  const int blocks = 40, steps = static_cast<int>(8 * node_spacing / speed / dt / blocks);
  for (int block = 0; block < blocks; ++block) {
    step(state, *cloth, {}, dt, steps, team, &record);
    result.pierced = std::max(result.pierced, pierced_share(mesh, positions(state, *cloth)));
  }
  const std::vector<Vec3> x = positions(state, *cloth);
  const int lower = mesh.patches[1].first_node, upper = mesh.node_count() - lower;
  for (int i = 0; i < mesh.node_count(); ++i) result.gap += i < lower ? -x[i].z / lower : x[i].z / upper;
  result.momentum_error = norm(momentum(*cloth, state) - before) / norm(before);
  result.energy_after = kinetic_energy(*cloth, state) + elastic_energy(*cloth, state);
  result.damped = record.damped;
  return result;
}

TEST(Contact, SheetsThatAreThrownOntoEachOtherDoNotPass) {
  for (const double speed : {2.0, 10.0, 20.0}) {
    const Collision met = thrown(true, speed, 0);
    EXPECT_EQ(met.pierced, 0) << speed;
    EXPECT_GT(met.gap, 0.5 * node_spacing) << speed;
    EXPECT_LT(met.momentum_error, 1e-12);
    EXPECT_NEAR(met.energy_after + met.damped, met.energy_before, 0.01 * met.energy_before) << speed;
  }
  EXPECT_LT(thrown(false, 10, 0).gap, -3 * node_spacing) << "without contact they do";
}

TEST(Contact, FrictionTakesFromTheSlipAndTheBalanceCountsIt) {
  const Collision rough = thrown(true, 2, 4, 0.5), smooth = thrown(true, 2, 4, 0);
  EXPECT_NEAR(rough.energy_after + rough.damped, rough.energy_before, 0.01 * rough.energy_before);
  EXPECT_GT(rough.damped, 1.2 * smooth.damped);
  EXPECT_LT(rough.momentum_error, 1e-12);
}

// Dashpots that absorb the work of the pressure while layers are compressed: a kick of contact changes their
// velocities, and their energy in the previous step uses the velocities before it (error 0.4 % otherwise, 0.1 % so).
TEST(Contact, DamperEnergyIsCountedUpToEveryKick) {
  Mesh mesh = two_sheets(4 * node_spacing);
  const std::vector<Vec3> near = lowered(mesh, 3.4 * node_spacing);
  const int lower = mesh.patches[1].first_node, columns = mesh.patches[1].columns;
  mesh.laws.push_back({{1e-6}});
  mesh.parts.push_back("dashpot");
  for (int i = 0; i < lower; ++i) mesh.fixed.push_back(i);
  for (int i = lower; i < mesh.node_count(); ++i) {
    const int under = mesh.patches[0].node((i - lower) / columns + 1, (i - lower) % columns + 1);
    mesh.springs.push_back({under, i, norm(near[i] - near[under]), 1, 0, 0.4, 0});
  }
  ClothOptions options = with_contact(mesh);
  options.contact->folded = near;
  const ClothPtr cloth = make_cloth(mesh, options);
  Loads loads;  // presses the upper sheet down
  for (const Cell& cell : cells_of(mesh)) loads.cell_pressure.push_back(cell.corner[0] >= lower ? -2e3 : 0);
  ClothState state = start_state(*cloth);
  set_positions(state, *cloth, near);
  ThreadTeam team(2);
  StepRecord record;
  const double dt = 0.3 * stability_limit(*cloth, state).stable_step;
  step(state, *cloth, loads, dt, static_cast<int>(1.5e-3 / dt), team, &record);
  EXPECT_GT(contact_report(*cloth, state).deepest, 0.05);
  EXPECT_GT(record.damped, 0.5 * record.pressure_work);
  EXPECT_NEAR(record.damped + kinetic_energy(*cloth, state) + elastic_energy(*cloth, state),
              record.pressure_work, 0.0025 * record.pressure_work);
}

TEST(Contact, AnyNumberOfThreadsGivesTheSameBits) {
  const Mesh mesh = medley(0.02, true);
  ClothOptions options = with_contact(mesh);
  options.absolute_damping = 2;
  const ClothPtr cloth = make_cloth(mesh, options);
  std::vector<ClothState> states;
  std::vector<double> damped;
  for (const int threads : {1, 2, 3}) {
    ThreadTeam team(threads);
    ClothState state = start_state(*cloth);
    set_positions(state, *cloth, folded_over(mesh, 0.3 * node_spacing));
    EXPECT_GT(contact_report(*cloth, state).pairs, 5);
    StepRecord record;
    step(state, *cloth, {}, 0.2 * stability_limit(*cloth, state).stable_step, 100, team, &record);
    states.push_back(state);
    damped.push_back(record.damped);
  }
  for (const std::size_t other : {1, 2}) {
    EXPECT_EQ(positions(states[other], *cloth).size(), positions(states[0], *cloth).size());
    for (int i = 0; i < mesh.node_count(); ++i) {
      const Vec3 a = positions(states[0], *cloth)[i], b = positions(states[other], *cloth)[i];
      EXPECT_TRUE(a.x == b.x && a.y == b.y && a.z == b.z) << i;
    }
    EXPECT_EQ(damped[other], damped[0]);
  }
}

TEST(Contact, TheListOfAnEarlierCallDoesNotChangeTheMotion) {
  const Mesh mesh = two_sheets(5 * node_spacing);
  const ClothPtr cloth = make_cloth(mesh, with_contact(mesh));
  ClothState start = start_state(*cloth);
  set_positions(start, *cloth, lowered(mesh, 4.5 * node_spacing));
  const double dt = 0.2 * stability_limit(*cloth, start).stable_step;
  ThreadTeam team(1);
  const auto stepped = [&](StepMemory& memory, StepRecord& record) {
    ClothState state = start;
    step(state, *cloth, {}, dt, 100, team, &record, memory);
    return state;
  };
  StepMemory memory, anew;
  StepRecord first, kept, none;
  stepped(memory, first);
  ASSERT_TRUE(memory.contact);
  const Contact* list = memory.contact.get();
  const ClothState a = stepped(memory, kept), b = stepped(anew, none);
  EXPECT_EQ(memory.contact.get(), list);
  EXPECT_TRUE(a.x == b.x && a.v == b.v);
  EXPECT_GT(none.damped, 0);
  EXPECT_EQ(kept.damped, none.damped) << "that of this call only";
}

TEST(Contact, AStepIsNoLongerThanItAllows) {
  const Mesh mesh = two_sheets(5 * node_spacing);
  ClothOptions options = with_contact(mesh);
  const ClothPtr soft = make_cloth(mesh, options);
  options.contact->pressure = 1e9;
  const ClothPtr hard = make_cloth(mesh, options);
  const StabilityLimit free = stability_limit(*soft, start_state(*soft)),
                       limit = stability_limit(*hard, start_state(*hard));
  EXPECT_EQ(free.stable_step, stability_limit(*make_cloth(mesh), start_state(*soft)).stable_step);
  EXPECT_LT(limit.stable_step, 0.5 * free.stable_step);
  EXPECT_EQ(limit.part, "contact of cloth");
}

TEST(Pierced, CountsTheEdgesThatGoThroughClothElsewhere) {
  const Mesh mesh = two_sheets(5 * node_spacing);
  EXPECT_EQ(pierced_share(mesh, mesh.start), 0);
  // The upper sheet is turned up and put through the lower one, between two of its columns.
  std::vector<Vec3> x = mesh.start;
  const int first = mesh.patches[1].first_node;
  for (int i = first; i < mesh.node_count(); ++i) x[i] = {0.043, x[i].y + 0.2 * node_spacing, x[i].x - 0.053};
  // Of the upper sheet 13 edges along z; of the lower one those along x whose y is within it: 12.
  const double edges = 2.0 * (14 * 15 + 12 * 13);
  EXPECT_NEAR(pierced_share(mesh, x), (13 + 12) / edges, 1e-12);
}

TEST(Pierced, IgnoresCellsWithinThreeEdges) {
  const Mesh mesh = rectangle(5, 30, node_spacing);
  std::vector<Vec3> near = mesh.start, far = mesh.start;
  const auto bend = [&](std::vector<Vec3>& x, int from) {
    for (int i = 0; i < mesh.node_count(); ++i)  // back through the sheet
      if (i % 30 >= from)
        x[i] = {mesh.start[10].x + 0.4 * node_spacing, x[i].y + 0.2 * node_spacing,
                (i % 30 - from - 0.5) * node_spacing};
  };
  bend(near, 12);
  bend(far, 20);
  EXPECT_EQ(pierced_share(mesh, near), 0);
  EXPECT_GT(pierced_share(mesh, far), 0);
}

}  // namespace
}  // namespace ripstop
