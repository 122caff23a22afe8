// A motion that has lost its stability ends with an error that names time, node and a remedy, whatever its numbers are.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../diverges.h"
#include "builders.h"

namespace ripstop {
namespace {

using namespace testing;

constexpr double inf = std::numeric_limits<double>::infinity(),
                 nan = std::numeric_limits<double>::quiet_NaN();

/// Two sheets, one above the other, whose contact is on.
Mesh two_sheets() {
  Mesh mesh;
  for (const char* name : {"lower", "upper"}) {
    PatchSpec spec;
    spec.name = name;
    spec.rows = spec.columns = 12;
    const double height = mesh.patches.empty() ? 0 : 0.004;
    spec.position = [=](int row, int column) { return Vec3{0.01 * column, 0.01 * row, height}; };
    add_patch(mesh, spec, {});
  }
  return mesh;
}

ClothPtr touching(const Mesh& mesh) {
  ClothOptions options;
  options.contact = ContactOptions{20e3, 0.2, mesh.start};
  return make_cloth(mesh, options);
}

TEST(Divergence, APositionThatIsNotFiniteIsNamedWithItsNodeWhereClothIsInContact) {
  const Mesh mesh = two_sheets();
  const ClothPtr cloth = touching(mesh);
  for (const int threads : {1, 2})
    for (const double bad : {nan, inf, -inf})
      for (const int done : {0, 1}) {  // steps before: at 0 the state is checked before anything moves
        std::vector<Vec3> x = mesh.start;
        x[200].y = bad;
        ClothState state = start_state(*cloth);
        set_positions(state, *cloth, x);
        state.steps = done;
        ThreadTeam team(threads);
        StepRecord record;
        const std::string message = divergence([&] { step(state, *cloth, {}, 1e-6, 40, team, &record); });
        EXPECT_TRUE(says(message, "node ") && says(message, "t = ") && says(message, "smaller time step"))
            << message;
        EXPECT_TRUE(done == 1 || says(message, "node 200 (upper")) << message;
      }
}

TEST(Divergence, AVelocityThatIsNotFiniteIsFoundInTheStepsThatItMoves) {
  const Mesh mesh = two_sheets();
  const ClothPtr cloth = touching(mesh);
  for (const double bad : {nan, inf, 1e308}) {
    std::vector<Vec3> v(mesh.node_count());
    v[30].x = bad;
    ClothState state = start_state(*cloth);
    set_velocities(state, *cloth, v);
    state.steps = 1;
    ThreadTeam team(2);
    EXPECT_TRUE(says(divergence([&] { step(state, *cloth, {}, 1e-6, 4000, team); }), "node ")) << bad;
  }
}

TEST(Divergence, ClothThatIsFlungFarAwayDoesNotSpoilTheListOfContacts) {
  const Mesh mesh = two_sheets();
  const ClothPtr cloth = touching(mesh);
  for (const double far : {1e12, 1e200, 1e308}) {
    std::vector<Vec3> x = mesh.start;
    x[0].x = -far, x[200].x = far;
    ClothState state = start_state(*cloth);
    set_positions(state, *cloth, x);
    EXPECT_GE(contact_report(*cloth, state).pairs, 0);
    EXPECT_GE(pierced_share(mesh, x), 0);
    ThreadTeam team(1);
    EXPECT_TRUE(says(divergence([&] { step(state, *cloth, {}, 1e-6, 1, team); }), "stretched by")) << far;
  }
}

TEST(Divergence, NothingIsInContactWherePositionsAreNotFiniteAndPiercedClothIsAnError) {
  const Mesh mesh = two_sheets();
  const ClothPtr cloth = touching(mesh);
  std::vector<Vec3> x = mesh.start;
  ClothState state = start_state(*cloth);
  x[150].z = nan;
  set_positions(state, *cloth, x);
  EXPECT_EQ(contact_report(*cloth, state).pairs, 0);
  EXPECT_TRUE(says(divergence([&] { pierced_share(mesh, x); }), "node 150 (upper"));
  const std::vector<Vec3> one_place(mesh.node_count());
  EXPECT_EQ(pierced_share(mesh, one_place), 0);
}

TEST(Divergence, AStiffnessBeyondAllNumbersHasNoStableStep) {
  Mesh mesh = two_sheets();
  for (SpringLaw& law : mesh.patches[0].law) law.coefficients = {1e3, 1e3, 1e3, 1e3};
  const ClothPtr cloth = make_cloth(mesh);
  std::vector<Vec3> x = mesh.start;
  x[5].z = 1e200;
  ClothState state = start_state(*cloth);
  set_positions(state, *cloth, x);
  EXPECT_EQ(stability_limit(*cloth, state).stable_step, 0);
}

TEST(Divergence, NoStepIsTakenOfALengthOrNumberThatIsNone) {
  const Mesh mesh = two_sheets();
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  ThreadTeam team(1);
  StepRecord record;
  for (const double dt : {0.0, -1e-6, nan, inf})
    EXPECT_THROW(step(state, *cloth, {}, dt, 1, team), Error) << dt;
  EXPECT_THROW(step(state, *cloth, {}, 1e-6, std::numeric_limits<int>::min(), team, &record), Error);
  step(state, *cloth, {}, 1e-6, 0, team, &record);
  EXPECT_EQ(state.steps, 0);
}

}  // namespace
}  // namespace ripstop
