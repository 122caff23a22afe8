// The sheet's law at given velocities, face by face.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "even_axis.h"
#include "ripstop/flow/cartesian/sheet.h"
#include "ripstop/flow/cartesian/state.h"

namespace ripstop {
namespace {

using cartesian::Axis;
using cartesian::sheet_faces;
using cartesian::SheetFace;
using testing::even_axis;

/// Difference of the law from the jump on one face of a sheet inclined by 17 degrees from the z axis, in air at rest
/// except in the cells that are `off` cells along x from the two next to the face: there it flows along the sheet, as
/// through the face.
double asked_of_a_face(int axis, int off) {
  const Axis x = even_axis(0, 1, 8), z = even_axis(0, 1.5, 12);
  const Vec3 p[] = {{0.271, -1, 0}, {0.271, 2, 0}, {0.721, 2, 1.5}, {0.721, -1, 1.5}};
  const std::vector<Triangle> leaning = {{p[0], p[1], p[2]}, {p[0], p[2], p[3]}};
  cartesian::SheetRows rows(x, x, z, {sheet_body(leaning, {1000, 0})});
  const cartesian::Layout layout(8, 8, 12);
  cartesian::State state(layout);
  std::fill(state.f.rho.begin(), state.f.rho.end(), 1.2);
  for (const SheetFace& g : sheet_faces(x, x, z, leaning)) {
    if (g.axis != axis || g.j != 4 || g.k < 4 || g.k > 8) continue;
    const std::ptrdiff_t high = layout.at(g.i, g.j, g.k), low = high - (axis == 0 ? 1 : layout.stride_z);
    const Vec3 along = 5 / norm(p[2] - p[1]) * (p[2] - p[1]);
    for (const std::ptrdiff_t cell :
         {low - (g.normal.x < 0 ? -off : off), high + (g.normal.x < 0 ? -off : off)})
      state.f.u[cell] = along.x, state.f.w[cell] = along.z;
    (axis == 0 ? state.f.fx : state.f.fz)[high] = 1.2 * (axis == 0 ? along.x : along.z);
    rows.begin(state, layout);
    rows.update(state, layout, 12);
    return rows.excess()[rows.offset(axis, g.j, g.k) + g.i] / (1000 * norm(along));
  }
  ADD_FAILURE() << "no face across axis " << axis;
  return 0;
}

// Otherwise the flux through the step would feed back into its own velocity estimate in the adjacent cells.
TEST(Sheet, AtAStepOfTheStaircaseTheTangentialVelocityIsThatOfTheNextCells) {
  EXPECT_LT(std::abs(asked_of_a_face(2, 1)), 0.02);
  EXPECT_GT(asked_of_a_face(2, 0), 0.5);
  EXPECT_LT(std::abs(asked_of_a_face(0, 0)), 0.02);
  EXPECT_GT(asked_of_a_face(0, 1), 0.2);
}

/// The law of a slanted sheet that drifts, in air that shears and swirls about it and drifts with it.
std::vector<double> law_in_a_drift(Vec3 drift) {
  const Axis x = even_axis(0, 1, 8), y = even_axis(0, 1, 8), z = even_axis(0, 1.5, 12);
  const Vec3 p[] = {{-1, -1, 0.1}, {2, -1, 1.6}, {2, 2, 1.2}, {-1, 2, -0.3}};
  FlowBody sheet = sheet_body({{p[0], p[1], p[2]}, {p[0], p[2], p[3]}}, {40, 2});
  sheet.motion.velocity.assign(2, drift);
  cartesian::SheetRows rows(x, y, z, {sheet});
  const cartesian::Layout layout(8, 8, 12);
  cartesian::State state(layout);
  cartesian::Fields& f = state.f;
  const double density = 1.2;
  for (std::size_t at = 0; at < f.u.size(); ++at) {
    const double n = static_cast<double>(at);
    f.rho[at] = density, f.p[at] = 0;
    f.u[at] = 3 * std::sin(n) + drift.x, f.v[at] = 2 * std::cos(2 * n) + drift.y;
    f.w[at] = 5 * std::sin(3 * n + 1) + drift.z;
    f.fx[at] = density * (std::cos(n) + drift.x), f.fy[at] = density * (std::sin(2 * n) + drift.y);
    f.fz[at] = density * (4 * std::cos(3 * n) + drift.z);
  }
  rows.begin(state, layout);
  rows.update(state, layout, density * 10, 1e-4);
  std::vector<double> law = rows.excess();
  law.insert(law.end(), rows.stiffness().begin(), rows.stiffness().end());
  return law;
}

TEST(Sheet, TheLawOfASheetThatMovesIsTheSameInEveryFrame) {
  const std::vector<double> at_rest = law_in_a_drift({}), drifting = law_in_a_drift({4, -3, -9});
  ASSERT_EQ(at_rest.size(), drifting.size());
  double largest = 0;
  for (std::size_t n = 0; n < at_rest.size(); ++n) {
    EXPECT_NEAR(drifting[n], at_rest[n], 1e-9) << n;
    largest = std::max(largest, std::abs(at_rest[n]));
  }
  EXPECT_GT(largest, 100);
}

}  // namespace
}  // namespace ripstop
