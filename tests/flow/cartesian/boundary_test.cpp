// Each boundary by itself, on fields that are set by hand.
#include "ripstop/flow/cartesian/boundary.h"

#include <gtest/gtest.h>

#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/steady.h"

namespace ripstop::cartesian {
namespace {

struct Box {
  explicit Box(Sides sides, Outlet outlet)
      : d(FlowGrid{{0, 0, 0}, {1, 1, 2}, 4, 5, 6}, air(), {}, make_sides(sides)->pressure_end()),
        b{make_inlet(d, {}), make_sides(sides), make_outlet(outlet)},
        s(d.layout) {
    double value = 1;
    for (Array<double>* q : {&s.f.u, &s.f.v, &s.f.w, &s.f.p, &s.f.k, &s.f.omega})
      for (double& x : *q) x = value += 0.01;
    std::fill(s.f.rho.begin(), s.f.rho.end(), 1.2);
  }
  static Freestream air() {
    Freestream air;
    air.velocity = {0, 0, 20};
    return air;
  }
  void ghosts() {
    for (int k = 0; k < 6; ++k)
      velocity_ghosts(d, b, s, k), pressure_ghosts(d, b, s, k), turbulence_ghosts(d, b, s, k);
  }
  std::ptrdiff_t at(int i, int j, int k) const { return d.layout.at(i, j, k); }

  Discretisation d;
  Boundaries b;
  State s;
};

// The sides admit the air around the nozzle.
TEST(Boundary, TheStreamOfAJetIsTheAirRoundItsNozzle) {
  const Box box(Sides::entraining, Outlet::still_air);
  const Inlet inlet = make_inlet(box.d, Jet{{NozzleShape::circle, 0.2, 0}, 0.1, 0.01});
  EXPECT_NEAR(inlet.stream.velocity.z, 0.1 * 20, 1e-12);
  EXPECT_NEAR(inlet.w[box.d.layout.in_plane(3, 4)], inlet.stream.velocity.z,
              1e-9);  // a corner, far from the axis
}

TEST(Boundary, TheFaceOfTheInletHasTheStreamsValues) {
  Box box(Sides::zero_gradient, Outlet::fixed_pressure);
  box.ghosts();
  const auto in_face = [&](const Array<double>& q) {
    return 0.5 * (q[box.at(1, 2, 0)] + q[box.at(1, 2, -1)]);
  };
  EXPECT_NEAR(in_face(box.s.f.w), 20, 1e-12);
  EXPECT_NEAR(in_face(box.s.f.u), 0, 1e-12);
  EXPECT_NEAR(in_face(box.s.f.k), 1.5 * 0.1 * 0.1, 1e-12);
  EXPECT_EQ(box.s.f.p[box.at(1, 2, -1)], box.s.f.p[box.at(1, 2, 0)]);
}

// In the face of the outlet, outflow has the values of the last cell; inflow has no velocity and the
// turbulence of the stream.
TEST(Boundary, AirThatFlowsBackThroughTheOutletIsAtRest) {
  Box box(Sides::zero_gradient, Outlet::fixed_pressure);
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 4; ++i) box.s.f.fz[box.at(i, j, 6)] = (i + j) % 2 == 0 ? 3 : -3;
  box.ghosts();
  const Inlet& in = box.b.inlet;
  const Fields& f = box.s.f;
  ASSERT_GT(in.stream.k, 0);
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 4; ++i) {
      const bool leaves = (i + j) % 2 == 0;
      const auto expect_in_face = [&](const Array<double>& q, double back) {
        const double last = q[box.at(i, j, 5)], face = 0.5 * (last + q[box.at(i, j, 6)]);
        EXPECT_NEAR(face, leaves ? last : back, 1e-12 * std::max(1.0, back)) << i << " " << j;
      };
      expect_in_face(f.u, 0), expect_in_face(f.v, 0), expect_in_face(f.w, 0);
      expect_in_face(f.k, in.stream.k), expect_in_face(f.omega, in.stream.omega);
    }
}

