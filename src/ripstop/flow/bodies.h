// Bodies of simple shape as surfaces: those with a known drag, closed ones in front of a canopy, and a rigid inflated
// disk-gap-band.
#pragma once

#include <string>
#include <vector>

#include "ripstop/flow/flow.h"

namespace ripstop::inline flow {

/// A point of a body's outline in the plane of its axis (z along the stream).
struct OutlinePoint {
  double radius, z;  // [m]
};

/// The surface that an outline sweeps about the z axis through `centre`; z counts from centre.z.
std::vector<Triangle> revolve(const std::vector<OutlinePoint>& outline, Vec3 centre, int segments);

/// Disk normal to the stream.
std::vector<Triangle> disk(double diameter, Vec3 centre);
/// Square plate normal to the stream.
std::vector<Triangle> square_plate(double side, Vec3 centre);
/// Half a spherical shell whose mouth, at centre.z, faces the stream.
std::vector<Triangle> hemispherical_cup(double diameter, Vec3 centre);
// Closed surfaces, normals outward. The axis is z, the nose points against the stream, and the aft end lies at centre.z.

std::vector<Triangle> sphere(double diameter, Vec3 centre);
/// With a nose in the form of half an ellipsoid, `nose_length` long, as part of the length (0: flat); its base is flat.
std::vector<Triangle> nosed_cylinder(double diameter, double length, double nose_length, Vec3 centre);
/// Of re-entry: a spherical front of radius `nose_radius` with its full diameter at the rear of the front, and a cone to
/// a flat base of diameter `base`. The front is part of the length.
std::vector<Triangle> capsule(double diameter, double length, double nose_radius, double base, Vec3 centre);
std::vector<Triangle> block(Vec3 size, Vec3 centre);

/// Throws Error(bad_data) for a surface that is not closed, or whose normals point inward: the number of edges with
/// one triangle only, and one of their places. `name` is for the message.
void check_closed(const std::vector<Triangle>& surface, const std::string& name);
/// Volume and centre of volume of a closed surface with normals outward.
struct Enclosed {
  double volume = 0;  // [m3]
  Vec3 centre;        // [m]
};
Enclosed enclosed_by(const std::vector<Triangle>& surface);
/// The load that the air about a solid body exerts in a frame that accelerates. The flow computes that force on the air
/// of its cells inside too, `force_on_air` a volume [N/m3], which the faces of the body carry. On 7 to 12 cells across a
/// sphere or a cube the remaining added mass differs by 0.2 of the displaced air from the exact one.
BodyLoad without_displaced_air(BodyLoad load, const FlowBody& body, Vec3 force_on_air);
/// Of a closed surface, across the z axis; hollows seen from the front count several times [m2].
double frontal_area(const std::vector<Triangle>& surface);

/// The surface turned about the origin such that its z axis lies along the unit vector `axis`, by the shortest way.
std::vector<Triangle> turned(std::vector<Triangle> surface, Vec3 axis);
/// A rigid disk-gap-band about as large as Stratos IV when inflated (band 0.65 m in diameter and 0.28 m high, gap
/// 0.06 m, dome 0.18 m high, vent 0.09 m); its band's upper edge lies at centre.z + 0.09 m. Not a result of the cloth
/// solver: a body of similar size for studies of the flow alone.
std::vector<Triangle> rigid_disk_gap_band(Vec3 centre);

}  // namespace ripstop::inline flow
