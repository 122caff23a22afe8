#include "fit_report.h"

#include <fmt/format.h>

namespace ripstop::cli {

void print_coupons(const std::vector<CouponComparison>& coupons) {
  for (const CouponComparison& c : coupons) {
    const CouponPoint& end = c.pull.points.back();
    fmt::print(
        "  coupon {:<5} R2 {:.4f}, at strain {:.3g}: {:.4g} N/m (measured {:.4g}), relative width at "
        "mid-length {:.3f}, stress at a clamp corner / at mid-length {:.2f}\n",
        c.name, c.r2, end.strain, end.load, c.measured.back(), end.waist, end.corner_peak);
  }
}

}  // namespace ripstop::cli