TEST(Boundary, AJetLeavesTheInletInsideItsNozzleAndNextToStillAirOutsideOfIt) {
  Box box(Sides::entraining, Outlet::still_air);
  const Jet jet{{NozzleShape::rectangle, 1, 0.8}, 0.1, 1e-6};
  box.b.inlet = make_inlet(box.d, jet);
  box.s.f.fx[box.at(0, 2, 3)] = 3;  // in through a side
  box.ghosts();
  const auto in_face = [&](int i, int j) {
    return 0.5 * (box.s.f.w[box.at(i, j, 0)] + box.s.f.w[box.at(i, j, -1)]);
  };
  EXPECT_NEAR(in_face(0, 0), 20, 1e-9);  // cells of 0.25 x 0.2 m; the nozzle ends between them
  EXPECT_NEAR(in_face(1, 1), 20, 1e-9);
  EXPECT_NEAR(in_face(2, 1), 2, 1e-9);
  EXPECT_NEAR(in_face(1, 2), 2, 1e-9);
  EXPECT_NEAR(box.b.inlet.mean_speed, 2 + 0.2 * 18, 1e-9);
  EXPECT_EQ(box.s.f.w[box.at(-1, 2, 3)], box.b.inlet.stream.velocity.z);
}

TEST(Boundary, TheDensityOfEveryOutermostCellIsThatBeyondIt) {
  Box box(Sides::slip, Outlet::fixed_pressure);
  for (int k = 0; k < 6; ++k)
    for (int j = 0; j < 5; ++j)
      for (int i = 0; i < 4; ++i) box.s.f.rho[box.at(i, j, k)] = 1 + 0.1 * i + 0.01 * j + 0.001 * k;
  box.ghosts();
  const Array<double>& rho = box.s.f.rho;
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(rho[box.at(i, j, -1)], rho[box.at(i, j, 0)]) << i << " " << j;
      EXPECT_EQ(rho[box.at(i, j, 6)], rho[box.at(i, j, 5)]) << i << " " << j;
    }
  for (int k = 0; k < 6; ++k) {
    EXPECT_EQ(rho[box.at(1, -1, k)], rho[box.at(1, 0, k)]) << k;
    EXPECT_EQ(rho[box.at(-1, 2, k)], rho[box.at(0, 2, k)]) << k;
  }
}

TEST(Boundary, NothingPassesASlipSideAndNothingChangesAcrossAnOpenOne) {
  for (const Sides sides : {Sides::slip, Sides::zero_gradient}) {
    Box box(sides, Outlet::fixed_pressure);
    box.ghosts();
    const double mirror = sides == Sides::slip ? -1 : 1;
    EXPECT_EQ(box.s.f.u[box.at(-1, 2, 3)], mirror * box.s.f.u[box.at(0, 2, 3)]);
    EXPECT_EQ(box.s.f.v[box.at(2, 5, 3)], mirror * box.s.f.v[box.at(2, 4, 3)]);
    EXPECT_EQ(box.s.f.w[box.at(4, 2, 3)], box.s.f.w[box.at(3, 2, 3)]);
    EXPECT_EQ(box.s.f.p[box.at(4, 2, 3)], box.s.f.p[box.at(3, 2, 3)]);
  }
}

TEST(Boundary, AirThatIsEntrainedHasTheStreamsSpeedAndTotalPressure) {
  Box box(Sides::entraining, Outlet::still_air);
  box.s.f.fx[box.at(0, 2, 3)] = 3;  // in through the low side, out through the high one
  box.s.f.fx[box.at(4, 2, 3)] = 2;
  box.ghosts();
  EXPECT_EQ(box.s.f.w[box.at(-1, 2, 3)], 20);
  EXPECT_EQ(box.s.f.w[box.at(4, 2, 3)], box.s.f.w[box.at(3, 2, 3)]);
  const auto in_face = [&](int ghost, int cell) {
    return 0.5 * (box.s.f.p[box.at(ghost, 2, 3)] + box.s.f.p[box.at(cell, 2, 3)]);
  };
  EXPECT_NEAR(in_face(-1, 0), -0.5 * 3 * 3 / 1.2, 1e-12);
  EXPECT_NEAR(in_face(4, 3), 0, 1e-12);
}

