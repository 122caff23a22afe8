// A case: the user's input for one run, in a case file or in code. One struct for each TOML table.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/canopy/margins.h"
#include "ripstop/case/bodies.h"
#include "ripstop/case/cluster.h"
#include "ripstop/core/toml/problem.h"
#include "ripstop/core/toml/set.h"
#include "ripstop/core/vec3.h"
#include "ripstop/flow/engines.h"
#include "ripstop/flow/flow.h"
#include "ripstop/flow/jet.h"
#include "ripstop/fsi/coupling_settings.h"
#include "ripstop/fsi/flight_settings.h"
#include "ripstop/fsi/inflation_settings.h"
#include "ripstop/material/library.h"
#include "ripstop/material/material.h"
#include "ripstop/parachute/design.h"

namespace ripstop::inline cases {

enum class SpeedBasis { nominal, measured };
enum class Convection { upwind, second_order };
/// Cells whose faces represent the cloth, or that are fitted to it.
enum class FlowMesh { grid, fitted };
/// Part of the box in which a steady flow is solved.
enum class FlowSymmetry { automatic, full, quarter };

/// [flow.watch]: how long an unsteady flow is watched. Lengths are in times
/// that the stream takes for one inflated diameter.
struct WatchKeys {
  double courant = 0.7;
  double standard_error = 0.01;  // of the mean drag, relative
  double shortest = 25, longest = 300;
  SmallEddies eddies = SmallEddies::des;

  bool operator==(const WatchKeys&) const = default;
};

/// The keys of [flow] whose defaults follow from nothing.
struct FlowOptions {
  std::string engine = engines().front().word;
  SpeedBasis speed_basis = SpeedBasis::nominal;
  double turbulence_intensity = 0.005;
  double viscosity_ratio = 10;
  double angle_of_attack_deg = 0, azimuth_deg = 0;  // of the stream, see wind_direction()
  FlowSymmetry symmetry = FlowSymmetry::automatic;
  FlowMesh mesh = FlowMesh::grid;
  int cloth_levels = 0;  // fitted: times that the cells at the cloth are halved
  int ranks = 1;
  double time_limit_s = 0;  // of one flow solution; 0: none
  bool unsteady = false;    // watched in time once the steady loop has ended
  WatchKeys watch;

  bool operator==(const FlowOptions&) const = default;
};

/// [flow.core] as given: the part of the flow domain with uniform cells; outside of it the cells grow.
struct CoreKeys {
  std::optional<Vec3> size_m;     // 0: the cells are uniform along that axis
  std::optional<double> start_m;  // from the inlet
  std::optional<double> growth;   // of a cell's width to that of its inner neighbour, at most
  std::optional<double>
      off_axis;  // of its middle from the canopy's axis along x, half as much along y, in cells
};

/// Source of the air: the free stream, a nozzle into still air, or a closed test section.
enum class TunnelKind { free_air, open_jet, closed };

/// [flow.tunnel] as given.
struct TunnelKeys {
  TunnelKind kind = TunnelKind::free_air;
  std::optional<NozzleShape> shape;
  std::optional<double> width_m, height_m;
  std::optional<double> nozzle_distance_m;     // nozzle to the skirt of the start shape
  std::optional<double> collector_distance_m;  // from the nozzle; absent: the box ends where it would anyway
  std::optional<double> outside_speed;         // over the nozzle's
  std::optional<double> shear_layer_m;
  std::optional<double> displacement_thickness_m;  // of each wall's boundary layer
};

inline constexpr double fastest_stream = 100;  // below Mach 0.3, the limit of the flow model [m/s]

/// [flow] as given. Absent values follow from parachute, cloth and the other keys: settings.h.
struct FlowKeys : FlowOptions {
  std::optional<double> speed_m_s;  // absent: [payload] gives the mass to be carried
  std::optional<double> height_m;   // above sea level, for density, temperature and viscosity
  std::optional<double> density_kg_m3, temperature_k, viscosity_pa_s;
  std::optional<PorosityModel> porosity_model;
  std::optional<Vec3> box_m;
  std::optional<std::array<int, 3>> cells;
  CoreKeys core;
  TunnelKeys tunnel;
  std::optional<double> canopy_position_m;  // inlet to the skirt of the start shape
  std::optional<Convection> convection;
  std::optional<Sides> sides;
  std::optional<Outlet> outlet;
  std::optional<double> residual;
  std::optional<int> max_iterations;
  std::optional<int> average_over;  // last iterations of a flow that does not settle; 0: none
};

/// [coupling] as given.
struct CouplingKeys : CouplingOptions {
  std::optional<CanopyLoad> load;
  std::optional<double> drag_tolerance, shape_tolerance_m;
};

/// [payload] as given.
struct PayloadKeys {
  std::optional<double> mass_kg;  // below the parachute; a steady run finds the speed at which drag is weight
  std::optional<double> deployment_speed_m_s;  // airspeed at line stretch
  double drag_area_m2 = 0;                     // C_D S of the payload in the undisturbed stream
};

/// [deployment] as given.
struct DeploymentKeys {
  enum class Order { lines_first, canopy_first } order = Order::lines_first;
  enum class Container { bag, wrap } container = Container::bag;
  std::optional<double> mass_kg, drag_area_m2, length_m;  // of the container, without the pilot chute
  std::optional<double> strip_force_n, line_force_n;
  std::optional<double> pilot_drag_area_m2, pilot_mass_kg;
  std::optional<double> relative_speed_m_s, ejection_impulse_n_s;
};

/// [[measured]]: one wind-tunnel condition.
struct Measured {
  double nominal_speed_m_s = 0;
  double measured_speed_m_s = 0;
  double density_kg_m3 = 0;
  std::optional<double> drag_n;               // absent: withheld or not measured
  std::optional<double> printed_nonlinear_n;  // drag that the source's nonlinear model gives
  std::optional<double> printed_linear_n;
};

/// The user's input: an absent value was not given and follows from the others (settings.h).
struct Case {
  std::string title;
  Design parachute;
  std::map<std::string, Material>
      materials;  // by name; other materials that the parachute names are those of the library
  FlowKeys flow;
  std::map<std::string, BodyKeys> bodies;  // by name
  std::optional<ClusterKeys> cluster;      // absent: one canopy
  CouplingKeys coupling;
  InflationSettings inflation;
  std::optional<DeploymentKeys> deployment;
  PayloadKeys payload;
  FlightSettings flight;
  MarginFactors margins;
  HardwareParts hardware;
  std::vector<Measured> measured;

