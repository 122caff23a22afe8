// Areas by each family's own definition, in closed form: S0, cloth, and the open share of
// it (vent, slots, gaps).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "examples.h"
#include "ripstop/case/assemble.h"
#include "ripstop/case/case.h"
#include "ripstop/parachute/annular.h"
#include "ripstop/parachute/conical.h"
#include "ripstop/parachute/cross.h"
#include "ripstop/parachute/disk_gap_band.h"
#include "ripstop/parachute/extended_skirt.h"
#include "ripstop/parachute/flat_circular.h"
#include "ripstop/parachute/polygon.h"
#include "ripstop/parachute/profile.h"
#include "ripstop/parachute/ringsail.h"
#include "ripstop/parachute/ringslot.h"
#include "ripstop/parachute/spherical.h"

namespace ripstop {
namespace {

using std::numbers::pi;
constexpr double degree = pi / 180;

struct Areas {
  double nominal, covered, open;  // S0; cloth without fullness; vent, slots and gaps [m2]
};

double disk(double diameter) {
  return pi / 4 * diameter * diameter;
}

/// On a round cone of slant length `slant` and area `whole`, cut off at the vent of flat area `vent`.
Areas cone(double whole, double angle, double vent) {
  return {whole, whole - vent / std::cos(angle), vent};
}

/// Zone of a sphere between two angles from its pole.
double zone(double radius, double from, double to) {
  return 2 * pi * radius * radius * (std::cos(from) - std::cos(to));
}

/// N flat trapezoids or triangles on the meridian's points, each side 2 pi r / N wide.
double flat_gores(const std::vector<double>& r, const std::vector<double>& z, int gores) {
  double area = 0;
  for (std::size_t i = 1; i < r.size(); ++i) {
    const double apothem = pi / gores / std::tan(pi / gores);
    area += pi * (r[i] + r[i - 1]) * std::hypot(apothem * (r[i] - r[i - 1]), z[i] - z[i - 1]);
  }
  return area;
}

/// Of equal flat annuli from the skirt inward.
Areas of_rings(const Ringslot& c) {
  EXPECT_EQ(c.cone_angle_deg, 0);
  const double whole = disk(c.nominal_diameter_m), outer = c.nominal_diameter_m / 2;
  const double ring = (outer - c.vent_diameter_m / 2 - (c.rings - 1) * c.slot_height_m) / c.rings;
  double open = disk(c.vent_diameter_m);
  for (int i = 1; i < c.rings; ++i) {
    const double r = outer - i * ring - (i - 1) * c.slot_height_m;
    open += disk(2 * r) - disk(2 * (r - c.slot_height_m));
  }
  return {whole, whole - open, open};
}

/// Of zones of a sphere, sail and slot in turn, from the skirt up.
Areas of_sails(const Ringsail& c) {
  const double angle = c.half_angle_deg * degree, whole = disk(c.nominal_diameter_m);
  const double radius = std::sqrt(whole / (2 * pi * (1 - std::cos(angle))));
  const double vent = std::asin(c.vent_diameter_m / 2 / radius);
  const std::vector<SailRow> rows = sail_rows(c);
  double arc = angle - vent, heights = 0, open = disk(c.vent_diameter_m), covered = 0, from = angle;
  for (const SailRow& row : rows) arc -= row.slot_deg * degree, heights += row.height;
  for (const SailRow& row : rows) {
    const double sail = arc * row.height / heights, slot = row.slot_deg * degree;
    covered += zone(radius, from - sail, from);
    open += zone(radius, from - sail - slot, from - sail);
    from -= sail + slot;
  }
  EXPECT_NEAR(from, vent, 1e-12);
  return {whole, covered, open};
}

Areas by_hand(const Design& design) {
  if (const auto* c = design.canopy.as<DiskGapBand>()) {
    const double cloth =
        disk(c->disk_diameter_m) - disk(c->vent_diameter_m) + pi * c->disk_diameter_m * c->band_height_m;
    return {cloth, cloth, disk(c->vent_diameter_m) + pi * c->disk_diameter_m * c->gap_height_m};
  }
  if (const auto* c = design.canopy.as<FlatCircular>())
    return cone(disk(c->nominal_diameter_m), 0, disk(c->vent_diameter_m));
  if (const auto* c = design.canopy.as<Conical>())
    return cone(disk(c->nominal_diameter_m), c->cone_angle_deg * degree, disk(c->vent_diameter_m));
  if (const auto* c = design.canopy.as<Spherical>()) {
    const double angle = c->half_angle_deg * degree, whole = disk(c->nominal_diameter_m);
    const double radius = std::sqrt(whole / (2 * pi * (1 - std::cos(angle))));
    const double vent = std::asin(c->vent_diameter_m / 2 / radius);
    return {whole, zone(radius, vent, angle), disk(c->vent_diameter_m)};
  }
  if (const auto* c = design.canopy.as<ExtendedSkirt>()) {
    const double skirt = pi * c->disk_diameter_m * 0.5 * (1 + c->skirt_diameter_share) * c->skirt_height_m;
    const double whole = disk(c->disk_diameter_m) + skirt;
    return {whole, whole - disk(c->vent_diameter_m), disk(c->vent_diameter_m)};
  }
  if (const auto* c = design.canopy.as<Ringslot>()) return of_rings(*c);
  if (const auto* c = design.canopy.as<Ringsail>()) return of_sails(*c);
  if (const auto* c = design.canopy.as<Annular>()) {  // half a torus, whose vent is not in S0
    EXPECT_EQ(c->crown_ratio, 1);
    const double mean = (c->outer_diameter_m + c->vent_diameter_m) / 4,
                 half_width = (c->outer_diameter_m - c->vent_diameter_m) / 4;
    const double cloth = 2 * pi * mean * pi * half_width;
    return {cloth, cloth, disk(c->vent_diameter_m)};
  }
  if (const auto* c = design.canopy.as<Polygon>()) {
    EXPECT_EQ(design.gores, 6);
    const double whole = std::sqrt(3) / 2 * c->across_flats_m * c->across_flats_m;
    return {whole, whole - disk(c->vent_diameter_m), disk(c->vent_diameter_m)};
  }
  if (const auto* c = design.canopy.as<Cross>()) {
    const double cloth = 2 * c->arm_length_m * c->arm_width_m - c->arm_width_m * c->arm_width_m;
    return {cloth, cloth, 0};
  }
  if (const auto* c = design.canopy.as<ProfileCanopy>()) {
    const ProfilePiece& piece = c->pieces.at(0);
    const double covered = flat_gores(piece.radius_m, piece.height_m, design.gores);
    const double vent = flat_gores({piece.radius_m.back(), 0}, {0, 0}, design.gores);
    return {covered + vent, covered, vent};
  }
  ADD_FAILURE() << "no areas in closed form for type " << design.canopy.family().type;
  return {};
}

class FamilyAreas : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, FamilyAreas, testing::ValuesIn(family_examples()), name_of_example);

// Meridians cut into 64 chords a strip have the areas of their arcs within 1e-4.
TEST_P(FamilyAreas, NominalAreaClothAndGeometricPorosityAreThoseOfTheDefinition) {
  const Design design = example(GetParam()).parachute;
  const Areas expected = by_hand(design);
  const CanopyFacts canopy = facts(design);
  EXPECT_NEAR(nominal_area(design) / expected.nominal, 1, 1e-9);
  EXPECT_NEAR(canopy.covered_area / expected.covered, 1, 1e-4);
  EXPECT_NEAR(canopy.vent_area + canopy.slot_area, expected.open, 1e-3 * expected.open);
  EXPECT_NEAR(canopy.geometric_porosity(), expected.open / (expected.open + expected.covered), 1e-5);
}

/// The plane of N nodes at equal distances round the axis: its polygon's area.
double polygon(const std::vector<Vec3>& corners) {
  Vec3 area{};
  for (std::size_t i = 0; i < corners.size(); ++i)
    area += 0.5 * cross(corners[i], corners[(i + 1) % corners.size()]);
  return norm(area);
}

std::vector<Vec3> seam_nodes(const Mesh& mesh, int patch, int row, int gores) {
  std::vector<Vec3> nodes;
  const Patch& p = mesh.patches[patch];
  for (int gore = 0; gore < gores; ++gore) nodes.push_back(mesh.start[p.node(row, p.columns / gores * gore)]);
  return nodes;
}

// The open area of the mesh is that of the design: between the seams of neighbouring edges without cloth, and inside
// the uppermost edge. Patches follow one another from the skirt to the vent.
TEST_P(FamilyAreas, TheMeshLeavesTheSameAreaOpen) {
  Case given = example(GetParam());
  given.parachute.mesh.sewn_straight = false;  // else seams cut their corners between two nodes of a line
  if (given.parachute.canopy.as<Cross>()) GTEST_SKIP() << "a cross has no openings in its cloth";
  // Round rings of a disk-gap-band are polygons with as many sides as columns, other
  // canopies with their gores.
  const bool round = given.parachute.canopy.as<DiskGapBand>();
  const CanopyMesh mesh = parachute_mesh(resolve(given));
  double open = 0;
  for (std::size_t i = 0; i < mesh.patches.size(); ++i) {
    const int patch = static_cast<int>(i), sides = round ? mesh.patches[i].columns : given.parachute.gores;
    const std::vector<Vec3> upper = seam_nodes(mesh, patch, mesh.patches[i].rows - 1, sides);
    if (i + 1 == mesh.patches.size()) {
      open += polygon(upper);
      continue;
    }
    const int above_sides = std::min(sides, mesh.patches[i + 1].columns);
    const std::vector<Vec3> from = seam_nodes(mesh, patch, mesh.patches[i].rows - 1, above_sides);
    const std::vector<Vec3> to = seam_nodes(mesh, patch + 1, 0, above_sides);
    for (int k = 0; k < above_sides; ++k) {
      const int next = (k + 1) % above_sides;
      open += norm(area_vector(from[k], from[next], to[next], to[k]));
    }
  }
  const CanopyFacts canopy = facts(given.parachute);
  EXPECT_NEAR(open / (canopy.vent_area + canopy.slot_area), 1, 2e-3);
}

}  // namespace
}  // namespace ripstop
