// Samples that are copies of one another: a copy narrows the scatter by a pull that nobody made.
#pragma once

#include <cstddef>
#include <vector>

#include "ripstop/material/clean.h"

namespace ripstop::inline material {

/// Share of the noise of one record that differs from another: their difference, after the best shift and scale,
/// relative to the noise of each. 0: the same noise, hence the same test, however scaled, shifted, thinned out or
/// rounded; near 1 or above: two tests. Noise is the residual of neighbouring points from a cubic (fourth
/// differences), in at most 240 points. Where loads are rounded to steps above the noise (5 N on a load cell of 5
/// kN), tests of one cloth share the steps, and only records that are the same step by step have a value below 1: a
/// copy that was resampled or rounded to other coarse steps is then not detected. 1 if the records have too few
/// points in common, or no noise.
double own_noise(const CleanRecord& a, const CleanRecord& b);

struct Copy {
  std::size_t first = 0, second = 0;  // of the records
  double own_noise = 0;
};

/// Every pair that shares most of its noise: own_noise() below 0.3.
std::vector<Copy> find_copies(const std::vector<CleanRecord>& records);

/// Below this two records are one pull; up to 0.3 it is likely.
inline constexpr double surely_copied = 0.1;

}  // namespace ripstop::inline material
