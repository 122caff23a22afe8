// From several cleaned records of one direction to a curve: mean, spread, polynomial, what chance allows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ripstop/material/clean.h"

namespace ripstop {

struct FitOptions {
  std::optional<int> degree;  // absent: the lowest with R2 above `wanted_r2` in every direction
  double wanted_r2 = 0.95;    // [NFM] section "from tests to coefficients"
  int highest_degree = 6;
  bool zero_offset = false;  // fit through the origin instead of with K_0
  double confidence = 0.95;  // of intervals and bands
};

/// A number with what chance allows it to be.
struct Estimate {
  double value = 0;
  double standard_error = 0;  // of the mean over the samples
  double low = 0, high = 0;   // confidence interval
};

/// Load over strain at `strain.size()` equally spaced strains up to where the first sample failed.
struct MeanCurve {
  double orientation = 0;
  std::vector<double> strain, load;
  std::vector<double> spread;                // standard deviation over the samples
  std::vector<std::vector<double>> samples;  // each resampled
  std::vector<std::string> names;
  std::vector<double> failure_strain, failure_load;  // of each sample
  double tested_strain = 0;
};

struct CurveFit {
  int degree = 0;
  Estimate offset;          // K_0; all zero when fitted through the origin
  std::vector<Estimate> k;  // K_1 .. K_n
  double r2 = 0;            // of the fit to the mean curve
  double r2_all = 0;        // to all samples' points: the spread counts as misfit
  double tested_strain = 0;
  double rising_until = 0;                  // the curve rises up to here; tested_strain when everywhere
  std::vector<double> fit;                  // at MeanCurve::strain
  std::vector<double> band_low, band_high;  // pointwise confidence band of the mean curve's polynomial

  std::vector<double> coefficients() const;  // K_1 .. K_n
};

/// Mean over the samples, each resampled by averages over equal steps of strain (interpolated where a step
/// has no point), as far as all of them go. Throws Error(bad_data) for samples that cannot be the same cloth:
/// a load ten times another's at the same strain.
MeanCurve mean_curve(const std::vector<CleanRecord>& samples);

/// Least squares of [NFM] Eq. 10 for the mean curve. Points along one record err together, so the samples are
/// the independent unit: the fit is linear, the coefficients of the mean curve are the mean of the samples'
/// own coefficients, and their scatter gives standard errors and Student t intervals with n - 1 degrees of
/// freedom, for coefficients and for the curve at every strain. With one sample there is no interval (NaN).
CurveFit fit_curve(const MeanCurve& curve, int degree, const FitOptions& options);

/// The degree of `options`, or the lowest one for which every curve's R2 exceeds `wanted_r2`. Throws
/// Error(bad_data) that names the worst curve when even the highest does not.
int choose_degree(const std::vector<MeanCurve>& curves, const FitOptions& options);

}  // namespace ripstop
