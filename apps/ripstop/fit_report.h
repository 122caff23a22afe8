// Output that fit and coupon have in common.
#pragma once

#include <vector>

#include "ripstop/calibration/coupon_fit.h"

namespace ripstop::cli {

void print_coupons(const std::vector<CouponComparison>& coupons);

}  // namespace ripstop::cli
