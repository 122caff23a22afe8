// What fit and coupon share: tables, plots and pictures of coupons.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/calibration/coupon_fit.h"
#include "ripstop/material/fit_material.h"

namespace ripstop {

void print_directions(const MaterialFit& fit);
void print_coupons(const std::vector<CouponComparison>& coupons);

/// curve-<direction>.csv and .png: measured points, mean, band, fit, simulated coupon.
void write_curves(const std::filesystem::path& folder, const MaterialFit& fit, const Bench& bench,
                  const std::vector<CouponComparison>& coupons);
/// coupon-<name>.png and .vtp: the deformed coupon coloured by von Mises stress.
void write_coupon(const std::filesystem::path& folder, const std::string& name, const CouponMesh& coupon,
                  const CouponPull& pull);

/// The material as TOML with its provenance in comments.
std::string material_toml(const MaterialFit& fit, const Bench& bench, const Material& material,
                          const CouponFit* coupons);
/// Everything of the fit as JSON.
std::string fit_json(const MaterialFit& fit, const Bench& bench, const Material& material,
                     const CouponFit* coupons);

}  // namespace ripstop
