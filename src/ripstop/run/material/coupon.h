// A virtual coupon pulled, and the files of coupons.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "ripstop/calibration/coupon.h"
#include "ripstop/core/members.h"
#include "ripstop/core/thread_team.h"
#include "ripstop/material/material.h"

namespace ripstop::inline run {

template <Of<CouponPoint> T, class Visit>
void each_member(T& point, Visit&& visit) {
  visit("strain", point.strain);
  visit("load_n_per_m", point.load);
  visit("width_ratio", point.waist);
  visit("corner_peak_ratio", point.corner_peak);
}

/// result.json of `ripstop coupon`.
struct CouponResult {
  std::string material;
  std::optional<std::string> inputs_hash;  // of version, material and options
  int orientation = 0;                     // [deg]
  CouponMesh coupon;
  CouponPull pull;
};
template <Of<CouponResult> T, class Visit>
void each_member(T& r, Visit&& visit) {
  visit("material", r.material);
  visit("inputs_hash", r.inputs_hash);
  visit("orientation_deg", r.orientation);
  visit("length_m", r.coupon.length);
  visit("width_m", r.coupon.width);
  visit("yarn_spacing_m", r.coupon.spacing);
  visit("points", r.pull.points);
  visit("max_strain", r.pull.largest_strain);
  visit("converged", r.pull.converged);
}
std::string to_json(const CouponResult& result);

/// Pulled to `strain` in equal steps; 0: to the strain that the fabric was tested to, or 0.1
/// where that is unknown.
CouponResult run_coupon(const Fabric& fabric, const CouponShape& shape, double strain, int points,
                        ThreadTeam& team);

/// coupon.csv, the picture and surface of write_coupon(), and result.json.
void write_coupon_result(const std::filesystem::path& folder, const CouponResult& result);

/// coupon-<name>.png and .vtp: the deformed coupon coloured by von Mises stress.
void write_coupon(const std::filesystem::path& folder, const std::string& name, const CouponMesh& coupon,
                  const CouponPull& pull);

}  // namespace ripstop::inline run
