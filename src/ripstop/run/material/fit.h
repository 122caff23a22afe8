// From the records of a tensile bench to a material, its report and its files.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/calibration/coupon_fit.h"
#include "ripstop/material/fit_material.h"

namespace ripstop::inline run {

struct FitResult {
  Bench bench;
  MaterialFit fit;                   // with the changes of the material by the coupons
  std::optional<CouponFit> coupons;  // of a fabric, where asked for
};

/// `report` as that of fit_coupons(). Throws as fit_material() and fit_coupons() do.
FitResult run_fit(const Bench& bench, bool with_coupons, ThreadTeam& team,
                  const std::function<void(int, double, double, double)>& report = {});

/// <name>.toml, curve-*.csv and .png, coupon-*.png and .vtp, result.json, and the same as fit.json. Returns
/// the material's file, read back as a case reads it.
std::filesystem::path write_fit(const std::filesystem::path& folder, const FitResult& result);

/// curve-<direction>.csv and .png: measured points, mean, band, fit, simulated coupon.
void write_curves(const std::filesystem::path& folder, const MaterialFit& fit, const Bench& bench,
                  const std::vector<CouponComparison>& coupons);

/// The material as TOML with its provenance in comments.
std::string material_toml(const FitResult& result);
/// Everything of the fit: result.json.
std::string to_json(const FitResult& result);
/// Coupons of `material` compared with the records of a campaign: result.json of `ripstop coupon --bench`.
/// `asked` contains the options.
std::string coupons_json(const Fabric& material, const Bench& bench, const MaterialFit& fit,
                         const std::string& asked, const std::vector<CouponComparison>& coupons);

/// Value, standard error and interval in `unit`; `confidence` is that of the interval, 0.95.
std::string interval_text(const Estimate& estimate, const char* unit, double confidence);
const char* load_unit(const DirectionFit& direction);  // "N" of a line, else "N/m"

}  // namespace ripstop::inline run
