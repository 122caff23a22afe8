// A parachute with its payload in free flight, stepped in time together with the air.
//
// The box of the flow translates with the canopy, V_b(t), and does not rotate. In it the undisturbed air has the
// velocity W - V_b, all air the body force of its acceleration, cloth, lines and payload the force m (g - dV_b/dt).
// The payload is a point mass at the end of the riser, or at the confluence: a node of the cloth.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/flow/extent.h"
#include "ripstop/fsi/carried_bodies.h"
#include "ripstop/fsi/cluster_motion.h"
#include "ripstop/fsi/coupled_step.h"
#include "ripstop/fsi/flight_record.h"
#include "ripstop/fsi/flight_settings.h"
#include "ripstop/fsi/inflation_settings.h"
#include "ripstop/fsi/opening_end.h"
#include "ripstop/parachute/canopy_mesh.h"

namespace ripstop::inline fsi {

struct FlightProblem {
  CanopyMesh mesh;                    // as cut; its fixed node becomes the payload
  std::vector<Vec3> shape;            // at the start, its axis along z in the box [m]
  std::vector<double> pressure = {};  // on its cells [Pa]; empty: none
  /// air.flow.air.velocity: along z, the rate of descent at the start. Rigid bodies are where they are at that shape.
  AirProblem air;
  FlightSettings settings;
  InflationSettings cloth;       // damping, contact and step of the cloth
  double payload_mass = 0;       // [kg]
  double payload_drag_area = 0;  // C_D S [m2]
  double gravity = 0;            // [m/s2]
  /// Density so many metres below the start over that there; empty: 1.
  std::function<double(double)> density_ratio = {};
  /// The flight continues from there: `mesh` has the creases of its folds, `air` is its flow, `shape` and `pressure`
  /// are left empty, and time, height and distance are measured from deployment.
  std::optional<OpeningEnd> from = {};
  double descent_speed = 0;  // expected in the end, sets the longest step [m/s]; 0: that of air.flow
  bool linear = false;
  int threads = 0;
};

/// Directions of the axes of the box over the ground, z up.
struct BoxAxes {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  Vec3 over_ground(Vec3 in_box) const { return in_box.x * x + in_box.y * y + in_box.z * z; }
  Vec3 in_box(Vec3 over_ground) const {
    return {dot(over_ground, x), dot(over_ground, y), dot(over_ground, z)};
  }
};

class FreeFlight {
 public:
  /// Throws Error(usage) for a payload without mass, a mesh without exactly one fixed node, lines that pass through rigid
  /// bodies, and as CoupledFlow.
  explicit FreeFlight(FlightProblem problem);

  FreeFlightState start();
  /// One step of the flow. Throws Error(diverged), Error(not_converged) for a canopy that leaves its fine cells or a rigid
  /// body that leaves the box, and Error(usage) where the canopy touches a rigid body.
  FreeFlightRow advance(FreeFlightState& state);

  /// Energies in the box; the residual is relative to the potential energy lost so far.
  struct Balance {
    double energy_residual = 0, momentum_residual = 0;
  };
  Balance balance(const FreeFlightState& state, const FreeFlightRow& row) const;
  /// Why the flight is no flight any more: a canopy has collapsed, or the parachute has turned over. Empty: it flies.
  std::string failure(const FreeFlightState& state, const FreeFlightRow& row) const;
  /// Every canopy of a cluster at the present state.
  std::vector<CanopyRow> canopy_rows(const FreeFlightState& state) const;

  /// The rigid bodies at the present state.
  std::vector<Placement> bodies(const FreeFlightState& state) const;

  double began() const { return problem_.from ? problem_.from->time : 0; }  // since deployment [s]
  double mass() const { return mass_; }                                     // of parachute and payload [kg]
  int canopies() const { return mesh_.rigging.canopies; }
  const CanopyMesh& mesh() const { return mesh_; }
  const Cloth& cloth() const { return *cloth_; }
  const FlightProblem& problem() const { return problem_; }
  CoupledFlow& air() { return *air_; }
  int threads() const { return team_.size(); }

 private:
  Vec3 wind_in_box(Vec3 place, double time) const;
  double start_height() const;
  void continue_opening(FreeFlightState& state) const;
  void release(FreeFlightState& state) const;
  Surroundings surroundings(const FreeFlightState& state, double length) const;
  Vec3 box_acceleration(const FreeFlightState& state) const;
  std::vector<double> mouths(const std::vector<Vec3>& x) const {
    return mouth_areas(air_->cells(), x, canopies());
  }
  std::vector<double> open_shares(const std::vector<Vec3>& x) const;
  void check_cells(const std::vector<Vec3>& x, double time) const;
  CarriedBodies::Pose pose(const std::vector<Vec3>& x) const;
  std::vector<Placement> place_bodies(const FreeFlightState& state, double length) const;
  std::vector<FlightBodyRow> over_ground(std::vector<FlightBodyRow> rows, Vec3 box, double time) const;
  FreeFlightRow row_of(const FreeFlightState& state, const std::vector<Vec3>& x,
                       const std::vector<Vec3>& v) const;

  FlightProblem problem_;
  BoxAxes axes_;
  Vec3 gravity_;  // in the box [m/s2]
  ThreadTeam team_;
  CanopyMesh mesh_;  // with the payload's mass, without a fixed node
  int payload_ = -1;
  double mass_ = 0;
  std::vector<int> canopy_;  // nodes of patches
  Vec3 home_;                // of the canopy's centroid in the box [m]
  Extent fine_;              // cells of the flow
  CarriedBodies bodies_;
  double follow_ = 0;                // rate at which the box follows the canopy [1/s]
  double longest_step_ = 0;          // of the flow [s]
  std::vector<double> mouth_share_;  // of each canopy in the area of all mouths, as cut
  double row_ = 0;                   // of the cloth's history [s]
  ClothPtr cloth_;
  AdaptiveStepper stepper_;
  std::unique_ptr<CoupledFlow> air_;
};

}  // namespace ripstop::inline fsi
