#include "ripstop/flight/deployment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

/// No drag, no weight and no resistance.
PackedParachute free_of_forces() {
  PackedParachute p;
  p.speed = 20, p.relative_speed = 6, p.density = 1.2;
  p.payload_mass = 2.4;
  p.bag_mass = 0.03, p.canopy_mass = 0.12, p.canopy_length = 0.9;
  p.lines_mass = 0.05;
  p.lines = {{"lines", {3000, 40000}, 12, 1.8}};
  return p;
}

double momentum_before(const PackedParachute& p) {
  return p.payload_mass * p.speed +
         (p.bag_mass + p.canopy_mass + p.lines_mass) * (p.speed - p.relative_speed);
}

// m_p V + lambda s v_b is constant, and nothing acts on the bag.
TEST(Deployment, LinesThatLeaveTheBagConserveMomentum) {
  const PackedParachute p = free_of_forces();
  const Deployment d = deploy_parachute(p);
  int rows = 0;
  for (const DeploymentRow& row : d.rows) {
    if (row.time > d.phase(lines_stretch)->time || row.separation >= 1.8) break;
    const double gone = p.lines_mass * row.separation / 1.8, slow = p.speed - p.relative_speed;
    EXPECT_NEAR(row.payload_speed, (p.payload_mass * p.speed + gone * slow) / (p.payload_mass + gone), 1e-6);
    EXPECT_NEAR(row.bag_speed, slow, 1e-9);
    ++rows;
  }
  EXPECT_GT(rows, 100);
}

// Masses m_p + m_l and m_b with a nonlinear spring between them: snatch_load() has the energy.
TEST(Deployment, SnatchOfAClosedBagIsThatOfTwoMasses) {
  PackedParachute p = free_of_forces();
  p.strip_force = 1e6;
  const Deployment d = deploy_parachute(p);
  const DeploymentPhase& stretch = *d.phase(lines_stretch);
  const SnatchLoad two = snatch_load(p.payload_mass + p.lines_mass, p.bag_mass + p.canopy_mass,
                                     stretch.payload_speed - stretch.bag_speed, p.lines);
  EXPECT_NEAR(d.snatch_load / two.load, 1, 2e-3);
  EXPECT_NEAR((d.snatch_time - stretch.time) / two.time, 1, 0.01);
  ASSERT_TRUE(d.stopped);
  EXPECT_NE(d.stopped->find("strip force"), std::string::npos);
}

TEST(Deployment, CanopyThatLeavesTheBagConservesMomentum) {
  PackedParachute p = free_of_forces();
  p.strip_force = 0.3;
  const Deployment d = deploy_parachute(p);
  ASSERT_FALSE(d.stopped);
  const DeploymentPhase& out = *d.phase(canopy_out);
  // The bag has felt nothing but the strip force since it began to slide.
  const DeploymentPhase& begun = *d.phase(canopy_leaves);
  EXPECT_GT(out.bag_speed, begun.bag_speed);
  EXPECT_LT(out.payload_speed, begun.payload_speed);
  // Largest stretch: payload, lines and canopy have one speed, the bag its own.
  const DeploymentRow& end = d.rows.back();
  const double after =
      (p.payload_mass + p.lines_mass + p.canopy_mass) * end.payload_speed + p.bag_mass * out.bag_speed;
  EXPECT_NEAR(after / momentum_before(p), 1, 1e-3);
}

// At the constant speed u of a bag on a held payload, every length adds mu u^2: its mean is m_c u^2 / L.
TEST(Deployment, BagAtConstantSpeedPullsWithTheMomentumThatLeavesIt) {
  PackedParachute p = free_of_forces();
  p.payload_mass = std::numeric_limits<double>::infinity();
  p.bag_mass = 1e6;
  const Deployment d = deploy_parachute(p);
  const DeploymentPhase &begun = *d.phase(canopy_leaves), &out = *d.phase(canopy_out);
  double impulse = 0;
  for (std::size_t i = 1; i < d.rows.size(); ++i)
    if (d.rows[i].time > d.phase(lines_stretch)->time && d.rows[i].time <= out.time)
      impulse += 0.5 * (d.rows[i].tension + d.rows[i - 1].tension) * (d.rows[i].time - d.rows[i - 1].time);
  EXPECT_NEAR(out.time - begun.time, p.canopy_length / p.relative_speed,
              0.03 * p.canopy_length / p.relative_speed);
  EXPECT_NEAR(impulse / (p.canopy_mass * p.relative_speed), 1, 0.01);
}

// Without stows the bodies coast apart as in closed form; the lines have hardly a mass.
TEST(Deployment, DragSeparatesBagAndPayloadAsInClosedForm) {
  PackedParachute p = free_of_forces();
  p.relative_speed = 0, p.lines_mass = 1e-3;
  p.payload_drag_area = 0.002, p.bag_drag_area = 0.03;
  const Deployment d = deploy_parachute(p);
  const double closed =
      speed_difference_at_stretch({p.payload_mass, p.payload_drag_area},
                                  {p.bag_mass + p.canopy_mass, p.bag_drag_area}, p.speed, p.density, 1.8);
  EXPECT_NEAR(d.relative_speed / closed, 1, 3e-3);
}

TEST(Deployment, CanopyFirstStretchesTheLinesWithTheWholeCanopyOut) {
  PackedParachute p = free_of_forces();
  p.lines_first = false, p.bag_drag_area = 0.05;
  const Deployment d = deploy_parachute(p);
  ASSERT_FALSE(d.stopped);
  ASSERT_EQ(d.phases.size(), 4u);
  EXPECT_EQ(d.phases[0].name, canopy_leaves);
  EXPECT_EQ(d.phases[1].name, lines_leave);
  EXPECT_EQ(d.phases[2].name, lines_stretch);
  EXPECT_NEAR(d.rows.back().emerged, p.canopy_length, 1e-12);
  PackedParachute first = p;
  first.lines_first = true;
  EXPECT_GT(d.snatch_load, deploy_parachute(first).snatch_load);
}

TEST(Deployment, BagThatTheStowsStopIsReported) {
  PackedParachute p = free_of_forces();
  p.line_force = 50;
  const Deployment d = deploy_parachute(p);
  ASSERT_TRUE(d.stopped);
  EXPECT_NE(d.stopped->find("lines and riser have left the bag"), std::string::npos);
  EXPECT_FALSE(d.phase(lines_stretch));
}

TEST(Deployment, RejectsMassesThatAreNotPositiveAndLinesThatBreak) {
  PackedParachute p = free_of_forces();
  p.payload_mass = 0;
  EXPECT_THROW(deploy_parachute(p), Error);
  p = free_of_forces(), p.strip_force = -1;
  EXPECT_THROW(deploy_parachute(p), Error);
  p = free_of_forces(), p.lines = {{"lines", {300, -3000}, 1, 1.8}}, p.strip_force = 1e5;
  EXPECT_THROW(deploy_parachute(p), Error);
}

TEST(Deployment, ConeOfCanopyLeavesFirstWithItsWideEnd) {
  EXPECT_DOUBLE_EQ(emerged_mass(2, 1, 0.5, true), 1.5);
  EXPECT_DOUBLE_EQ(emerged_mass(2, 1, 0.5, false), 0.5);
  EXPECT_DOUBLE_EQ(emerged_mass(2, 1, 3, true), 2);
}

}  // namespace
}  // namespace ripstop
