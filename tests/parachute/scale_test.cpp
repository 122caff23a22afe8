// A design in another size: the same topology, with the properties of its materials.
#include "ripstop/parachute/scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "../small_case.h"
#include "ripstop/case/assemble.h"
#include "ripstop/parachute/own_mesh.h"

namespace ripstop {
namespace {

constexpr double ratio = 0.7;

struct Sizes {
  CanopyMesh large, small;
};
Sizes meshes_of(Case given) {
  Sizes sizes;
  sizes.large = parachute_mesh(resolve(given));
  given.parachute = in_size(given.parachute, ratio);
  sizes.small = parachute_mesh(resolve(given));
  return sizes;
}

TEST(DesignInSize, KeepsTheTopologyAndTheLawsOfClothAndLines) {
  Case given = flat_circular_case(1, 900, 20);
  given.parachute.riser.length_m = 0.73;
  const auto [large, small] = meshes_of(checked(given));
  ASSERT_EQ(small.node_count(), large.node_count());
  ASSERT_EQ(small.springs.size(), large.springs.size());
  for (std::size_t s = 0; s < small.springs.size(); ++s) {
    const Spring &a = small.springs[s], &b = large.springs[s];
    EXPECT_EQ(a.a, b.a);
    EXPECT_EQ(a.b, b.b);
    EXPECT_NEAR(a.rest_length, ratio * b.rest_length, 1e-9);
  }
  // A line of the same material has the same tension at the same strain; cloth the same load per width.
  const Spring &line = small.springs[static_cast<std::size_t>(small.rigging.lines[0].springs[0])],
               &like = large.springs[static_cast<std::size_t>(large.rigging.lines[0].springs[0])];
  EXPECT_NEAR(line.scale * small.laws[line.law].tangent(0), like.scale * large.laws[like.law].tangent(0),
              1e-6 * like.scale * large.laws[like.law].tangent(0));
  EXPECT_NEAR(small.patches[0].law[along_row].tangent(0) / large.patches[0].law[along_row].tangent(0), 1,
              1e-9);
  EXPECT_NEAR(cloth_area(small) / cloth_area(large), ratio * ratio, 1e-9);
  EXPECT_EQ(in_size(given.parachute, ratio).lines.length_m, ratio);
}

// Lines of 1 m have 20 segments of 0.05 m, and those of 0.8 m as many of 0.04 m; a riser of 0.6 m has 12 and not 11.
TEST(DesignInSize, LinesHaveAsManySegmentsWithoutLossByRounding) {
  Case given = flat_circular_case(1, 900, 20);
  given.parachute.mesh.line_segment_m = 0.05;
  for (const double length : {0.6, 0.7, 1.0}) {
    given.parachute.riser.length_m = length;
    const Case complete = checked(given);
    const CanopyMesh large = parachute_mesh(resolve(complete));
    EXPECT_EQ(large.rigging.riser_springs.size(), std::lround(length / 0.05));
    for (const double factor : {0.75, 0.8, 0.82, 0.85, 0.9, 0.92}) {
      Case small = complete;
      small.parachute = in_size(complete.parachute, factor);
      EXPECT_EQ(parachute_mesh(resolve(small)).node_count(), large.node_count()) << factor;
    }
  }
}

TEST(DesignInSize, AGivenReferenceAreaIsSmallerByTheSquare) {
  Design design = flat_circular_case(1, 900, 20).parachute;
  design.nominal_area_m2 = 2;
  EXPECT_NEAR(nominal_area(in_size(design, ratio)), 2 * ratio * ratio, 1e-12);
  EXPECT_EQ(nominal_area(in_size(design, 1)), 2);
}

}  // namespace
}  // namespace ripstop