  std::filesystem::path file;             // where it was read from; empty: not from a file
  Origins origins;                        // of every key that was given, for messages
  std::vector<std::string> deprecations;  // one for each key that was given by an old name, for people
};

void describe(Fields& fields, CoreKeys& core);
void describe(Fields& fields, WatchKeys& watch);
void describe(Fields& fields, TunnelKeys& tunnel);
void describe(Fields& fields, FlowKeys& flow);
void describe(Fields& fields, CouplingKeys& coupling);
void describe(Fields& fields, ReefingStage& stage);
void describe(Fields& fields, InflationSettings& inflation);
void describe(Fields& fields, DeploymentKeys& deployment);
void describe(Fields& fields, PayloadKeys& payload);
void describe(Fields& fields, Wind& wind);
void describe(Fields& fields, FlightSettings& flight);
void describe(Fields& fields, MarginFactors& margins);
void describe(Fields& fields, Hardware& part);
void describe(Fields& fields, Measured& measured);
void describe(Fields& fields, Case& given);

/// Changes of a case by the command line.
struct Overrides {
  std::optional<double> speed = {};             // --speed [m/s]
  std::optional<std::array<int, 3>> grid = {};  // --grid nx ny nz
  std::optional<int> ranks = {};                // --ranks
  std::optional<std::string> engine = {};       // --flow
  bool linear = false;                          // --linear
  /// --pressure of an opening [Pa], in place of the pressure or the drag coefficient that the case gives
  std::optional<double> pressure = {};
  /// --set: any key, in place of the value of the file; a material of the library is copied into the case
  /// first. Only for read_case() and parse_case().
  std::vector<Setting> set = {};
};

/// Everything that is wrong with a case, from a file or made in code. Throws InputError(bad_data) for a
/// broken library material.
std::vector<Problem> validate(const Case& given);
/// The case with every material that its parachute names, from the library where the case has it not, and the
/// library's tapes where it names none. Throws InputError(usage) with all problems of validate() in addition to those
/// that are `known` already.
Case checked(Case given, std::vector<Problem> known = {});

/// Reads and checks. Throws as checked(), and Error(io) when the file cannot be read.
Case read_case(const std::filesystem::path& file, const Overrides& overrides = {});
/// Reads a case from text; `name` is the name of the file in messages.
Case parse_case(const std::string& text, const std::string& name, const Overrides& overrides = {});
/// Changes a case under the same rules. Throws InputError(usage) and leaves `given` unchanged.
void apply(const Overrides& overrides, Case& given);

/// JSON Schema (draft 2020-12) of a case file, and the reference of its keys in Markdown.
std::string case_schema();
std::string case_reference();

/// The row of [[measured]] for the case's nominal speed; null when there is none.
const Measured* measured_row(const Case& given);

struct Air {
  double speed = 0;    // free stream, after speed_basis [m/s]
  double density = 0;  // [kg/m3]
};
/// Of a case with a payload and no speed, the speed is payload_first_speed(): where its search begins.
Air air(const Case& given);

/// The materials of the parachute's parts, looked up by the names in the design.
const Fabric& canopy_fabric(const Case& given);
const Line& suspension_line(const Case& given);
const Line& riser_line(const Case& given);
const Line& reefing_line(const Case& given, const ReefingStage& stage);
/// Null where the parachute has none.
const Tape* reinforcement_tape(const Case& given);

}  // namespace ripstop::inline cases
