// The loops over the cells of a row. A kernel makes the views of its row and gives the equations of one cell to
// for_cells() or sum_cells(); it contains neither threads nor vectors. Solver shares the rows among threads (solver.h).
#pragma once

#include "ripstop/flow/cartesian/simd.h"

namespace ripstop::inline flow::cartesian {

/// cell(i) for the cells of a row, several at once: a lambda with RIPSTOP_CELL.
template <class Cell>
[[gnu::always_inline]] inline void for_cells(int n, const Cell& cell) {
#pragma omp simd
  for (int i = 0; i < n; ++i) cell(i);
}

/// Over the cells of a row: up to six sums, and the largest of a number that is not negative.
struct CellSums {
  double a = 0, b = 0, c = 0, d = 0, e = 0, f = 0;
  double largest = 0;
};
/// Of the results of cell(i); with `none` they are not added. Sums that the caller does not read cost nothing.
template <bool none = false, class Cell>
[[gnu::always_inline]] inline CellSums sum_cells(int n, const Cell& cell) {
  double a = 0, b = 0, c = 0, d = 0, e = 0, f = 0, largest = 0;
#pragma omp simd reduction(+ : a, b, c, d, e, f) reduction(max : largest)
  for (int i = 0; i < n; ++i) {
    CellSums of = cell(i);
    if constexpr (!none) {
      a += of.a, b += of.b, c += of.c, d += of.d, e += of.e, f += of.f;
      largest = larger(largest, of.largest);
    }
  }
  return {a, b, c, d, e, f, largest};
}

}  // namespace ripstop::inline flow::cartesian
