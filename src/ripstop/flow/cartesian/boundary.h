// The boundaries of the box, each a value of its kind: ghosts, fluxes, conductances and its part of the
// momentum balance. A new kind is one file like inlet_jet.cpp, sides_slip.cpp, far_field.cpp or
// outlet_still_air.cpp, and its row in boundary.cpp.
#pragma once

#include <memory>
#include <optional>

#include "ripstop/flow/cartesian/discretisation.h"
#include "ripstop/flow/cartesian/multigrid.h"
#include "ripstop/flow/cartesian/state.h"

namespace ripstop::inline flow::cartesian {

/// The undisturbed air, wherever it comes in.
struct Stream {
  Vec3 velocity;            // [m/s]
  double k = 0, omega = 0;  // [m2/s2], [1/s]
};

/// Given velocity (along z), k and omega in the faces of the inlet; the pressure has no gradient there.
struct Inlet {
  explicit Inlet(const Layout& layout);

  /// Of row j, at cell 0.
  const double* speed(int j) const { return &w[layout.in_plane(0, j)]; }
  const double* turbulence(int j) const { return &k[layout.in_plane(0, j)]; }
  const double* frequency(int j) const { return &omega[layout.in_plane(0, j)]; }

  Layout layout;
  Array<double> w, k, omega;  // planes [m/s], [m2/s2], [1/s]
  Stream stream;              // of a jet: the air round its nozzle
  double mean_speed = 0;      // along z over the inlet [m/s]
};
Inlet uniform_inlet(const Discretisation& d);
Inlet jet_inlet(const Discretisation& d, const Jet& jet);

/// A face in the surface of the box: the axis across it, whether it is the low end of that axis, the ghost beyond, the
/// cell inside, the mass flux per area into the box.
struct BoxFace {
  int axis;
  bool low;
  std::ptrdiff_t ghost, cell;
  double inflow;
};

/// The four sides, or all six faces. By itself sides without gradient: air passes as it moves just inside, the pressure
/// free.
class SideBoundary {
 public:
  virtual ~SideBoundary() = default;

  /// Whether it takes the place of inlet and outlet too.
  virtual bool everywhere() const { return false; }
  virtual End pressure_end() const { return End::zero_gradient; }
  /// Ghost over cell, of the velocity across the side and of the pressure correction.
  virtual double mirror() const { return 1; }
  virtual float correction_mirror() const { return 1; }
  /// Ghosts where they are not those of mirror(): of a quantity that the stream has with the value `stream`. `normal`
  /// is the axis of a velocity's component, or `no_axis`.
  virtual void transported(const Discretisation&, const Fields&, int /*k*/, int /*normal*/, double /*stream*/,
                           Array<double>& /*q*/) const {}
  /// Of the pressure, and State::outlet_p where it is everywhere.
  virtual void pressure(const Discretisation&, const Stream&, State&, int /*k*/) const {}
  /// Of the faces of row (j, k), for the pressure correction.
  virtual void conductances(const Discretisation&, const Fields&, const Array<double>& /*rc*/, int /*j*/,
                            int /*k*/, MultigridLevel&) const {}
};
constexpr int no_axis = -1;
std::unique_ptr<SideBoundary> open_sides();
std::unique_ptr<SideBoundary> slip_sides();
std::unique_ptr<SideBoundary> entraining_sides();
std::unique_ptr<SideBoundary> far_field();

/// The end of the box. By itself one of fixed pressure, where air that comes back has no momentum.
class OutletBoundary {
 public:
  virtual ~OutletBoundary() = default;

  /// Whether air that comes back has the velocity, k and omega of the cell that it comes into.
  virtual bool carries_back() const { return false; }
  /// The pressure in the outlet's faces of row j, from the fluxes there.
  virtual void pressure(int /*n*/, const double* /*flux*/, const double* /*rho*/, double* /*p*/) const {}
};
std::unique_ptr<OutletBoundary> fixed_pressure_outlet();
std::unique_ptr<OutletBoundary> still_air_outlet();

struct Boundaries {
  Inlet inlet;
  std::unique_ptr<SideBoundary> sides;
  std::unique_ptr<OutletBoundary> outlet;