// For inflow through a side, only the velocity normal to the side is that of the air just inside.
TEST(Boundary, EachSideAdmitsTheStreamAndReleasesTheAirInside) {
  for (const double inflow : {3.0, -3.0}) {
    Box box(Sides::entraining, Outlet::still_air);
    Fields& f = box.s.f;
    f.fx[box.at(0, 2, 3)] = inflow, f.fx[box.at(4, 2, 3)] = -inflow;
    f.fy[box.at(2, 0, 3)] = inflow, f.fy[box.at(2, 5, 3)] = -inflow;
    box.ghosts();
    const Inlet& in = box.b.inlet;
    const struct {
      std::ptrdiff_t ghost, cell;
      bool across_x;
    } sides[] = {{box.at(-1, 2, 3), box.at(0, 2, 3), true},
                 {box.at(4, 2, 3), box.at(3, 2, 3), true},
                 {box.at(2, -1, 3), box.at(2, 0, 3), false},
                 {box.at(2, 5, 3), box.at(2, 4, 3), false}};
    for (const auto& side : sides) {
      const auto expect_beyond = [&](const Array<double>& q, double stream, bool across) {
        EXPECT_EQ(q[side.ghost], inflow > 0 && !across ? stream : q[side.cell])
            << inflow << " " << side.ghost;
      };
      expect_beyond(f.u, 0, side.across_x), expect_beyond(f.v, 0, !side.across_x);
      expect_beyond(f.w, in.stream.velocity.z, false);
      expect_beyond(f.k, in.stream.k, false), expect_beyond(f.omega, in.stream.omega, false);
    }
  }
}

TEST(Boundary, AirThatComesBackThroughTheOutletIsAtRestOrHasTheTotalPressureOfStillAir) {
  for (const Outlet outlet : {Outlet::fixed_pressure, Outlet::still_air}) {
    Box box(Sides::slip, outlet);
    box.s.f.fz[box.at(1, 2, 6)] = -6, box.s.f.fz[box.at(2, 2, 6)] = 6;
    for (int n = 0; n < 60; ++n) box.ghosts();  // the outlet's pressure follows the flux in halves
    const bool still = outlet == Outlet::still_air;
    const auto in_face = [&](const Array<double>& q, int i) {
      return 0.5 * (q[box.at(i, 2, 5)] + q[box.at(i, 2, 6)]);
    };
    EXPECT_NEAR(in_face(box.s.f.p, 1), still ? -0.5 * 36 / 1.2 : 0, 1e-9);
    EXPECT_NEAR(in_face(box.s.f.w, 1), still ? box.s.f.w[box.at(1, 2, 5)] : 0, 1e-12);
    EXPECT_NEAR(in_face(box.s.f.p, 2), 0, 1e-9);
    EXPECT_EQ(box.s.f.w[box.at(2, 2, 6)], box.s.f.w[box.at(2, 2, 5)]);
  }
}

TEST(Boundary, TheLedgerOfAUniformStreamIsZeroAndOfAStepItsPressureAndMomentum) {
  Box box(Sides::slip, Outlet::still_air);
  const auto fill = [](Array<double>& q, double value) { std::fill(q.begin(), q.end(), value); };
  fill(box.s.f.u, 0), fill(box.s.f.v, 0), fill(box.s.f.w, 20), fill(box.s.f.p, 0);
  fill(box.s.f.fx, 0), fill(box.s.f.fy, 0), fill(box.s.f.fz, 24);
  box.ghosts();
  EXPECT_NEAR(momentum_deficit(box.d, box.b, box.s).z, 0, 1e-9);
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 4; ++i) box.s.f.p[box.at(i, j, 0)] = 7, box.s.f.w[box.at(i, j, 5)] = 15;
  box.s.f.k = Array<double>(box.d.layout.values(), 1e-12);                 // next to no eddy viscosity
  EXPECT_NEAR(momentum_deficit(box.d, box.b, box.s).z, 7 + 24 * 5, 0.01);  // on 1 m2
}

// A duct closed by cloth that moves with or against the air: the law applies to the relative velocity.
TEST(Boundary, AMovingSheetResistsOnlyTheRelativeVelocity) {
  for (const double moving : {-5.0, 0.0, 6.0, 10.0}) {
    FlowProblem problem;
    problem.grid = {{0, 0, 0}, {1, 1, 2}, 4, 4, 16};
    problem.air.velocity = {0, 0, 10};
    problem.sides = Sides::slip;
    problem.outlet = Outlet::still_air;
    const Vec3 p[] = {{-1, -1, 1.01}, {2, -1, 1.01}, {2, 2, 1.01}, {-1, 2, 1.01}};
    problem.bodies = {sheet_body({{p[0], p[1], p[2]}, {p[0], p[2], p[3]}}, {40, 2})};
    problem.bodies[0].motion.velocity.assign(2, {0, 0, moving});
    problem.stopping.residual = 1e-8;
    CartesianSettings settings;
    settings.threads = 1, settings.compressible = false;
    const FlowField field = solve(*make_cartesian(settings), problem);
    const double v = 10 - moving;
    EXPECT_NEAR(field.porous_force.z, 40 * v + 2 * v * std::abs(v), 0.01) << moving;
  }
}

}  // namespace
}  // namespace ripstop::cartesian
