// What a case takes of the machine, estimated before anything of it is allocated.
#pragma once

#include <string>

#include "ripstop/case/case.h"

namespace ripstop {

struct Cost {
  double nodes = 0;         // of cloth, lines and riser
  double cells = 0;         // of the flow
  double cloth_memory = 0;  // of all that computes the canopy alone [bytes]
  double memory = 0;        // of a steady run with the built-in engine [bytes]
  double time = 0;          // of the same to rest on one core [s]; half to twice as much is usual
};
Cost cost_of(const Case& given);

/// What this process may still take: of the machine's free memory, of its control group and of its own limit
/// (ulimit -v), the least [bytes].
double free_memory();
/// Throws Error(resources) when `what` needs more than that: "a steady run on 2e+08 cells".
void require_memory(double bytes, const std::string& what);

}  // namespace ripstop
