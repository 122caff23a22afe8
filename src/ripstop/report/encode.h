// Numbers as compact text inside a page: quantised, as differences, deflated, base64.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ripstop::inline report {

std::string base64(std::string_view bytes);

/// Whole numbers of 2 or 4 bytes, `components` neighbours each: differences from the tuple before (modulo the
/// size), low bytes of all first, then the next ones, deflated.
std::string pack_integers(const std::vector<std::uint32_t>& values, int components, int bytes);

/// Values as 0 .. levels between the least and the largest of their component; not-a-number is 65535.
struct Quantised {
  std::vector<std::uint32_t> values;
  std::vector<double> low, step;  // of each component: value = low + step * number
};
inline constexpr std::uint32_t no_number = 65535;
inline constexpr int finest_levels = 65534;
Quantised quantise(const std::vector<double>& values, int components, int levels = finest_levels);

}  // namespace ripstop::inline report
