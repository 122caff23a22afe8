// Data of a flow between iterations, complete: each_carried() is the one list, used for saving.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ripstop/core/vec3.h"
#include "ripstop/flow/cartesian/grid.h"
#include "ripstop/flow/cartesian/views.h"
#include "ripstop/flow/flow.h"

namespace ripstop::inline flow::cartesian {

struct Discretisation;

struct Fields {
  Array<double> u, v, w;     // [m/s]
  Array<double> p;           // over the outlet's [Pa]
  Array<double> rho;         // [kg/m3]
  Array<double> k, omega;    // [m2/s2], [1/s]
  Array<double> fx, fy, fz;  // mass flux per area through the low faces [kg/(m2 s)]

  VectorView<const double> velocity(std::ptrdiff_t at) const { return row_of(u, v, w, at); }
  VectorView<double> velocity(std::ptrdiff_t at) { return row_of(u, v, w, at); }
  VectorView<const double> flux(std::ptrdiff_t at) const { return row_of(fx, fy, fz, at); }
  VectorView<double> flux(std::ptrdiff_t at) { return row_of(fx, fy, fz, at); }
};

/// Means over the box, which residuals are measured against.
struct Means {
  double u = 0, v = 0, w = 0, p = 0, k = 0, omega = 0;
};

/// Of the march in time; steps are counted from its beginning.
struct Clock {
  std::int64_t steps = 0;
  double time = 0, step = 0;  // since the beginning, and the last one [s]
  double courant_rate = 0;    // largest sum over the axes of |u| / width, in the present fields [1/s]
  std::int64_t changing = 0;  // 1: the velocity far away is not the problem's, but this one
  Vec3 stream;                // [m/s]
  Vec3 gaining;               // by which it changes [m/s2]
  Vec3 pulled;                // by the rate of the last step [m/s2]
  Vec3 brought;               // momentum that the air brought through the box's faces, last rate [N]
};

struct State {
  explicit State(const Layout& layout);

  Fields f;
  Array<double> limit;         // factor of the eddy viscosity next to sheets, else 1
  Array<double> outlet_p;      // pressure in the outlet's faces, one plane [Pa]
  Array<double> face_p;        // of a far field on all six faces, at the ghosts [Pa]; else empty
  std::vector<double> held;    // jump on a face of a sheet that balances the pressure [Pa], see SheetRows
  std::vector<double> change;  // and by how much it differs after the last iteration [Pa]
  std::vector<double> drop;    // of the pressure across the cloth on each such face [Pa]
  Vec3 force;                  // on porous cells and sheets [N]
  Means mean;
  int iteration = 0;                     // since the start
  int eased = 0;                         // iterations yet to come that take half steps
  bool untouched = true;                 // still the uniform stream
  Array<double> rate_u, rate_v, rate_w;  // of momentum, by the last step in time [N/m3]; empty: none yet
  Array<float> correction;               // of the pressure, by the last step in time [Pa]; empty: none yet
  Clock clock;
};

/// visit(array of double) and visit(number) for everything in a State.
template <class AnyState, class Visit>
void each_carried(AnyState& s, Visit&& visit) {
  auto& f = s.f;
  for (auto* field :
       {&f.u, &f.v, &f.w, &f.p, &f.rho, &f.k, &f.omega, &f.fx, &f.fy, &f.fz, &s.limit, &s.outlet_p})
    visit(*field);
  visit(s.face_p), visit(s.held), visit(s.change), visit(s.drop), visit(s.force);
  visit(s.mean), visit(s.iteration), visit(s.eased), visit(s.untouched);
  visit(s.rate_u), visit(s.rate_v), visit(s.rate_w), visit(s.correction), visit(s.clock);
}

/// The next step in time is a first one.
void stop_the_clock(State& state);

/// Whether every array of the one is as long as that of the other.
bool fits(const State& a, const State& b);

/// The fields of one box on another grid of it, scaled from its air to the other's. Ghosts are left alone;
/// limit, outlet and jumps too.
void interpolate(const State& from, const Discretisation& of, State& to, const Discretisation& on, int rank,
                 int ranks);

/// The same grid, other air: everything is multiplied by its scale.
void scale(State& state, const Freestream& from, const Freestream& to);

}  // namespace ripstop::inline flow::cartesian
