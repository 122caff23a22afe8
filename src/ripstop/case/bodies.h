// Rigid bodies upstream of the canopy: [body.<name>].
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "ripstop/flow/flow.h"
#include "ripstop/material/material.h"

namespace ripstop {
class Fields;
class Findings;
}  // namespace ripstop

namespace ripstop::inline parachute {
struct Design;
}

namespace ripstop::inline cases {

class Settings;
struct Case;

struct SphereKeys {
  double diameter_m = 0;
};
struct CylinderKeys {
  double diameter_m = 0, length_m = 0;
  double nose_length_m = 0;  // part of the length; 0: a flat front
};
struct CapsuleKeys {
  double diameter_m = 0, length_m = 0;
  double nose_radius_m = 0, base_diameter_m = 0;
};
struct BoxKeys {
  Vec3 size_m;
};
/// Its z axis lies along the stream, its nose at the smallest z.
struct StlKeys {
  std::string file;  // relative to the case file
  double scale = 1;  // metres in a unit of the file
};

/// [body.<name>] as given.
struct BodyKeys {
  std::variant<SphereKeys, CylinderKeys, CapsuleKeys, BoxKeys, StlKeys> shape;
  std::optional<double> trailing_distance_m;  // from its aft end to the skirt of the start shape
  double x_m = 0, y_m = 0;                    // of its axis from that of the canopy
  std::optional<double> reference_area_m2;    // absent: the frontal area
};
void describe(Fields& fields, SphereKeys& keys);
void describe(Fields& fields, CylinderKeys& keys);
void describe(Fields& fields, CapsuleKeys& keys);
void describe(Fields& fields, BoxKeys& keys);
void describe(Fields& fields, StlKeys& keys);
void describe(Fields& fields, BodyKeys& keys);

/// Checks the proportions of the bodies, and that the cloth can be in one flow with them.
void check_bodies(const Case& given, PorosityModel model, Findings& findings);

/// Along and across the stream [m]; 0 for a file, which is read only with the flow.
struct BodySize {
  double length = 0, width = 0;
};
BodySize size_of(const BodyKeys& keys);
/// From the skirt of the inflated canopy to the end of the riser, about [m].
double usual_trailing_distance(const Design& parachute);

/// How far the bodies extend upstream of the skirt, and the width of the widest one [m].
struct BodiesAhead {
  double front = 0, width = 0;
  /// Their front, half a width or four widths farther upstream: there the fine cells, and the domain begin.
  double fine_front() const { return front + 0.5 * width; }
  double domain_front() const { return front + 4 * width; }
};
BodiesAhead bodies_ahead(const Case& given);

/// The bodies of a case as bodies of a flow, in the order of their names. Throws Error(bad_data) for a surface that is
/// not closed, and for a file that is no STL.
std::vector<FlowBody> rigid_bodies(const Settings& resolved);
/// Of the drag coefficient of one of them, as placed by rigid_bodies() [m2].
double reference_area(const Settings& resolved, const FlowBody& body);

}  // namespace ripstop::inline cases
