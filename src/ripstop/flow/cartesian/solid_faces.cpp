#include "ripstop/flow/cartesian/solid_faces.h"

#include <algorithm>
#include <array>

#include "ripstop/flow/hems.h"

namespace ripstop::inline flow::cartesian {
namespace {

/// Triangle where the line along z through the centre of each cell has entered the body; -1 outside.
std::vector<int> entered(const Axis& x, const Axis& y, const Axis& z,
                         const std::vector<SheetFace>& of_surface) {
  const std::size_t plane = static_cast<std::size_t>(x.n) * y.n;
  std::vector<std::vector<const SheetFace*>> columns(plane);
  for (const SheetFace& face : of_surface)
    if (face.axis == 2) columns[face.i + static_cast<std::size_t>(x.n) * face.j].push_back(&face);
  std::vector<int> result(plane * z.n, -1);
  for (std::size_t column = 0; column < plane; ++column) {
    std::vector<const SheetFace*>& faces = columns[column];
    std::sort(faces.begin(), faces.end(),
              [](const SheetFace* a, const SheetFace* b) { return a->point.z < b->point.z; });
    for (std::size_t n = 0; n + 1 < faces.size(); n += 2)
      for (int k = faces[n]->k; k < faces[n + 1]->k; ++k) result[column + plane * k] = faces[n]->triangle;
  }
  return result;
}

/// The low face of cell c across `axis`.
SheetFace face_inside(const std::array<const Axis*, 3>& axes, std::size_t axis, const std::array<int, 3>& c,
                      int triangle) {
  SheetFace face;
  face.axis = static_cast<int>(axis), face.i = c[0], face.j = c[1], face.k = c[2];
  face.triangle = triangle, face.enclosed = true, face.area = 1;
  std::array<double, 3> point{}, normal{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double width = axes[a]->width[c[a]];
    point[a] = axes[a]->edge[c[a]] + (a == axis ? 0 : 0.5 * width);
    if (a != axis) face.area *= width;
  }
  normal[axis] = 1;
  face.point = {point[0], point[1], point[2]};
  face.normal = face.across = face.outward = {normal[0], normal[1], normal[2]};
  return face;
}

std::vector<SheetFace> faces_inside(const std::array<const Axis*, 3>& axes,
                                    const std::vector<SheetFace>& of_surface) {
  const auto& [x, y, z] = axes;
  const std::vector<int> triangle = entered(*x, *y, *z, of_surface);
  const auto of_cell = [&](const std::array<int, 3>& c) {
    return triangle[c[0] + static_cast<std::size_t>(x->n) * (c[1] + static_cast<std::size_t>(y->n) * c[2])];
  };
  std::vector<SheetFace> result;
  std::array<int, 3> c{};
  for (c[2] = 0; c[2] < z->n; ++c[2]) {
    for (c[1] = 0; c[1] < y->n; ++c[1]) {
      for (c[0] = 0; c[0] < x->n; ++c[0]) {
        if (of_cell(c) < 0) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          std::array<int, 3> before = c;
          if (--before[axis] >= 0 && of_cell(before) >= 0)
            result.push_back(face_inside(axes, axis, c, of_cell(c)));
        }
      }
    }
  }
  return result;
}

}  // namespace

bool is_solid(const FlowBody& sheet) {
  const PressureDrop& law = sheet.drop();
  return law.linear >= impermeable.linear && sheet.motion.velocity.empty() && !sheet.surface.empty() &&
         hems(sheet.surface).empty();
}

std::vector<SheetFace> faces_of(const Axis& x, const Axis& y, const Axis& z, const FlowBody& sheet,
                                ThreadTeam* team) {
  std::vector<SheetFace> faces = sheet_faces(x, y, z, sheet.surface, team);
  if (!is_solid(sheet)) return faces;
  const std::vector<SheetFace> inside = faces_inside({&x, &y, &z}, faces);
  faces.insert(faces.end(), inside.begin(), inside.end());
  for (SheetFace& face : faces) face.solid = true;
  return faces;
}

}  // namespace ripstop::inline flow::cartesian
