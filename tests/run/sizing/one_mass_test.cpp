// One parachute has one mass, one nominal area and one reference length: in pattern, flight, summary, loads and export.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "ripstop/case/assemble.h"
#include "ripstop/case/deployment.h"
#include "ripstop/case/flying.h"
#include "ripstop/case/opening.h"
#include "ripstop/case/payload.h"
#include "ripstop/case/summary.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/parachute/family.h"
#include "ripstop/parachute/own_mesh.h"
#include "ripstop/run/descent/descent.h"
#include "ripstop/run/descent/export.h"
#include "ripstop/run/flight/flight.h"
#include "ripstop/run/opening/load.h"
#include "ripstop/run/sizing/pattern.h"
#include "ripstop/run/sizing/size.h"
#include "ripstop/run/stability/stability.h"

namespace ripstop {
namespace {

double mass_of(const Mesh& mesh) {
  return std::accumulate(mesh.mass.begin(), mesh.mass.end(), 0.0);
}

void expect_one_mass(const Case& given, const std::string& name) {
  const PatternResult pattern = run_pattern(resolve(given), {}, packed_by_hand);
  const double mass = pattern.bill.mass;
  EXPECT_EQ(parachute_mass(resolve(given)), mass) << name;
  EXPECT_NEAR(pattern.bill.packed_volume * packed_by_hand, mass, 1e-12 * mass) << name;
  const PartMasses parts = summarize(resolve(given)).mass;
  EXPECT_EQ(parts.total, mass) << name;
  EXPECT_NEAR(parts.cloth + parts.tape + parts.lines + parts.riser, mass, 1e-12 * mass) << name;
  EXPECT_NEAR(suspended_weight(resolve(given), 2) / standard_gravity, 2 + mass, 1e-12) << name;
  LoadRequest asked;
  asked.payload_mass = 2, asked.speed = 40, asked.drag_coefficient = 0.7, asked.opening_coefficient = 1.5;
  EXPECT_EQ(run_load(resolve(given), asked).parachute_mass, mass) << name;
  const Settings resolved = resolve(given);
  SteadyResult steady;
  steady.converged = true, steady.speed = 20, steady.drag_area = 1,
  steady.reference_area = nominal_area(given.parachute);
  const FinishedSteady run = finished_steady(resolved, steady);
  EXPECT_EQ(exported(run).mass, mass) << name;
  EXPECT_EQ(run_descent(run, 2, {0}).parachute_mass, mass) << name;
  EXPECT_NEAR(mass_of(mesh_as_cut(parachute_mesh(resolved), resolved)), mass, 1e-12 * mass) << name;
}

/// The parachute that moves in a flight and in an opening with a payload, and the one that is deployed.
void expect_one_flying_mass(Case given, const std::string& name) {
  if (resolve(given).flow().porosity_model == PorosityModel::paper) return;  // does not fly
  given.payload.mass_kg = 2, given.bodies.clear();
  const Settings flight = flight_settings(given);
  const double mass = parachute_mass(flight);
  const FlightProblem flown = flight_problem(flight, parachute_mesh(flight).start, {}, 1);
  EXPECT_NEAR(mass_of(flown.mesh), mass, 1e-12 * mass) << name;
  given.flight.start = FlightSettings::Start::inflation;
  given.flow.speed_m_s = 20;
  const Settings opening = flight_settings(given);
  const InflationProblem opened = opening_problem(opening, load_source(opening), 1);
  EXPECT_NEAR(mass_of(opened.mesh) + opened.air->payload->mass - 2, mass, 1e-9 * mass) << name;
  if (!opening.deployment()) return;
  const PackedParachute packed = packed_parachute(opening);
  EXPECT_NEAR(packed.canopy_mass + packed.lines_mass, mass, 1e-12 * mass) << name;
}

/// S0 and D0 = (4 S0 / pi)^(1/2) of every user of them, and the cloth as cut and as meshed.
void expect_one_reference(const Case& given, const std::string& name) {
  const Settings resolved = resolve(given);
  const double area = nominal_area(given.parachute), diameter = nominal_diameter(given.parachute);
  EXPECT_NEAR(std::numbers::pi / 4 * diameter * diameter, area, 1e-12 * area) << name;
  const PatternResult pattern = run_pattern(resolved, {}, packed_by_hand);
  const CaseSummary summary = summarize(resolved);
  const Reference turned = stability_reference(resolved);
  LoadRequest asked;
  asked.payload_mass = 2, asked.speed = 40, asked.drag_coefficient = 0.7, asked.opening_coefficient = 1.5;
  const LoadResult load = run_load(resolved, asked);
  const SteadyProblem flown = steady_problem(resolved);
  SteadyResult steady;
  steady.converged = true, steady.speed = 20, steady.drag_area = 1,
  steady.reference_area = flown.reference_area;
  const ExportedParachute sold = exported(finished_steady(resolved, steady));
  for (const double other : {pattern.nominal_area, summary.nominal_area, turned.area, load.reference_area,
                             flown.reference_area, sold.nominal_area})
    EXPECT_EQ(other, area) << name;
  for (const double other : {turned.diameter, load.nominal_diameter, sold.nominal_diameter})
    EXPECT_EQ(other, diameter) << name;
  double cut = 0;  // pieces as drawn, without their allowances
  for (const Piece& piece : pattern.pattern.pieces)
    cut += piece.count * (polygon_area(piece.outline) - std::abs(polygon_area(piece.opening)));
  EXPECT_NEAR(cut / pattern.cloth_area, 1, 2e-3) << name;
  EXPECT_EQ(summary.computed_area, pattern.cloth_area) << name;
  EXPECT_NEAR(summary.cloth_area / cloth_area(flown.mesh), 1, 1e-9) << name;
  EXPECT_NEAR(summary.cloth_area / pattern.cloth_area, 1, 0.02) << name;
}

template <class Look>
void for_every_example(const Look& look) {
  std::set<std::string> types;
  const auto folder = std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto file = entry.path() / "case.toml";
    if (!std::filesystem::exists(file)) continue;
    Overrides coarse;
    coarse.set.push_back({"parachute.mesh.cloth_nodes", "2000", ""});
    Case given = read_case(file, coarse);
    given.cluster.reset();  // loads, flights and exports are of one canopy
    look(given, entry.path().filename());
    types.insert(given.parachute.canopy.family().type);
  }
  for (const CanopyFamily* family : families()) EXPECT_TRUE(types.contains(family->type)) << family->type;
}

TEST(OneMass, OfEveryExample) {
  for_every_example(expect_one_mass);
  for_every_example(expect_one_flying_mass);
}

TEST(OneReference, OfEveryFamily) {
  for_every_example(expect_one_reference);
}

TEST(OneReference, OfASizedParachuteOfEveryFamily) {
  for (const FamilyDrag& drag : family_drags()) {
    SizeRequest asked;
    asked.payload_mass = 2.4, asked.descent_rate = 5, asked.family = drag.family;
    const SizeResult r = run_size(asked);
    EXPECT_EQ(r.nominal_area, nominal_area(r.given.parachute)) << drag.family;
    EXPECT_EQ(r.nominal_diameter, nominal_diameter(r.given.parachute)) << drag.family;
    EXPECT_EQ(run_pattern(resolve(r.given), {}, 400).nominal_area, r.nominal_area) << drag.family;
  }
}

// 7.6 g were printed, 14.7 g cut and packed.
TEST(OneMass, OfASizedParachuteOfEveryFamily) {
  for (const FamilyDrag& drag : family_drags())
    for (const double payload : {0.05, 2.4}) {
      SizeRequest asked;
      asked.payload_mass = payload, asked.descent_rate = 5, asked.family = drag.family;
      const SizeResult r = run_size(asked);
      EXPECT_EQ(r.parachute_mass, run_pattern(resolve(r.given), {}, 400).bill.mass)
          << drag.family << " " << payload;
      EXPECT_NEAR(r.packed_volume * asked.packing_density, r.parachute_mass, 1e-12) << drag.family;
    }
}

}  // namespace
}  // namespace ripstop
