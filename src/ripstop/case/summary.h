// Properties of a case that need no solver: masses, springs, time step.
#pragma once

#include <string>

#include "ripstop/case/case.h"
#include "ripstop/case/payload.h"
#include "ripstop/cloth/cloth.h"

namespace ripstop::inline cases {

struct CaseSummary {
  double cloth_area = 0;                // as meshed, a polygon inside the cut cloth [m2]
  double computed_area = 0;             // as cut [m2]
  double nominal_area = 0;              // S0 that coefficients refer to [m2]
  double vent_area = 0, slot_area = 0;  // open, as constructed [m2]
  double geometric_porosity = 0;        // their share of the whole surface without fullness
  PartMasses mass;                      // as cut, see parachute_masses()
  int nodes = 0, cloth_nodes = 0;
  int resolved_cloth_nodes = 0;  // see Experience::cloth_nodes
  int springs = 0;               // of the lattice and outside it
  double smallest_spring = 0;    // rest length [m]
  std::string smallest_part;     // where it is
  StabilityLimit step;           // of the start shape
  long long flow_cells = 0;
  Vec3 flow_spacing;     // [m]
  double memory = 0;     // of a steady run, about [bytes]
  double core_time = 0;  // of the same with the built-in engine to rest, see Cost::time [s]
  double blockage = 0;   // disk of the start shape's diameter over the cross-section of the box or the nozzle
  bool of_jet = false;   // of the nozzle
  Air air;
  std::string air_source;
  DeploymentSpeed deployment;  // of usual_opening()
};

/// Builds the mesh and the cloth, and throws their exceptions.
CaseSummary summarize(const Settings& resolved);

}  // namespace ripstop::inline cases
