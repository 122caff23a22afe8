// Cloth and air stepped together, against the equations of a piston and of a bag.
#include "ripstop/fsi/coupled_flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "../blown_up.h"
#include "ripstop/core/error.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flight/trajectory.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/fsi/adaptive_stepper.h"
#include "ripstop/fsi/coupled_step.h"
#include "ripstop/fsi/transfer.h"

namespace ripstop {
namespace {

constexpr double duct_speed = 10, resistance = 40, springs = 2000;  // [m/s], [Pa s/m], [Pa/m]

/// 1 m2, as high and wide as `cells` of them.
FlowProblem closed_duct(double speed = duct_speed, double linear = resistance, int cells = 4) {
  FlowProblem duct;
  duct.grid = {{0, 0, 0}, {1, 1, 2}, cells, cells, 4 * cells};
  duct.air.velocity = {0, 0, speed};
  duct.sides = Sides::slip;
  duct.outlet = Outlet::still_air;
  duct.bodies = {sheet_body({}, {linear, 0})};
  return duct;
}

/// Payload::density_ratio from a height of deployment on [m].
std::function<double(double)> density_ratio_below(double height) {
  return [height](double fallen) { return density_ratio(height, fallen); };
}

constexpr double sheet_at = 1.01;  // along the duct [m]

/// A square of cloth of n x n nodes across the duct: yarns of `stiffness` [N/m] each way and no shear; without any it
/// has no springs in its plane.
Mesh across_the_duct(int n, double mass, double stiffness) {
  const double spacing = 1.0 / (n - 1);
  Mesh mesh;
  Patch patch;
  patch.rows = patch.columns = n;
  patch.cell_area.assign(n * n, 0.0);
  for (int d = 0; d < direction_count; ++d) {
    patch.law[d].coefficients = {stiffness > 0 ? stiffness : 1};
    patch.rest_length[d].assign(n * n, spacing), patch.width[d].assign(n * n, 0.0);
  }
  for (int r = 0; r < n; ++r) {
    for (int c = 0; c < n; ++c) {
      const double share = (r % (n - 1) ? 1 : 0.5) * (c % (n - 1) ? 1 : 0.5) * spacing * spacing;
      mesh.start.push_back({c * spacing, r * spacing, sheet_at});
      mesh.mass.push_back(mass * share);
      if (r < n - 1 && c < n - 1) patch.cell_area[r * n + c] = spacing * spacing;
      if (stiffness > 0) {
        patch.width[along_row][r * n + c] = c < n - 1 ? spacing : 0;
        patch.width[along_column][r * n + c] = r < n - 1 ? spacing : 0;
      }
    }
  }
  mesh.patches.push_back(patch);
  return mesh;
}

/// Every node on a spring along the duct: under one pressure the cloth moves as a piston does.
Mesh piston(double mass) {
  constexpr int n = 5;
  constexpr double length = 4;  // of the springs, to be linear
  Mesh mesh = across_the_duct(n, mass, 0);
  mesh.laws.emplace_back().coefficients = {springs * length};
  mesh.parts = {"spring"};
  for (int i = 0; i < n * n; ++i) {
    const Vec3 at = mesh.start[i];
    mesh.start.push_back(at - Vec3{0, 0, length}), mesh.mass.push_back(1);
    mesh.fixed.push_back(n * n + i);
    Spring spring;
    spring.a = n * n + i, spring.b = i, spring.rest_length = length;
    spring.scale = mesh.mass[i] / mass;
    mesh.springs.push_back(spring);
  }
  return mesh;
}

CartesianSettings one_thread() {
  CartesianSettings settings;
  settings.threads = 1, settings.compressible = false;
  return settings;
}

/// Cloth and air in turn, as an opening steps them.
class Together {
 public:
  Together(const FlowProblem& flow, const Mesh& mesh)
      : x(mesh.start), air_({flow, 0.5, make_cartesian(one_thread())}, mesh), cloth_(make_cloth(mesh)) {}

  /// The cloth takes `least` steps or more, `share` of its stable one at most.
  void step(double length, int least, double share) {
    const double stable = share * stability_limit(*cloth_, state_).stable_step;
    const int steps = std::max(least, static_cast<int>(std::ceil(length / stable)));
    const ClothMotion motion =
        predict_motion(state_, *cloth_, air_.last_load({}, memory_), length, steps, team_, step_memory_);
    air_.step(x, motion, length, {}, memory_);
    double residual_traction = 0;
    loads = air_.transfer(x, {}, memory_, residual_traction);
    ripstop::step(state_, *cloth_, loads, length / steps, steps, team_);
    x = positions(state_, *cloth_);
  }

