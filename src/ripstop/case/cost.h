// Memory and time of a case, estimated before any of it is allocated.
#pragma once

#include <string>

#include "ripstop/case/settings.h"

namespace ripstop::inline cases {

struct Cost {
  double nodes = 0;         // of cloth, lines and riser
  double cells = 0;         // of the flow
  double solved_cells = 0;  // of the part of the box that is solved
  double cloth_memory = 0;  // of all that computes the canopy alone [bytes]
  double memory = 0;        // of a steady run with the built-in engine [bytes]
  double time = 0;          // of the same to rest on one core [s]; half to twice as much is usual
};
/// `quarter`: of a steady run that solves a quarter of the box.
Cost cost_of(const Settings& resolved, bool quarter = false);
/// Of a steady run as it would be: of a quarter where that is enough. Makes the mesh of the canopy.
Cost steady_cost(const Settings& resolved);
/// Memory of a flow of the built-in engine by itself [bytes].
double flow_memory(double cells);

/// Memory available to this process: the least of the free memory of the machine, of its control group and of
/// its own limit (ulimit -v) [bytes].
double free_memory();
/// Throws Error(resources) when the named object needs more than that: "a steady run on 2e+08 cells". With several
/// `canopies` fewer of them are a remedy.
void require_memory(double bytes, const std::string& what, int canopies = 1);
/// The same for all that computes the canopy of a design alone.
void require_cloth_memory(const Design& design);

}  // namespace ripstop::inline cases
