// The two kernels that a step spends its time in, for one row of a patch. Vectorised for SSE2, AVX2 and
// AVX-512, chosen at run time; no allocation, no look-up, no branch on data. Internal to cloth/.
#pragma once

#include "ripstop/cloth/layout.h"

namespace ripstop {

/// Forces of all springs that belong to a row (toward columns + 1, + 2 and rows + 1, + 2) and of the pressure
/// on the cells between it and the next. f0 and f1 are added to, f2 is overwritten.
struct RowForces {
  const PatchLayout* patch;
  const double* springs;       // of the row, see PatchLayout
  const double* pressure;      // of the row's cells, an eighth [Pa]; null: none
  const double *x0, *x1, *x2;  // rows r, r + 1, r + 2 in vector layout
  const double *v0, *v1, *v2;  // null: no damping
  double *f0, *f1, *f2;
};
void add_row_forces(const RowForces& row);

/// v' = v + kick f / m - dt decay v,  x' = x + dt v'   where 1 / m > 0; the rest stays.   [NFM] Eq. 6
struct RowMotion {
  int vectors;                 // without ghosts
  double dt, kick;             // [s], the same but for a relaxation's first step
  const double* inverse_mass;  // [1/kg]
  const double* decay;         // rate of the absolute damping [1/s]; null: none
  const double* f;
  double *x, *v;
};
void move_row(const RowMotion& row);

/// Of the nodes with 1 / m > 0: sum |f|^2 and sum f . v before the move; then moves them.
struct RowSums {
  double force_squared = 0;
  double power = 0;
};
RowSums move_row_with_sums(const RowMotion& row);

/// "AVX-512", "AVX2", "SSE2": what the kernels run on here.
const char* kernel_target();

}  // namespace ripstop
