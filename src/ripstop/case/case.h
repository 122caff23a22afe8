// A case: everything that one run needs to know, as read from a case file. One struct for each TOML table.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/core/toml/problem.h"
#include "ripstop/core/toml/set.h"
#include "ripstop/core/vec3.h"
#include "ripstop/coupling/settings.h"
#include "ripstop/flow/engines.h"
#include "ripstop/flow/flow.h"
#include "ripstop/inflation/settings.h"
#include "ripstop/material/library.h"
#include "ripstop/material/material.h"
#include "ripstop/parachute/design.h"

namespace ripstop {

enum class SpeedBasis { nominal, measured };
enum class Convection { upwind, second_order };

/// [flow.core], the part of the flow's box with uniform cells, outside of which they grow.
struct CoreSettings {
  Vec3 size_m;                    // 0: the cells are uniform along that axis
  std::optional<double> start_m;  // from the inlet; absent: a quarter of the core lies before the canopy
  double growth = 1.1;            // of a cell's width to that of its inner neighbour, at most
};

/// [flow]. With the `sheet` model settle_flow() puts other values where the case gives none.
struct FlowSettings {
  std::string engine = engines().front().word;
  double speed_m_s = 0;
  SpeedBasis speed_basis = SpeedBasis::nominal;
  std::optional<double> density_kg_m3;  // absent: from the row of [[measured]] with this nominal speed
  double viscosity_pa_s = 1.84e-5;
  double temperature_k = 293.15;
  double turbulence_intensity = 0.005;
  double viscosity_ratio = 10;
  Vec3 box_m{2, 2, 4};
  std::array<int, 3> cells{100, 100, 150};
  CoreSettings core;
  std::optional<double> canopy_position_m;  // inlet to the skirt of the start shape; absent: mid-length
  Convection convection = Convection::upwind;
  Sides sides = Sides::zero_gradient;
  Outlet outlet = Outlet::fixed_pressure;
  PorosityModel porosity_model = PorosityModel::of_cloth;  // never that in a case that was read
  double residual = 1e-5;
  int max_iterations = 1000;
  int average_over = 0;  // last iterations of a flow that does not settle; 0: none
  int ranks = 1;
  double time_limit_s = 0;  // of one flow solution; 0: none
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

struct Case {
  std::string title;
  Design parachute;
  /// Every material the parachute uses, by name: written in the case file, else from the library.
  std::map<std::string, Material> materials;
  FlowSettings flow;
  CouplingSettings coupling;
  InflationSettings inflation;
  std::vector<Measured> measured;

  std::filesystem::path file;  // where it was read from; empty: not from a file
  Origins origins;             // of every key that was given
};

void describe(Fields& fields, FlowSettings& flow);
void describe(Fields& fields, CouplingSettings& coupling);
void describe(Fields& fields, InflationSettings& inflation);
void describe(Fields& fields, Measured& measured);
void describe(Fields& fields, Case& value);

/// The porosity model of the canopy cloth where the case names none; with `sheet` a box of some diameters
/// about the canopy, cells that suit it, and numerics that settle there, for every key of [flow] that the
/// case does not give.
void settle_flow(Case& value);

/// What the command line may change about a case.
struct Overrides {
  std::optional<double> speed = {};             // --speed [m/s]
  std::optional<std::array<int, 3>> grid = {};  // --grid nx ny nz
  std::optional<int> ranks = {};                // --ranks
  std::optional<std::string> engine = {};       // --flow
  bool linear = false;                          // --linear
  /// --set: any key, over what the file says; a material of the library is copied into the case first. Only
  /// for read_case() and parse_case().
  std::vector<Setting> set = {};
};

/// Throws InputError(usage) with every problem found, InputError(bad_data) for a broken library material,
/// Error(io) when the file cannot be read.
Case read_case(const std::filesystem::path& file, const Overrides& overrides = {});
/// The same from text; `name` stands for the file in messages.
Case parse_case(const std::string& text, const std::string& name, const Overrides& overrides = {});
/// Changes an already read case under the same rules. Throws InputError(usage) and leaves `value` unchanged.
void apply(const Overrides& overrides, Case& value);

/// The same case with every optional number filled in by what stands for it when absent.
Case resolved(const Case& value);
/// The resolved case, materials included, so that it runs without the library. Reading it gives the same
/// case.
std::string case_toml(const Case& value);
std::string case_json(const Case& value);
/// JSON Schema (draft 2020-12) of a case file, and the reference of its keys in Markdown.
std::string case_schema();
std::string case_reference();

/// The row of [[measured]] for the case's nominal speed; null when there is none.
const Measured* measured_row(const Case& value);

struct Air {
  double speed = 0;    // free stream, after speed_basis [m/s]
  double density = 0;  // [kg/m3]
};
Air air(const Case& value);

/// z of the skirt of the undeformed start shape, from the inlet [m].
double canopy_position(const Case& value);
/// Cells of the flow. Throws Error(usage) for a core that does not fit, or that the cells do not suffice for.
FlowGrid flow_grid(const Case& value);

/// The materials of the parachute's parts, looked up by the names in the design.
const Fabric& canopy_fabric(const Case& value);
const Line& suspension_line(const Case& value);
const Line& riser_line(const Case& value);
const Tape& reinforcement_tape(const Case& value);

}  // namespace ripstop