  /// Whether air passes all six faces by the sides' rules: there is neither inlet nor outlet.
  bool open() const { return sides->everywhere(); }
};
Inlet make_inlet(const Discretisation& d, const std::optional<Jet>& jet);
/// Throw Error(usage) for a word that no row of boundaries() has.
std::unique_ptr<SideBoundary> make_sides(Sides kind);
std::unique_ptr<OutletBoundary> make_outlet(Outlet kind);

/// visit(BoxFace) for the faces of plane k in the sides; planes of symmetry are none.
template <class Visit>
void each_side_face(const Discretisation& d, const Fields& f, int k, Visit&& visit) {
  const Layout& layout = d.layout;
  const std::ptrdiff_t sy = layout.stride_y;
  for (int j = 0; j < layout.ny; ++j) {
    const std::ptrdiff_t low = layout.at(0, j, k), high = layout.at(layout.nx - 1, j, k);
    if (!d.quarter) visit(BoxFace{0, true, low - 1, low, f.fx[low]});
    visit(BoxFace{0, false, high + 1, high, -f.fx[high + 1]});
  }
  for (int i = 0; i < layout.nx; ++i) {
    const std::ptrdiff_t low = layout.at(i, 0, k), high = layout.at(i, layout.ny - 1, k);
    if (!d.quarter) visit(BoxFace{1, true, low - sy, low, f.fy[low]});
    visit(BoxFace{1, false, high + sy, high, -f.fy[high + sy]});
  }
}

/// And for those in the two ends, where plane k is the first or the last one.
template <class Visit>
void each_end_face(const Discretisation& d, const Fields& f, int k, Visit&& visit) {
  const Layout& layout = d.layout;
  const std::ptrdiff_t sz = layout.stride_z;
  for (int j = 0; j < layout.ny; ++j) {
    const std::ptrdiff_t at = layout.at(0, j, k);
    for (std::ptrdiff_t c = at; k == 0 && c < at + layout.nx; ++c)
      visit(BoxFace{2, true, c - sz, c, f.fz[c]});
    for (std::ptrdiff_t c = at; k == layout.nz - 1 && c < at + layout.nx; ++c)
      visit(BoxFace{2, false, c + sz, c, -f.fz[c + sz]});
  }
}

/// Ghosts of plane k, inlet and outlet included where the plane is the first or the last one.
void velocity_ghosts(const Discretisation& d, const Boundaries& b, State& s, int k);
void turbulence_ghosts(const Discretisation& d, const Boundaries& b, State& s, int k);
void pressure_ghosts(const Discretisation& d, const Boundaries& b, State& s, int k);
/// Of any quantity, at the sides only. `normal` is the axis of a velocity's component, which is multiplied by `mirror`
/// across the sides of that axis, and changes its sign in a plane of symmetry; else `no_axis`.
void side_ghosts(const Discretisation& d, Array<double>& q, int k, int normal = no_axis, double mirror = 1);
/// The correction uses the ghosts of the pressure while velocities are corrected; the solver needs zeros
/// there.
void correction_ghosts(const Discretisation& d, const Boundaries& b, Array<float>& e, int k);

/// Momentum that the air carries into the box through its faces in a step in time [N].
Vec3 momentum_carried_in(const Discretisation& d, const Boundaries& b, const State& s);
/// Momentum that the pressure in the faces adds to the box [N]: in faces with fixed pressure, or in the
/// others.
Vec3 pressed_in(const Discretisation& d, const Boundaries& b, const State& s, bool where_held);
/// Momentum that the air brings through the faces of the box, pressure and diffusion included: the force on whatever
/// is inside [N].
Vec3 momentum_deficit(const Discretisation& d, const Boundaries& b, const State& s);

}  // namespace ripstop::inline flow::cartesian
