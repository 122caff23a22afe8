// Row kernels of the multigrid solver, see multigrid.h.
#pragma once

#include <cstddef>

namespace ripstop::inline flow::cartesian {

struct MultigridRow {
  int n = 0;
  std::ptrdiff_t sy = 0, sz = 0;
  float* e = nullptr;
  const float *rhs = nullptr, *cx = nullptr, *cy = nullptr, *cz = nullptr;
};
/// Gauss-Seidel on the cells whose i has the given parity.
void smooth_row(const MultigridRow& row, int parity);
/// The first half sweep from e = 0, without reading e.
void first_smooth_row(const MultigridRow& row, int parity);
/// sum[i] += rhs - A e
void residual_row(const MultigridRow& row, float* sum);
/// Of the conjugate gradients: image = A e with the row's e, and the sums e image, e rhs and rhs rhs; sum a b;
/// a = b + factor a; a step along a direction, and the remaining rhs rhs.
struct ImageSums {
  double curvature, descent, square;
};
ImageSums image_row(const MultigridRow& row, float* image);
double dot_row(int n, const float* a, const float* b);
void turn_row(int n, float factor, const float* b, float* a);
double advance_row(int n, float factor, const float* direction, const float* image, float* solution,
                   float* rhs);
/// sum[i] += conductance of a face in series with half of two others; zero if the face is closed.
void add_series_row(int n, const float* face, const float* low, const float* high, float* sum);
/// out = sum of four rows with weights.
void mix_rows(int n, const float* a, const float* b, const float* c, const float* d, float wa, float wb,
              float wc, float wd, float* out);
/// e[i] += near_weight[i] q[near[i]] + far_weight[i] q[far[i]]
void spread_row(int n, const float* q, const int* near, const int* far, const float* near_weight,
                const float* far_weight, float* e);

}  // namespace ripstop::inline flow::cartesian