  std::vector<Vec3> x;
  Loads loads;

 private:
  CoupledFlow air_;
  ClothPtr cloth_;
  ThreadTeam team_{1};
  ClothState state_ = start_state(*cloth_);
  AirMemory memory_;
  StepMemory step_memory_;
};

/// How far the piston has come after `duration`, in steps of the air of `step`; the cloth takes `least` steps or more
/// in each.
double piston_moved(double mass, double step, double duration, int least) {
  Together duct(closed_duct(), piston(mass));
  for (int n = 0; n < std::lround(duration / step); ++n) duct.step(step, least, 0.2);
  return duct.x[12].z - sheet_at;
}

/// m x'' = a (U - x') - k x from rest.
double exactly_moved(double mass, double duration) {
  constexpr int steps = 400000;
  const double dt = duration / steps;
  double x = 0, v = 0;
  for (int n = 0; n < steps; ++n) {  // the midpoint rule, implicit in v
    const double next = (v * (1 - 0.5 * dt * resistance / mass) +
                         dt / mass * (resistance * duct_speed - springs * (x + 0.25 * dt * v))) /
                        (1 + 0.5 * dt * resistance / mass + 0.25 * dt * dt * springs / mass);
    x += 0.5 * dt * (v + next);
    v = next;
  }
  return x;
}

constexpr double piston_duration = 0.02;

// From cloth a hundred times lighter than nylon to cloth a hundred times heavier, with one step: a load that is
// handed over after the step would throw the lightest a hundred times too far. Where the cloth takes but one step of
// its own in each of the air's, its own error, of first order, is the larger.
TEST(CoupledFlow, APistonOfAnyMassFollowsItsEquation) {
  constexpr double step = 2.5e-4;
  for (const double mass : {4e-4, 4e-3, 0.04, 0.4, 4.0}) {
    const double right = exactly_moved(mass, piston_duration);
    EXPECT_NEAR(piston_moved(mass, step, piston_duration, 40) / right, 1, 0.003) << mass;
    EXPECT_NEAR(piston_moved(mass, step, piston_duration, 1) / right, 1, 0.012) << mass;
  }
}

// Where the step resolves the free motion of the cloth, half the step has a quarter of the error.
TEST(CoupledFlow, StepsOfAirAndClothTogetherAreOfSecondOrder) {
  constexpr double step = 1e-3;
  constexpr int fine = 1500;  // the cloth's own steps are of first order
  for (const double mass : {4e-3, 0.4}) {
    const double right = exactly_moved(mass, piston_duration);
    const double long_steps = piston_moved(mass, step, piston_duration, fine) - right,
                 short_steps = piston_moved(mass, 0.5 * step, piston_duration, fine / 2) - right;
    EXPECT_GT(std::abs(long_steps), 3.5 * std::abs(short_steps)) << mass;
    EXPECT_LT(std::abs(long_steps), 0.01 * right) << mass;
  }
}

/// The piston as two layers of that mass and resistance each with opposite orientations, as the walls of a pleat, 2 cm
/// apart. Every node of one is on a spring of twice the stiffness and is connected to that of the other.
Mesh piston_of_two_layers(double mass) {
  constexpr int n = 5, layer = n * n;
  constexpr double apart = 0.02, connection = 1e5;  // [m], [Pa/m]
  Mesh mesh = piston(mass);
  const std::vector<Vec3> anchors(mesh.start.begin() + layer, mesh.start.end());
  for (Spring& spring : mesh.springs) spring.a += layer, spring.scale *= 2;
  for (int& node : mesh.fixed) node += layer;
  mesh.start.resize(layer), mesh.mass.resize(layer);
  mesh.laws.emplace_back().coefficients = {connection * apart};
  Patch other = mesh.patches[0];
  other.first_node = layer;
  mesh.patches.push_back(other);
  for (int i = 0; i < layer; ++i) {
    const int opposite = i - i % n + n - 1 - i % n;
    mesh.start.push_back(mesh.start[opposite] + Vec3{0, 0, apart}), mesh.mass.push_back(mesh.mass[opposite]);
    Spring spring;
    spring.a = opposite, spring.b = layer + i, spring.rest_length = apart, spring.law = 1;
    spring.scale = mesh.mass[i] / mass;
    mesh.springs.push_back(spring);
  }
  mesh.start.insert(mesh.start.end(), anchors.begin(), anchors.end());
  mesh.mass.insert(mesh.mass.end(), layer, 1.0);
  return mesh;
}

// The drop across two layers between the same two centres is transferred to the cloth as a traction, not as a pressure.
// It must enter the velocity that the flow expects of the cloth, else heavy air makes the layers oscillate.
TEST(CoupledFlow, TwoLayersInOneCellMoveAsAPistonHoweverHeavyTheAir) {
  constexpr double step = 2.5e-4, cell = 0.125, density = 1.2;
  for (const double heaviness : {1.0, 10.0, 100.0}) {  // rho h / m
    const double mass = density * cell / heaviness, right = exactly_moved(mass, piston_duration);
    Together duct(closed_duct(), piston_of_two_layers(mass));
    for (int n = 0; n < std::lround(piston_duration / step); ++n) duct.step(step, 10, 0.2);
    const double moved = 0.5 * (duct.x[12].z + duct.x[25 + 12].z) - sheet_at - 0.01;
    EXPECT_NEAR(moved / right, 1, 0.03) << heaviness;
  }
}

constexpr int bag_cells = 16;  // across, of cloth and of air

/// Cloth that is clamped round the duct and bulges like the end of a bag.
Mesh end_of_a_bag() {
  constexpr int n = bag_cells + 1;
  Mesh mesh = across_the_duct(n, 0.04, 6e4);
  std::fill(std::begin(mesh.patches[0].damping), std::end(mesh.patches[0].damping), 0.6);  // 1e-5 s
  for (int i = 0; i < n * n; ++i)
    if (i < n || i >= n * (n - 1) || i % n == 0 || i % n == n - 1) mesh.fixed.push_back(i);
  return mesh;
}

struct Bulge {
  double volume = 0, area = 0, pressure = 0;  // [m3], [m2]; in the mean over the cells [Pa]
};
Bulge bulge_of(const Mesh& mesh, const std::vector<Vec3>& x, const Loads& loads) {
  Bulge bulge;
  const std::vector<Triangle> surface = surface_of(cells_of(mesh), x);
  bulge.area = surface_area(surface);
  for (const Triangle& t : surface)
    bulge.volume += 0.5 * std::abs(cross(t.b - t.a, t.c - t.a).z) * ((t.a.z + t.b.z + t.c.z) / 3 - sheet_at);
  for (const double p : loads.cell_pressure) bulge.pressure += p / (bag_cells * bag_cells);
  return bulge;
}

/// Volume of the bag under a sequence of pressures, by its cloth alone.
std::vector<Bulge> blown_up_bags() {
  const Mesh mesh = end_of_a_bag();
  std::vector<Bulge> bags{bulge_of(mesh, mesh.start, {})};
  for (double pressure = 1; pressure < 2000; pressure *= 1.5) {
    const BlownUp bag = blown_up(mesh, pressure, 1e-4);
    bags.push_back(bulge_of(mesh, bag.positions(), bag.loads));
    bags.back().pressure = pressure;
  }
  return bags;
}

/// The bag of that volume: its area and its pressure's cube root go about straight in between.
Bulge bag_of(double volume, const std::vector<Bulge>& bags) {
  std::size_t n = 1;
  while (n + 1 < bags.size() && bags[n].volume < volume) ++n;
  const Bulge &a = bags[n - 1], &b = bags[n];
  const double share = (volume - a.volume) / (b.volume - a.volume);
  const double root = std::cbrt(a.pressure) + share * (std::cbrt(b.pressure) - std::cbrt(a.pressure));
  return {volume, a.area + share * (b.area - a.area), root * root * root};
}

// A bag of cloth that is filled at a constant flow Q and leaks: dV/dt = Q - p A / a, with p and A those of the same
// cloth blown up to V.
TEST(CoupledFlow, ABagBeingFilledContainsInflowMinusLeakage) {
  constexpr double flow = 1, leaks = 1000, step = 2.5e-4;
  const std::vector<Bulge> bags = blown_up_bags();
  const Mesh mesh = end_of_a_bag();
  Together duct(closed_duct(flow, leaks, bag_cells), mesh);
  double volume = 0;
  const auto fills = [&](double v) {
    const Bulge bag = bag_of(v, bags);
    return flow - bag.pressure * bag.area / leaks;
  };
  for (int n = 1; n <= 640; ++n) {
    duct.step(step, 1, 0.9);
    volume += step * fills(volume + 0.5 * step * fills(volume));
    if (n % 64 != 0) continue;
    const Bulge bag = bulge_of(mesh, duct.x, duct.loads), right = bag_of(volume, bags);
    EXPECT_NEAR(bag.volume / volume, 1, 0.02) << n;
    EXPECT_NEAR(bag.pressure, right.pressure, 20) << n;
  }
}

// Without leakage it contains the inflow, and the pressure does not oscillate from step to step.
TEST(CoupledFlow, ATightBagContainsTheInflow) {
  constexpr double flow = 1, step = 2.5e-4;
  const Mesh mesh = end_of_a_bag();
  Together duct(closed_duct(flow, 1e7, bag_cells), mesh);
  double last = 0;
  for (int n = 1; n <= 320; ++n) {
    duct.step(step, 1, 0.9);
    const Bulge bag = bulge_of(mesh, duct.x, duct.loads);
    if (n >= 64) {
      EXPECT_NEAR(bag.volume / (n * step * flow), 1, 0.012) << n;
    }
    if (n >= 200) {
      EXPECT_NEAR(bag.pressure / last, 1, 0.03) << n;
    }
    last = bag.pressure;
  }
}

TEST(CoupledFlow, IsRefusedWithoutAnEngineOrWithoutASheet) {
  const Mesh mesh = piston(0.04);
  EXPECT_THROW(CoupledFlow({closed_duct(), 0.5, nullptr}, mesh), Error);
  FlowProblem bare = closed_duct();
  bare.bodies.clear();
  EXPECT_THROW(CoupledFlow({bare, 0.5, make_cartesian({})}, mesh), Error);
}

// Under a pull that stays the same a payload falls as anything does.
TEST(CoupledFlow, APayloadIsDeceleratedByTheRiserForce) {
  constexpr double mass = 2, gravity = 9, pull = 30, step = 1e-3;
  const Mesh mesh = piston(0.04);
  const Payload payload{mass, gravity};
  CoupledFlow air({closed_duct(), 0.5, make_cartesian(one_thread())}, mesh);
  AirMemory memory;
  PayloadMotion flight;
  deploy(flight, payload, duct_speed, closed_duct().air.density);
  double speed = 0, residual_traction = 0;
  const std::vector<Vec3> still(mesh.start.size());
  for (int n = 0; n < 10; ++n) {
    const Surroundings box = in_flight(flight, payload, step);
    const FlowStep taken = air.step(mesh.start, {still}, step, box, memory);
    const Loads loads = air.transfer(mesh.start, box, memory, residual_traction);
    move_payload(flight, payload, pull, step, closed_duct().air.density);
    speed = box.stream.z;
    EXPECT_NEAR(taken.momentum_gap.z, 0, 1e-6) << n;
    // On a kilogram that the air does not touch: the frame slows down as the payload does, and both fall.
    EXPECT_NEAR(loads.node_force.back().z, n == 0 ? 0 : -pull / mass, 1e-9) << n;
  }
  // The pull of a step slows the next one down.
  EXPECT_NEAR(flight.speed, duct_speed + 10 * step * gravity - 9 * step * pull / mass, 1e-9);
  EXPECT_EQ(speed, flight.speed);
  EXPECT_NEAR(flight.path, 10 * step * duct_speed, 1e-3);
}

// A constant drag area, partly that of the payload, moves like a mass point, which has another method: in
// speed, in height, and as far as weight turns its path, through air that gets denser.
TEST(CoupledFlow, APayloadsPathTurnsAsThatOfAMassPoint) {
  constexpr double mass = 2, area = 0.05, own_area = 0.02, step = 2e-3, height = 5000;
  constexpr int steps = 20'000;
  const double density_at_deployment = standard_air(height).density;
  for (const double angle : {90.0, 30.0, 0.0, -60.0}) {
    const Payload payload{mass, standard_gravity, angle, own_area, density_ratio_below(height)};
    PayloadMotion flight;
    deploy(flight, payload, duct_speed, density_at_deployment);
    for (int n = 0; n < steps; ++n) {
      const double density = standard_air(height - flight.fallen).density;
      move_payload(flight, payload, 0.5 * density * flight.speed * flight.speed * area, step,
                   density_at_deployment);
    }
    FlightState flown{0, 0, 0, height, duct_speed, angle};
    fly(flown, mass, {[](double, double) { return area + own_area; }, steps * step, step, 0});
    EXPECT_NEAR(flight.speed / flown.speed, 1, 2e-3) << angle;
    EXPECT_NEAR(flight.angle * 180 / std::numbers::pi, flown.path_angle, 0.1) << angle;
    EXPECT_NEAR(flight.path / flown.distance, 1, 2e-3) << angle;
    const double fallen = height - flown.height;
    EXPECT_GT(fallen, 500) << "enough for a denser air to be felt";
    EXPECT_NEAR(flight.fallen / fallen, 1, 2e-3) << angle;
    if (angle == 90) {
      EXPECT_NEAR(flight.fallen, flight.path, 1e-9 * fallen);
    }
  }
}

// Nearly rigid cloth: its load is proportional to the local density.
TEST(CoupledFlow, TheLoadGoesWithTheDensityOfTheHeight) {
  constexpr double height = 5000, down = 3000;
  const Mesh mesh = piston(1e6);
  const auto first_step = [&](double fallen, double& brake) {
    const Payload payload{2, 0, 90, 0.1, density_ratio_below(height)};
    CoupledFlow air({closed_duct(), 0.5, make_cartesian(one_thread())}, mesh);
    AirMemory memory;
    PayloadMotion flight;
    flight.fallen = fallen;
    deploy(flight, payload, duct_speed, closed_duct().air.density * density_ratio(payload, fallen));
    const Surroundings box = in_flight(flight, payload, 1e-3);
    const FlowStep taken = air.step(mesh.start, {std::vector<Vec3>(mesh.start.size())}, 1e-3, box, memory);
    double residual_traction = 0;
    air.transfer(mesh.start, box, memory, residual_traction);
    brake = flight.acceleration;
    const double drag_area = taken.force.z / (0.5 * air.density() * box.stream.z * box.stream.z);
    return std::array{taken.force.z, drag_area, memory.pressure.front()};
  };
  double slow = 0, slower = 0;
  const auto high = first_step(0, slow), low = first_step(down, slower);
  const double thicker = standard_air(height - down).density / standard_air(height).density;
  EXPECT_GT(thicker, 1.3);
  EXPECT_NEAR(low[0] / high[0], thicker, 1e-3 * thicker);
  EXPECT_NEAR(low[1] / high[1], 1, 1e-3);
  EXPECT_NEAR(low[2] / high[2], thicker, 1e-3 * thicker);
  EXPECT_NEAR(slower / slow, thicker, 1e-9);
}

TEST(AdaptiveStepper, TheStabilityLimitIsThatOfTheStateAndItsCloth) {
  Mesh mesh = across_the_duct(5, 0.04, 2000);
  for (SpringLaw& law : mesh.patches[0].law) law.coefficients = {2000, 5e4};
  const ClothPtr light = make_cloth(mesh);
  for (double& mass : mesh.mass) mass *= 4;
  const ClothPtr heavy = make_cloth(mesh);
  InflationState slack, taut;
  slack.cloth = taut.cloth = start_state(*light);
  std::vector<Vec3> stretched = mesh.start;
  for (Vec3& x : stretched) x.x *= 1.2;
  set_positions(taut.cloth, *light, stretched);
  ThreadTeam team(1);
  const AdaptiveStepper stepper(AdaptiveStepper::Step::renewed, 0.9, 1e-4, team);
  const auto limit = [](const Cloth& cloth, const InflationState& state) {
    return stability_limit(cloth, state.cloth).stable_step;
  };
  ASSERT_LT(limit(*light, taut), 0.9 * limit(*light, slack));
  for (const Cloth* cloth : {light.get(), light.get(), heavy.get(), light.get()})
    for (const InflationState* state : {&slack, &slack, &taut, &slack})
      EXPECT_EQ(stepper.stable_step(*state, *cloth), limit(*cloth, *state));
}

}  // namespace
}  // namespace ripstop
