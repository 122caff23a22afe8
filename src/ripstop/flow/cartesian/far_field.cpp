// Faces through which the air of the stream may come in from any direction. Decided face by face by the sign of the
// flux, which may change from one step to the next:
//
//   in:   p = rho/2 (max(U_n, 0)^2 - u_n^2), the stream's total pressure; the stream's velocity along the face, k and
//         omega;
//   out:  p = 0; nothing changes across the face.
//
// n points into the box, U is the stream's velocity and u_n that of the air in the face. Where the stream leaves
// (U_n < 0) air that a wake sucks back has the total pressure of air at rest. A uniform stream of any direction is an
// exact solution. On the four sides of a stream along z these are entraining sides: U_n = 0.
//
// The pressure follows the flux of the iteration or step before. Where the stream enters, a ripple of the flux as short as
// the cells comes back with the opposite sign and 1.1 times its size; all six faces therefore take half of the change.
#include <algorithm>

#include "ripstop/flow/cartesian/boundary.h"

namespace ripstop::inline flow::cartesian {
namespace {

constexpr double taken = 0.5;  // of the change of the pressure in a face

double component(Vec3 v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

class FarField final : public SideBoundary {
 public:
  explicit FarField(bool everywhere) : everywhere_(everywhere) {}

  bool everywhere() const override { return everywhere_; }
  End pressure_end() const override { return End::fixed_value; }
  float correction_mirror() const override { return -1; }

  void transported(const Discretisation& d, const Fields& f, int k, int normal, double stream,
                   Array<double>& q) const override {
    each_face(d, f, k, [&](const BoxFace& face) {
      if (face.axis != normal && face.inflow > 0) q[face.ghost] = stream;
    });
  }

  void pressure(const Discretisation& d, const Stream& stream, State& s, int k) const override {
    Fields& f = s.f;
    each_face(d, f, k, [&](const BoxFace& face) {
      double held = 0;
      if (face.inflow > 0) {
        const double along = component(stream.velocity, face.axis),
                     enters = std::max(face.low ? along : -along, 0.0);
        held = 0.5 * f.rho[face.cell] * enters * enters - 0.5 * face.inflow * face.inflow / f.rho[face.cell];
      }
      if (everywhere_) held = s.face_p[face.ghost] += taken * (held - s.face_p[face.ghost]);
      f.p[face.ghost] = 2 * held - f.p[face.cell];
      if (face.axis == 2 && !face.low)
        s.outlet_p[face.cell - d.layout.at(0, 0, k) + d.layout.in_plane(0, 0)] = held;
    });
  }

  // From the cells to the faces, half a cell.
  void conductances(const Discretisation& d, const Fields& f, const Array<double>& rc, int j, int k,
                    MultigridLevel& top) const override {
    const Layout& layout = d.layout;
    const std::ptrdiff_t low = layout.at(0, j, k), high = layout.at(layout.nx - 1, j, k);
    const auto conductance = [&](std::ptrdiff_t cell, double width, double area) {
      return static_cast<float>(f.rho[cell] * rc[cell] * 2 / width * area);
    };
    const double area_x = d.y.width[j] * d.z.width[k];
    if (!d.quarter) top.cx[low] = conductance(low, d.x.width.front(), area_x);
    top.cx[high + 1] = conductance(high, d.x.width.back(), area_x);
    for (int i = 0; i < layout.nx; ++i) {
      const double area_y = d.x.width[i] * d.z.width[k], area_z = d.x.width[i] * d.y.width[j];
      if (j == 0 && !d.quarter) top.cy[low + i] = conductance(low + i, d.y.width.front(), area_y);
      if (j == layout.ny - 1)
        top.cy[low + i + layout.stride_y] = conductance(low + i, d.y.width.back(), area_y);
      if (everywhere_ && k == 0) top.cz[low + i] = conductance(low + i, d.z.width.front(), area_z);
    }
  }

 private:
  template <class Visit>
  void each_face(const Discretisation& d, const Fields& f, int k, const Visit& visit) const {
    each_side_face(d, f, k, visit);
    if (everywhere_) each_end_face(d, f, k, visit);
  }

  bool everywhere_;
};

}  // namespace

std::unique_ptr<SideBoundary> entraining_sides() {
  return std::make_unique<FarField>(false);
}

std::unique_ptr<SideBoundary> far_field() {
  return std::make_unique<FarField>(true);
}

}  // namespace ripstop::inline flow::cartesian
