#include "ripstop/flight/atmosphere.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "ripstop/core/error.h"

namespace ripstop::inline flight {
namespace {

// U.S. Standard Atmosphere, 1976 (NOAA-S/T 76-1562), Table 4: bottoms of the layers and their lapse rates.
struct Layer {
  double bottom;      // geopotential [m]
  double lapse_rate;  // [K/m]
};
constexpr Layer layers[] = {{0, -6.5e-3}, {11000, 0},       {20000, 1.0e-3}, {32000, 2.8e-3},
                            {47000, 0},   {51000, -2.8e-3}, {71000, -2.0e-3}};
constexpr double sea_level_temperature = 288.15;    // [K]
constexpr double sea_level_pressure = 101325;       // [Pa]
constexpr double earth_radius = 6356766;            // of the standard's gravity [m]
constexpr double gas_constant = 8314.32 / 28.9644;  // of air, with the standard's own R* [J/(kg K)]
constexpr double heat_ratio = 1.4;
// Sutherland's law as the standard has it, Table 2 and Eq. 51.
constexpr double sutherland_beta = 1.458e-6;  // [kg/(s m K^1/2)]
constexpr double sutherland_s = 110.4;        // [K]

/// Pressure ratio over a rise of `rise` in a layer that begins with `temperature`; Eq. 33a and 33b.
double pressure_ratio(double temperature, double lapse_rate, double rise) {
  if (lapse_rate == 0) return std::exp(-standard_gravity * rise / (gas_constant * temperature));
  return std::pow(temperature / (temperature + lapse_rate * rise),
                  standard_gravity / (gas_constant * lapse_rate));
}

}  // namespace

double geopotential_height(double height) {
  return earth_radius * height / (earth_radius + height);
}

StandardAir standard_air(double height) {
  if (!(height >= lowest_height && height <= highest_height))
    throw Error(ExitCode::usage, fmt::format("a height of {:g} m: the standard atmosphere is given from {:g} "
                                             "to {:g} m",
                                             height, lowest_height, highest_height));
  const double wanted = geopotential_height(height);
  StandardAir air;
  air.temperature = sea_level_temperature;
  air.pressure = sea_level_pressure;
  for (std::size_t i = 0; i < std::size(layers); ++i) {
    const bool last = i + 1 == std::size(layers) || wanted <= layers[i + 1].bottom;
    const double rise = (last ? wanted : layers[i + 1].bottom) - layers[i].bottom;
    air.pressure *= pressure_ratio(air.temperature, layers[i].lapse_rate, rise);
    air.temperature += layers[i].lapse_rate * rise;
    if (last) break;
  }
  air.density = air.pressure / (gas_constant * air.temperature);
  air.sound_speed = std::sqrt(heat_ratio * gas_constant * air.temperature);
  air.viscosity = sutherland_beta * std::pow(air.temperature, 1.5) / (air.temperature + sutherland_s);
  return air;
}

double standard_height(double density) {
  double low = lowest_height, high = highest_height;  // the density falls with the height
  if (!(density <= standard_air(low).density && density >= standard_air(high).density))
    throw Error(
        ExitCode::usage,
        fmt::format("a density of {:g} kg/m3: the standard atmosphere has {:.3g} to {:.3g} kg/m3 between "
                    "{:g} and {:g} m",
                    density, standard_air(high).density, standard_air(low).density, low, high));
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (standard_air(middle).density > density ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double nearest_standard_height(double density) {
  return standard_height(
      std::clamp(density, standard_air(highest_height).density, standard_air(lowest_height).density));
}

double density_ratio(double height, double fallen) {
  return standard_air(std::max(height - fallen, lowest_height)).density / standard_air(height).density;
}

}  // namespace ripstop::inline flight
