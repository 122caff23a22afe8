// The kernels that a step spends its time in: rows of a patch, springs outside the lattice. Vectorised for
// SSE4, AVX2 and AVX-512 (else one lane at a time), chosen at run time; no allocation, no look-up, no branch
// on data. Internal to cloth/.
#pragma once

#include "ripstop/cloth/layout.h"

namespace ripstop::inline cloth {

/// Forces of all springs that belong to a row (toward columns + 1, + 2 and rows + 1, + 2) and of the pressure
/// on the cells between it and the next. f0 and f1 are added to, f2 is overwritten.
struct RowForces {
  const PatchLayout* patch;
  const double* springs;       // of the row, see PatchLayout
  const double* pressure;      // of the row's cells, an eighth [Pa]; null: none
  const double *x0, *x1, *x2;  // rows r, r + 1, r + 2 in vector layout
  const double *v0, *v1, *v2;  // null: no damping
  const double* damper_share;  // of the row, see PatchLayout; null with v0
  double *f0, *f1, *f2;
};
/// Returns the power of the springs' dampers [W], with the velocities before the step.
double add_row_forces(const RowForces& row);

/// f += a over `count` doubles, whole vectors.
void add_row(int count, const double* a, double* f);

/// v' = v + dt (f - c v) / m,  x' = x + dt v'   where 1 / m > 0; the rest stays.   [NFM] Eq. 6, 20
/// with the absolute damping c = area (linear + quadratic |v|).
struct RowMotion {
  int vectors;                 // without ghosts
  double dt;                   // [s]
  const double* inverse_mass;  // [1/kg]
  const double* area;          // that is damped [m2], 0 where 1 / m = 0; null: no damping
  double linear, quadratic;    // [N s/m3], [N s2/m4]
  const double* f;
  double *x, *v;
};
/// Moves the row; returns the power that the damping takes, c v . (v + v') / 2 [W]: the scheme's kinetic
/// energy changes by exactly dt times the power of all forces on that mean velocity.
double move_row(const RowMotion& row);

/// As RowMotion, with a mass of its own along every direction: v' = keep v + kick W f.
struct RowRelaxation {
  int vectors;        // without ghosts
  double kick, keep;  // [-]
  const double*
      inverse_mass;  // W by node, [1/kg]: eight xx, yy, zz, xy, xz, yz a vector; xx = 0: the node stays
  const double* f;
  double *x, *v;
};
/// Moves, and sums over the nodes that move: |f|^2 before the move, and f . (v + v'), which is twice the increase of
/// the kinetic energy. (f . v alone is biased: negative on average for every fast mode.)
struct RowSums {
  double force_squared = 0;
  double power = 0;
};
RowSums relax_row(const RowRelaxation& row);

/// Records of every spring outside the lattice; null: none. The last damper's force in vector layout, the
/// energy over dt that dampers have taken [W] (see EnergyRecord), the maximum tension [N].
struct SpringRecord {
  double *damper = nullptr, *taken = nullptr, *peak = nullptr;
};
/// Forces of the springs outside the lattice, in blocks of eight.
struct SpringForces {
  const IrregularSprings* springs;
  const double *x, *v;  // of all nodes; v null: no damping
  double* f;            // of every spring on its end a, in vector layout
  SpringRecord record;
};
void pull_springs(const SpringForces& job, int begin_block, int end_block);

/// Work of the pressure on the cells between two rows while they move from x_before to x: the mean of both
/// area vectors on the mean displacement of the corners [J].
struct RowWork {
  int vectors;             // without ghosts
  const double* pressure;  // of the row's cells, an eighth [Pa]
  const double *x0, *x1;   // rows r, r + 1 now
  const double *before0, *before1;
};
double pressure_work(const RowWork& row);

/// Of a relaxation's blocks (blocks.h): the force on each chunk of a row, over the nodes that move.
struct BlockSums {
  int chunks;
  const int* edge;             // chunks + 1, in vectors
  const double* inverse_mass;  // as in RowRelaxation
  const double* f;
  double* sum;  // in vector layout
};
void sum_blocks(const BlockSums& row);
/// v' = v + u,  x' = x + u   with the u of each chunk.
struct BlockMotion {
  int chunks;
  const int* edge;
  const double* inverse_mass;
  const double* motion;
  double *x, *v;
};
void move_blocks(const BlockMotion& row);
/// Elements [begin, end) of y = A r along all three axes, whole pairs of vectors.
struct BlockProduct {
  int padded;
  const double* inverse;  // see Blocks::inverse()
  const double* r;        // [3 x padded]
  double* y;
};
void multiply_blocks(const BlockProduct& job, int begin, int end);

/// "AVX-512", "AVX2", "SSE4", "scalar": instruction set of the kernels on this processor.
const char* kernel_target();

}  // namespace ripstop::inline cloth
