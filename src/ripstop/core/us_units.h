// SI values in printed text, followed by the same in US customary units.
#pragma once

#include <string>

namespace ripstop {

/// "drag 218.1 N" -> "drag 218.1 N (49.03 lbf)". A value is a number, a blank and one of the units m, m/s, m2, m3, litres, kg, N,
/// N/m, g/m, J, Pa, kg/m2, kg/m3; "1 to 2 m" and "1 +- 0.1 m" have two numbers. The digits of the result are as many as those
/// of the printed number, three at least; both ends of a range have the digits of the longer one, and an
/// uncertainty has the decimals of its value. Text without such values is returned as it is.
std::string with_us_units(const std::string& text);

}  // namespace ripstop
