// [coupling] of a case file.
#pragma once

namespace ripstop {

enum class Acceleration { none, aitken, anderson };

struct CouplingSettings {
  double drag_tolerance = 1e-3;     // change of drag between two iterations, relative
  double shape_tolerance_m = 1e-3;  // mean displacement of the nodes between two iterations
  int max_iterations = 20;
  double relaxation = 1;  // of the pressure; 1: the flow's answer is taken whole
  Acceleration acceleration = Acceleration::anderson;
  double cloth_tolerance = 5e-4;  // RelaxOptions::tolerance
  bool linear = false;            // keep only K_1 of every law
  int threads = 0;                // 0: as many as the machine has
};

}  // namespace ripstop
