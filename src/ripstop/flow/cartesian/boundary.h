// The boundaries of the box, each one value that says what it is: ghosts, fluxes, conductances and its part
// of the momentum ledger. A new kind is one file beside inlet_jet.cpp, sides_slip.cpp, sides_entraining.cpp
// or outlet_still_air.cpp, and its line in boundary.cpp.
#pragma once

#include <memory>
#include <optional>

#include "ripstop/flow/cartesian/discretisation.h"
#include "ripstop/flow/cartesian/multigrid.h"
#include "ripstop/flow/cartesian/state.h"

namespace ripstop::cartesian {

/// Given velocity (along z), k and omega in the faces of the inlet; the pressure has no gradient there.
struct Inlet {
  explicit Inlet(const Layout& layout);

  /// Of row j, at cell 0.
  const double* speed(int j) const { return &w[layout.in_plane(0, j)]; }
  const double* turbulence(int j) const { return &k[layout.in_plane(0, j)]; }
  const double* frequency(int j) const { return &omega[layout.in_plane(0, j)]; }

  Layout layout;
  Array<double> w, k, omega;  // planes [m/s], [m2/s2], [1/s]
  // Of the undisturbed air, wherever else it comes in.
  double stream_speed = 0, stream_k = 0, stream_omega = 0;
  double mean_speed = 0;  // over the inlet [m/s]
};
Inlet uniform_inlet(const Discretisation& d);
Inlet jet_inlet(const Discretisation& d, const Jet& jet);

/// A face in a side of the box: the axis across it, the ghost beyond, the cell inside, the mass flux per area
/// into the box.
struct SideFace {
  int axis;
  std::ptrdiff_t ghost, cell;
  double inflow;
};

/// The four sides. By itself one without gradient: air passes as it moves just inside, the pressure free.
class SideBoundary {
 public:
  virtual ~SideBoundary() = default;

  virtual End pressure_end() const { return End::zero_gradient; }
  /// Ghost over cell, of the velocity across the side and of the pressure correction.
  virtual double mirror() const { return 1; }
  virtual float correction_mirror() const { return 1; }
  /// Ghosts where they are not those of mirror(): of a quantity that the stream has with the value `stream`.
  virtual void transported(const Discretisation&, const Fields&, int /*k*/, int /*normal*/, double /*stream*/,
                           Array<double>& /*q*/) const {}
  virtual void pressure(const Discretisation&, Fields&, int /*k*/) const {}
  /// Of the faces of row (j, k) in the sides, for the pressure correction.
  virtual void conductances(const Discretisation&, const Fields&, const Array<double>& /*rc*/, int /*j*/,
                            int /*k*/, MultigridLevel&) const {}
};
std::unique_ptr<SideBoundary> open_sides();
std::unique_ptr<SideBoundary> slip_sides();
std::unique_ptr<SideBoundary> entraining_sides();

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
};
Inlet make_inlet(const Discretisation& d, const std::optional<Jet>& jet);
std::unique_ptr<SideBoundary> make_sides(Sides kind);
std::unique_ptr<OutletBoundary> make_outlet(Outlet kind);

/// visit(SideFace) for the faces of plane k in the sides.
template <class Visit>
void each_side_face(const Discretisation& d, const Fields& f, int k, Visit&& visit) {
  const Layout& layout = d.layout;
  const std::ptrdiff_t sy = layout.stride_y;
  for (int j = 0; j < layout.ny; ++j) {
    const std::ptrdiff_t low = layout.at(0, j, k), high = layout.at(layout.nx - 1, j, k);
    visit(SideFace{0, low - 1, low, f.fx[low]});
    visit(SideFace{0, high + 1, high, -f.fx[high + 1]});
  }
  for (int i = 0; i < layout.nx; ++i) {
    const std::ptrdiff_t low = layout.at(i, 0, k), high = layout.at(i, layout.ny - 1, k);
    visit(SideFace{1, low - sy, low, f.fy[low]});
    visit(SideFace{1, high + sy, high, -f.fy[high + sy]});
  }
}

/// Ghosts of plane k, inlet and outlet included where the plane is the first or the last one.
void velocity_ghosts(const Discretisation& d, const Boundaries& b, State& s, int k);
void turbulence_ghosts(const Discretisation& d, const Boundaries& b, State& s, int k);
void pressure_ghosts(const Discretisation& d, const Boundaries& b, State& s, int k);
/// Of the momentum equation's H/A and of a coefficient, at the sides only.
void side_ghosts(const Discretisation& d, Array<double>& q, int k, double across_x, double across_y);
/// The correction has the pressure's ghosts while velocities are corrected; the solver wants zeros there.
void correction_ghosts(const Discretisation& d, const Boundaries& b, Array<float>& e, int k);

/// Momentum along z that the air brings through the sides [N].
double momentum_through_sides(const Discretisation& d, const State& s);
/// Momentum along z that the air brings through the faces of the box, pressure and diffusion included: the
/// force on whatever is inside [N].
double momentum_deficit(const Discretisation& d, const Boundaries& b, const State& s);

}  // namespace ripstop::cartesian
