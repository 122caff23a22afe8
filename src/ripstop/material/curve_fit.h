// Fit of a curve to several cleaned records of one direction: mean, spread, polynomial, confidence interval.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ripstop/material/clean.h"

namespace ripstop::inline material {

enum class DegreeRule { cross_validation, nfm };

struct FitOptions {
  std::optional<int> degree;  // absent: `rule` chooses
  DegreeRule rule = DegreeRule::cross_validation;
  double wanted_r2 = 0.95;       // of the rule of [NFM], section "from tests to coefficients"
  double working_strain = 0.05;  // up to where canopies work: see strain_weight()
  int highest_degree = 6;        // that is chosen
  bool zero_offset = true;       // fit through the origin; false: with K_0, which no spring carries
  double confidence = 0.95;      // of intervals and bands
};

/// A number with its confidence interval.
struct Estimate {
  double value = 0;
  double standard_error = 0;  // of the mean over the samples
  double
      low = 0,
      high =
          0;  // confidence interval; that of K_1 includes the error of a degree that is too low, and may be asymmetric
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
  std::vector<double> band_low, band_high;  // pointwise confidence band of the mean curve

  std::vector<double> coefficients() const;  // K_1 .. K_n
};

/// Mean over the samples, each resampled by averages over equal steps of strain (interpolated where a step
/// has no point), as far as all of them go. Throws Error(bad_data) for samples that cannot be the same cloth:
/// a load ten times another's at the same strain.
MeanCurve mean_curve(const std::vector<CleanRecord>& samples);

/// Weight of a squared residual at a strain: 1 up to `working_strain`, (working_strain / strain)^2 beyond it, about the
/// inverse variance of samples that differ in stiffness. 1 everywhere by the rule of [NFM].
double strain_weight(double strain, const FitOptions& options);

/// Least squares of [NFM] Eq. 10 for the mean curve, weighted by strain_weight(). Points along one record err
/// together, so the samples are the independent unit: the fit is linear, the coefficients of the mean curve are the
/// mean of the samples' own coefficients, and their scatter gives standard errors and Student t intervals with n - 1
/// degrees of freedom. A polynomial is not the law: the band, and the interval of K_1, the stiffness at no strain,
/// are those of a fit two degrees higher, which has next to no bias left (S. Calonico, M. Cattaneo, R. Titiunik,
/// Econometrica 82, 2014), widened to hold the fit itself. The intervals of K_0 and of K_2 and on are of the
/// polynomial of this degree nearest the law. With one sample there is no interval (NaN).
CurveFit fit_curve(const MeanCurve& curve, int degree, const FitOptions& options);

/// Mean over the curves of the weighted squared error with which the other samples' fit predicts each sample,
/// relative to the weighted squared load. Curves of one sample are left out; NaN when all are.
double prediction_error(const std::vector<MeanCurve>& curves, int degree, const FitOptions& options);

/// The degree of `options`, or the lowest one for all curves that its rule allows. By cross-validation: the
/// prediction error is within 1 % of the least, so that a higher degree would gain less than a tenth of the scatter
/// of the samples; degrees with K_1 <= 0 only where all have it. By the rule of [NFM], and with one sample a curve:
/// every curve's R2 exceeds `wanted_r2`; throws Error(bad_data) that names the worst curve when even the highest does
/// not.
int choose_degree(const std::vector<MeanCurve>& curves, const FitOptions& options);

}  // namespace ripstop::inline material
