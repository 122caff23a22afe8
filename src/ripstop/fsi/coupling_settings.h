// [coupling] of a case file.
#pragma once

namespace ripstop::inline fsi {

enum class Acceleration { none, aitken, anderson };

/// Transfer of the flow's load to the cloth; the axial sum always equals the flow's force on the canopy.
enum class CanopyLoad {
  of_flow,  // momentum loss of the air on every face of the sheet, with force and moment preserved
  uniform,  // one pressure difference everywhere: force over the canopy's axial area
  sampled   // the pressures read on both sides of the cloth, scaled by one factor
};

/// The keys of [coupling] whose defaults follow from nothing.
struct CouplingOptions {
  int max_iterations = 20;
  double relaxation = 1;  // of the pressure; 1: the flow's answer is taken whole
  Acceleration acceleration = Acceleration::anderson;
  double cloth_tolerance = 5e-4;  // RelaxOptions::tolerance
  bool coarse_start = false;      // a cold run is first solved on cells twice as wide
  bool linear = false;            // keep only K_1 of every law
  int threads = 0;                // 0: as many as the machine has
};

struct CouplingSettings : CouplingOptions {
  CanopyLoad load = CanopyLoad::uniform;
  double drag_tolerance = 1e-3;     // change of drag between two iterations, relative
  double shape_tolerance_m = 1e-3;  // mean displacement of the nodes between two iterations
};

}  // namespace ripstop::inline fsi
