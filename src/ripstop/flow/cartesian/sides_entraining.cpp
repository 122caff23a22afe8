// Sides that hold the outlet's pressure where air leaves; where it comes in it is air of the stream, with the
// stream's total pressure: p = -rho u_n^2 / 2 in the face, w = U, the stream's k and omega.
#include "ripstop/flow/cartesian/boundary.h"

namespace ripstop::cartesian {
namespace {

class Entraining final : public SideBoundary {
 public:
  End pressure_end() const override { return End::fixed_value; }
  float correction_mirror() const override { return -1; }

  void transported(const Discretisation& d, const Fields& f, int k, int normal, double stream,
                   Array<double>& q) const override {
    each_side_face(d, f, k, [&](const SideFace& face) {
      if (face.axis != normal && face.inflow > 0) q[face.ghost] = stream;
    });
  }

  void pressure(const Discretisation& d, Fields& f, int k) const override {
    each_side_face(d, f, k, [&](const SideFace& face) {
      const double side = face.inflow > 0 ? -0.5 * face.inflow * face.inflow / f.rho[face.cell] : 0;
      f.p[face.ghost] = 2 * side - f.p[face.cell];
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
    top.cx[low] = conductance(low, d.x.width.front(), area_x);
    top.cx[high + 1] = conductance(high, d.x.width.back(), area_x);
    for (int i = 0; i < layout.nx; ++i) {
      const double area_y = d.x.width[i] * d.z.width[k];
      if (j == 0) top.cy[low + i] = conductance(low + i, d.y.width.front(), area_y);
      if (j == layout.ny - 1)
        top.cy[low + i + layout.stride_y] = conductance(low + i, d.y.width.back(), area_y);
    }
  }
};

}  // namespace

std::unique_ptr<SideBoundary> entraining_sides() {
  return std::make_unique<Entraining>();
}

}  // namespace ripstop::cartesian
