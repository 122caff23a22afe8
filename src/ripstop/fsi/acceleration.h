// Fixed-point acceleration: the next guess of x = g(x) from the guesses and answers so far.
#pragma once

#include <vector>

#include "ripstop/fsi/coupling_settings.h"

namespace ripstop::inline fsi {

/// Everything is in plain vectors so that a checkpoint can carry it.
struct Accelerator {
  Acceleration update = Acceleration::anderson;
  double relaxation = 1;  // of the residual; Aitken starts from it
  int memory = 4;         // differences that Anderson keeps

  std::vector<std::vector<double>> guesses, residuals;  // newest last
  double aitken_factor = 0;

  /// From here on answers are averaged in place of combined: a call before each next() makes the relaxation 1/2, 1/3,
  /// ... of `whole`, so that x becomes the mean of itself and all answers since (Robbins and Monro 1951). With `whole`
  /// 2, from a relaxation of 1: 2/3, 1/2, 2/5, ..., and the n-th answer weighs n.
  void average(double whole);

  /// x and g(x) -> next x. The norm weighs entry i by weight[i] (areas of the cells). Sizes must agree.
  std::vector<double> next(const std::vector<double>& x, const std::vector<double>& g,
                           const std::vector<double>& weight);
};

}  // namespace ripstop::inline fsi
