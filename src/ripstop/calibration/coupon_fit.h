// xi and eps from virtual coupons: the pulls of the bench, done with the cloth solver, until they agree.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ripstop/calibration/coupon.h"
#include "ripstop/core/thread_team.h"
#include "ripstop/material/fit_material.h"

namespace ripstop::inline calibration {

struct CouponFitOptions {
  bool find_shear = true;           // xi; else the fabric's own is kept
  bool find_bending = true;         // eps; likewise
  double bending_threshold = 0.02;  // part of a load that eps must move to be searched
  int cells = 6;                    // across the coupons of the search
  int points = 6;                   // strains at which a searched coupon is compared
  int final_cells = 12;             // of the coupons that are reported
  int final_points = 16;
  double start_shear = 0.2, start_bending = 0.01;
  int most_evaluations = 60;  // of a search; one that ends so has a warning
};

/// A measured curve and that of the virtual coupon.
struct CouponComparison {
  std::string name;  // of the direction
  CouponShape shape;
  std::vector<double> strain, measured, simulated;  // [N/m]
  double r2 = 0;
  CouponMesh coupon;
  CouponPull pull;
};

struct CouponFit {
  Fabric fabric;       // with xi, eps and rescaled coefficients
  double rescale = 1;  // of the coefficients, so that the clamped 0 deg coupon returns its curve
  double shear_low = 0, shear_high = 0;  // confidence interval of xi from the samples' scatter; NaN: unknown
  double bending_effect = 0;  // largest change of a coupon's load when eps goes from 0 to 0.1, relative
  bool searched = false;
  int evaluations = 0;
  double seconds = 0;
  std::vector<CouponComparison> coupons;
  std::vector<std::string> notes, warnings;
};

/// Minimises sum over the directions of 1 - R2 between coupon and mean curve over xi in [0.01, 0.6] and eps
/// in [0, 0.2] with BOBYQA (M. Powell 2009, as in NLopt). Pulls in the plane hardly feel eps: where 0 -> 0.1
/// moves no load by `bending_threshold`, eps stays at its start, and xi is searched alone (COBYLA); else a
/// prior of weight 1e-4 about the start keeps the optimum single. Without a 45 deg curve nothing is searched.
/// Throws Error(not_converged) when no coupon comes to rest.
CouponFit fit_coupons(const MaterialFit& fit, const Bench& bench, const CouponFitOptions& options,
                      ThreadTeam& team, const std::function<void(int, double, double, double)>& report = {});

/// The coupons of the directions that were measured, pulled with the given fabric.
std::vector<CouponComparison> compare_coupons(const MaterialFit& fit, const Fabric& fabric, int cells,
                                              int points, ThreadTeam& team);

}  // namespace ripstop::inline calibration
