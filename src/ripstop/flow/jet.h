// The nozzle of a wind tunnel and the jet that leaves it into still air: pure data, no engine's.
#pragma once

namespace ripstop::inline flow {

enum class NozzleShape { circle, octagon, rectangle };

/// The cross-section of a nozzle, or of a closed test section, about the axis x = y = 0.
struct Nozzle {
  NozzleShape shape = NozzleShape::circle;
  double width = 0;   // along x: diameter of a circle, across the flats of a regular octagon [m]
  double height = 0;  // along y, of a rectangle only [m]

  bool operator==(const Nozzle&) const = default;
};

/// Largest extent along y [m].
double nozzle_height(const Nozzle& nozzle);
double nozzle_area(const Nozzle& nozzle);  // [m2]
/// Of the circle with the nozzle's area [m].
double equivalent_diameter(const Nozzle& nozzle);
/// How far (x, y) lies inside the line of the nearest side; negative outside [m].
double depth_inside(const Nozzle& nozzle, double x, double y);

/// A jet as it leaves the nozzle, through the inlet of the box.
struct Jet {
  Nozzle nozzle;
  double outside = 0.02;     // speed of the air round the nozzle over the jet's
  double shear_layer = 0.1;  // thickness of the edge: difference of speed over the largest slope [m]

  bool operator==(const Jet&) const = default;
};

/// Speed over the nozzle's at (x, y) of the inlet: s + (1 - s) (1 + tanh(2 depth / thickness)) / 2.
double speed_share(const Jet& jet, double x, double y);
/// Its mean over a rectangle, which represents the flux into a coarse cell.
double mean_speed_share(const Jet& jet, double low_x, double high_x, double low_y, double high_y);

}  // namespace ripstop::inline flow
