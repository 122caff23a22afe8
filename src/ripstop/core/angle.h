#pragma once

#include <numbers>

namespace ripstop::inline core {

inline constexpr double degree = std::numbers::pi / 180;  // [rad]

}  // namespace ripstop::inline core
