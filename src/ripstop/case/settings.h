// The settings of a case: the complete input of a run, computed once by resolve() when the case is read. Solvers, run
// folders and reports take Settings; only code that reads, makes or changes a case uses the Case itself.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/case.h"
#include "ripstop/parachute/build.h"

namespace ripstop::inline cases {

struct CoreSettings {
  Vec3 size_m;         // 0: the cells are uniform along that axis
  double start_m = 0;  // from the inlet
  double growth = 0;
  double off_axis = 0;  // of its middle from the canopy's axis along x, half as much along y, in cells

  bool operator==(const CoreSettings&) const = default;
};

struct TunnelSettings {
  TunnelKind kind = TunnelKind::free_air;
  Nozzle nozzle;  // or closed test section
  double nozzle_distance_m = 0;
  double outside_speed = 0;
  double shear_layer_m = 0;
  double displacement_thickness_m = 0;

  bool operator==(const TunnelSettings&) const = default;
};
/// Nothing where there is no nozzle.
std::optional<Jet> jet_of(const TunnelSettings& tunnel);

/// FlowKeys with every value.
struct FlowSettings : FlowOptions {
  double speed_m_s = 0;            // of the free stream; with a payload, where the search for it begins
  double nominal_speed_m_s = 0;    // that names the condition: as given, before speed_basis
  std::optional<double> height_m;  // above sea level, where the case gives one
  double viscosity_pa_s = 0;
  double temperature_k = 0;
  double density_kg_m3 = 0;
  PorosityModel porosity_model = PorosityModel::sheet;
  Vec3 box_m;
  std::array<int, 3> cells{};
  TunnelSettings tunnel;
  CoreSettings core;
  double canopy_position_m = 0;
  Convection convection = Convection::upwind;
  Sides sides = Sides::zero_gradient;
  Outlet outlet = Outlet::fixed_pressure;
  double residual = 0;
  int max_iterations = 0;
  int average_over = 0;

  bool operator==(const FlowSettings&) const = default;
};

/// One key whose value follows from others where it is not given.
struct Source {
  std::string key;
  std::string unit;  // "m/s"; empty: a plain number, a word or a name
  bool given = false;
  std::string from;  // "the sheet's default", "given in case.toml, line 12"
};

/// Settings that follow from the keys of a case alone, without its materials.
struct SettingsValues {
  FlowSettings flow;
  CouplingSettings coupling;
  Case written;  // the case with all of these values given
  std::vector<Source> sources;
};

/// A case with every value, which nothing changes any more. Only resolve() makes one.
class Settings {
 public:
  const std::string& title() const { return values_.written.title; }
  const std::filesystem::path& file() const {
    return values_.written.file;
  }  // empty: the case is not from a file
  const Design& parachute() const { return values_.written.parachute; }
  const PartMaterials& materials() const { return materials_; }
  /// The line of each stage of inflation().reefing.
  const std::vector<Line>& reefing_lines() const { return reefing_lines_; }
  const FlowSettings& flow() const { return values_.flow; }
  const CouplingSettings& coupling() const { return values_.coupling; }
  const InflationSettings& inflation() const { return values_.written.inflation; }
  /// Of a coupled opening; absent: the folded canopy starts stretched out.
  const std::optional<DeploymentKeys>& deployment() const { return values_.written.deployment; }
  const PayloadKeys& payload() const { return values_.written.payload; }
  const FlightSettings& flight() const { return values_.written.flight; }
  const HardwareParts& hardware() const { return values_.written.hardware; }
  const MarginFactors& margins() const { return values_.written.margins; }
  const std::vector<Measured>& measured() const { return values_.written.measured; }
  /// The row of [[measured]] for the nominal speed.
  const std::optional<Measured>& measured_row() const { return measured_row_; }

  /// The case with every value written out: it runs without the library, and has the same settings.
  const Case& written() const { return values_.written; }
  /// One for each key that was given by an old name.
  const std::vector<std::string>& deprecations() const { return values_.written.deprecations; }
  /// Of every value that follows from others where it is not given.
  const std::vector<Source>& sources() const { return values_.sources; }
  /// Of one of these keys; throws std::out_of_range for another.
  const Source& source(const std::string& key) const;

 private:
  Settings(SettingsValues values, PartMaterials materials, std::vector<Line> reefing_lines);
  friend Settings resolve(const Case& given);

  SettingsValues values_;
  PartMaterials materials_;
  std::vector<Line> reefing_lines_;
  std::optional<Measured> measured_row_;
};

/// Pure. Throws Error(usage) for a case without air or without its materials: one that checked() would refuse.
Settings resolve(const Case& given);
/// The same settings at another speed, which is the nominal one too [m/s].
Settings at_speed(const Settings& resolved, double speed_m_s);
/// The same settings, with the whole domain where flow.symmetry is "auto": for flows that continue in time or at an
/// angle.
Settings in_full_domain(const Settings& resolved);

/// The same settings at another spread angle of the cluster, in the same domain [deg].
Settings at_spread_angle(const Settings& resolved, double spread_angle_deg);

/// Length unit of the domain of the sheet model [m].
double inflated_diameter(const Design& parachute);
/// Cells of the flow. Throws Error(usage) for a core that does not fit, or that the cells do not suffice for.
FlowGrid flow_grid(const FlowSettings& flow);
/// Those across the inflated canopy, of a cluster across the smallest one.
double cells_across(const Settings& resolved);
/// Whether the field of one flow can start the other: both are solved alike on the same cells. The position of the
/// canopy and the averaging window may differ, and the air too if the engine can scale its field.
bool same_flow(const FlowSettings& a, const FlowSettings& b);

/// The settings as text that reads back to the same settings.
std::string case_toml(const Settings& resolved);
std::string case_json(const Settings& resolved);

}  // namespace ripstop::inline cases
