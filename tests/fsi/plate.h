// A rigid porous square plate that carries a payload by stiff struts.
#pragma once

#include <cmath>

#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/flow_grid.h"
#include "ripstop/fsi/free_flight.h"

namespace ripstop::plate_flight {

inline constexpr double side = 0.5, below = 0.6,
                        height = 1.2;  // of the plate, of the payload below it, of the plate in the box [m]
inline constexpr double areal_mass = 0.2, payload = 0.5, gravity = 9.81;
inline constexpr double linear = 40;  // pressure drop [Pa s/m]

/// A square of n x n nodes across z; each is tied to the payload by a spring that carries compression too, so that
/// the whole moves as one rigid body.
inline CanopyMesh plate(double payload_below = below) {
  constexpr int n = 7;
  constexpr double spacing = side / (n - 1), stiffness = 2e4;
  CanopyMesh mesh;
  Patch patch;
  patch.rows = patch.columns = n;
  patch.cell_area.assign(n * n, 0.0);
  for (int d = 0; d < direction_count; ++d) {
    patch.law[d].coefficients = {stiffness};
    const double length = d == along_row || d == along_column ? 1 : d <= shear_down ? std::sqrt(2.0) : 2;
    patch.rest_length[d].assign(n * n, spacing * length), patch.width[d].assign(n * n, 0.0);
  }
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      mesh.start.push_back({c * spacing - 0.5 * side, r * spacing - 0.5 * side, height});
      mesh.mass.push_back(areal_mass * (r % (n - 1) ? 1 : 0.5) * (c % (n - 1) ? 1 : 0.5) * spacing * spacing);
      if (r < n - 1 && c < n - 1) patch.cell_area[r * n + c] = spacing * spacing;
      if (c < n - 1) patch.width[along_row][r * n + c] = spacing;
      if (r < n - 1) patch.width[along_column][r * n + c] = spacing;
      if (r < n - 1 && c < n - 1) patch.width[shear_up][r * n + c] = spacing;
      if (r < n - 1 && c > 0) patch.width[shear_down][r * n + c] = spacing;
    }
  mesh.fabric_names = {"plate"};
  patch.name = "plate";
  mesh.patches.push_back(patch);
  mesh.start.push_back({0, 0, height - payload_below}), mesh.mass.push_back(1e-3);
  mesh.fixed = {n * n};
  mesh.laws.emplace_back().coefficients = {stiffness};
  mesh.parts = {"strut"};
  for (int i = 0; i < n * n; ++i) {
    Spring strut;
    strut.a = n * n, strut.b = i, strut.rest_length = norm(mesh.start[i] - mesh.start[n * n]);
    mesh.springs.push_back(strut);
  }
  mesh.rigging.confluence = n * n;
  mesh.rigging.skirt_nodes = {0, n - 1, n * n - 1, n * (n - 1)};
  return mesh;
}

inline FlowProblem air(double speed, double linear_drop) {
  FlowProblem flow;
  flow.grid = graded({{-1.5, -1.5, 0}, {3, 3, 3.2}, 24, 24, 28}, {-0.4, -0.4, 0.9}, {0.4, 0.4, 1.6}, 1.3);
  flow.air.velocity = {0, 0, speed};
  flow.sides = Sides::far_field;
  flow.bodies = {sheet_body({}, {linear_drop, 0})};
  return flow;
}

inline FlightProblem problem(double speed, double linear_drop) {
  FlightProblem flight;
  flight.mesh = plate();
  flight.shape = flight.mesh.start;
  CartesianSettings settings;
  settings.threads = 1, settings.compressible = false;
  flight.air = {air(speed, linear_drop), 0.5, make_cartesian(settings)};
  flight.settings.angle_deg = 0;
  flight.cloth.contact_pa = 0;
  flight.payload_mass = payload;
  flight.gravity = gravity;
  flight.threads = 1;
  return flight;
}

}  // namespace ripstop::plate_flight
