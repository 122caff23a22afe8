// Round numbers along an axis.
#pragma once

#include <string>
#include <vector>

namespace ripstop::inline output {

/// Round numbers in steps of 1, 2 or 5 times a power of ten, about `count` of them, within [low, high].
std::vector<double> ticks(double low, double high, int count);
/// Powers of ten within [low, high], 0 < low; thinned to about `count`.
std::vector<double> logarithmic_ticks(double low, double high, int count);
/// The label of a tick among others at distance `step`: no more digits than needed to distinguish them.
std::string tick_label(double value, double step);

}  // namespace ripstop::inline output
