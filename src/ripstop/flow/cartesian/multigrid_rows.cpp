#include "ripstop/flow/cartesian/multigrid_rows.h"

#include "ripstop/flow/cartesian/loops.h"
#include "ripstop/flow/cartesian/simd.h"

namespace ripstop::inline flow::cartesian {

RIPSTOP_ROW_KERNEL void smooth_row(const MultigridRow& row, int parity) {
  const int n = row.n;
  const std::ptrdiff_t sy = row.sy, sz = row.sz;
  float* e = row.e;
  const float *rhs = row.rhs, *cx = row.cx, *cy = row.cy, *cz = row.cz;
  // Cells of one colour read only the other colour: all of a piece of the
  // row is computed aside, half of it kept.
#ifdef __SANITIZE_THREAD__  // to which a value thrown away or written back is a race with the thread of the next plane
  constexpr int piece = 1;
#else
  constexpr int piece = 256;
#endif
  alignas(64) float fresh[piece];
  for (int begin = 0; begin < n; begin += piece) {
    if (piece == 1 && (begin & 1) != parity) continue;
    const int kept = piece == 1 ? 0 : parity;  // other pieces are even: it counts from any of their starts
    const int count = n - begin < piece ? n - begin : piece;
    const float *q = e + begin, *b = rhs + begin, *x = cx + begin, *y = cy + begin, *z = cz + begin;
    for_cells(count, [&](int i) RIPSTOP_CELL {
      const float sum = x[i] + x[i + 1] + y[i] + y[i + sy] + z[i] + z[i + sz];
      const float in = x[i] * q[i - 1] + x[i + 1] * q[i + 1] + y[i] * q[i - sy] + y[i + sy] * q[i + sy] +
                       z[i] * q[i - sz] + z[i + sz] * q[i + sz];
      fresh[i] = (b[i] + in) / sum;
    });
    float* out = e + begin;
    for_cells(count, [&](int i) RIPSTOP_CELL { out[i] = (i & 1) == kept ? fresh[i] : out[i]; });
  }
}

RIPSTOP_ROW_KERNEL void first_smooth_row(const MultigridRow& row, int parity) {
  const int n = row.n;
  const std::ptrdiff_t sy = row.sy, sz = row.sz;
  float* e = row.e;
  const float *rhs = row.rhs, *cx = row.cx, *cy = row.cy, *cz = row.cz;
  for_cells(n, [=](int i) RIPSTOP_CELL {
    const float sum = cx[i] + cx[i + 1] + cy[i] + cy[i + sy] + cz[i] + cz[i + sz];
    const float fresh = rhs[i] / sum;
    e[i] = (i & 1) == parity ? fresh : 0.0f;
  });
}

RIPSTOP_ROW_KERNEL void residual_row(const MultigridRow& row, float* out) {
  const int n = row.n;
  const std::ptrdiff_t sy = row.sy, sz = row.sz;
  const float* e = row.e;
  const float *rhs = row.rhs, *cx = row.cx, *cy = row.cy, *cz = row.cz;
  for_cells(n, [=](int i) RIPSTOP_CELL {
    out[i] += rhs[i] + cx[i] * (e[i - 1] - e[i]) + cx[i + 1] * (e[i + 1] - e[i]) +
              cy[i] * (e[i - sy] - e[i]) + cy[i + sy] * (e[i + sy] - e[i]) + cz[i] * (e[i - sz] - e[i]) +
              cz[i + sz] * (e[i + sz] - e[i]);
  });
}

RIPSTOP_ROW_KERNEL void add_series_row(int n, const float* face, const float* low, const float* high,
                                       float* sum) {
  for_cells(n, [=](int i) RIPSTOP_CELL {
    // 1 / (1/f + 1/2l + 1/2h), written so that a closed face divides nothing by zero.
    const float product = 2 * low[i] * high[i] * face[i];
    const float whole = 2 * low[i] * high[i] + face[i] * (low[i] + high[i]);
    sum[i] += whole > 0 ? product / whole : 0.0f;
  });
}

RIPSTOP_ROW_KERNEL void mix_rows(int n, const float* a, const float* b, const float* c, const float* d,
                                 float wa, float wb, float wc, float wd, float* out) {
  for_cells(n, [=](int i) RIPSTOP_CELL { out[i] = wa * a[i] + wb * b[i] + wc * c[i] + wd * d[i]; });
}

RIPSTOP_ROW_KERNEL void spread_row(int n, const float* q, const int* near, const int* far,
                                   const float* near_weight, const float* far_weight, float* e) {
  for_cells(n, [=](int i) RIPSTOP_CELL { e[i] += near_weight[i] * q[near[i]] + far_weight[i] * q[far[i]]; });
}

RIPSTOP_ROW_KERNEL ImageSums image_row(const MultigridRow& row, float* image) {
  const int n = row.n;
  const std::ptrdiff_t sy = row.sy, sz = row.sz;
  const float *q = row.e, *rhs = row.rhs, *x = row.cx, *y = row.cy, *z = row.cz;
  const CellSums sums = sum_cells(n, [=](int i) RIPSTOP_CELL {
    const float sum = x[i] + x[i + 1] + y[i] + y[i + sy] + z[i] + z[i + sz];
    const float in = x[i] * q[i - 1] + x[i + 1] * q[i + 1] + y[i] * q[i - sy] + y[i + sy] * q[i + sy] +
                     z[i] * q[i - sz] + z[i + sz] * q[i + sz];
    const float of = sum * q[i] - in;
    image[i] = of;
    const double along = q[i], left = rhs[i];
    return CellSums{along * static_cast<double>(of), along * left, left * left};
  });
  return {sums.a, sums.b, sums.c};
}

RIPSTOP_ROW_KERNEL double dot_row(int n, const float* a, const float* b) {
  const auto product = [=](int i) RIPSTOP_CELL {
    return CellSums{static_cast<double>(a[i]) * static_cast<double>(b[i])};
  };
  return sum_cells(n, product).a;
}

RIPSTOP_ROW_KERNEL void turn_row(int n, float factor, const float* b, float* a) {
  for_cells(n, [=](int i) RIPSTOP_CELL { a[i] = b[i] + factor * a[i]; });
}

RIPSTOP_ROW_KERNEL double advance_row(int n, float factor, const float* direction, const float* image,
                                      float* solution, float* rhs) {
  const auto advance = [=](int i) RIPSTOP_CELL {
    solution[i] += factor * direction[i];
    const float left = rhs[i] - factor * image[i];
    rhs[i] = left;
    return CellSums{static_cast<double>(left) * static_cast<double>(left)};
  };
  return sum_cells(n, advance).a;
}

}  // namespace ripstop::inline flow::cartesian
