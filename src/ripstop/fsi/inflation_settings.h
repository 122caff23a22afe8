// [inflation] of a case file.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ripstop::inline fsi {

/// Load model: uniform pressure with damping, or coupled flow.
enum class AirModel { uniform, coupled };

/// [[inflation.reefing]]: one stage, whose line constrains the skirt until it is cut.
struct ReefingStage {
  double line_m = 0;                    // once round through the rings, unloaded
  double cut_s = 0;                     // from deployment
  std::optional<std::string> material;  // absent: the suspension lines'
};

struct InflationSettings {
  AirModel air = AirModel::uniform;
  double courant = 0.5;  // of the air's steps, `coupled`
  /// The riser's end is held in the stream, or is the payload that flies.
  enum class Mass { infinite, payload } mass = Mass::infinite;
  double flight_angle_deg = 90;  // of its path at deployment, below the horizon

  std::optional<double> initial_radius_m;  // of the folded skirt, midway between inner and outer folds
  int folds = 0;                           // 0: one a line
  double slack_m = 0;                      // lines longer than their way from confluence to skirt

  std::vector<ReefingStage> reefing;  // in the order of their cuts, each longer than the one before

  std::optional<double> pressure_pa;       // dp over the canopy
  std::optional<double> drag_coefficient;  // on S0: dp such that the steady drag is C_D S0 q
  enum class Basis { axial, descent } drag_coefficient_basis = Basis::axial;
  double ramp_s = 0;  // dp rises in proportion to time until then

  double damping_n_s_m3 = 8.2;  // C_a a unit area of cloth, [NFM] Eq. 20
  double quadratic_damping_n_s2_m4 = 0;
  double line_damping_s = 1e-6;  // of lines and tape: C = this times K_1 (w) / L0 of every spring
  /// Of the cloth, likewise; less in cells where it would set the step. Absent: none; opening_case() has the default.
  std::optional<double> cloth_damping_s = {};

  double cloth_damping_step_share = 0.97;  // of the stable step without it, that the cloth's damping leaves

  // The folded start is moved outward by imperfection_m cos(harmonic azimuth) at its outer folds, in
  // proportion to the radius inside.
  double imperfection_m = 0;
  int imperfection_harmonic = 1;
  int imperfection_seed = 0;  // above 0: waves of every harmonic up to 8 at random azimuths, in its place

  std::optional<double> line_segment_m;  // of the opening's mesh, in place of [parachute.mesh]'s

  double contact_pa = 20e3;  // that would press two layers of cloth into one; 0: they pass through each other
  double contact_friction = 0.2;

  std::optional<double> cloth_compression;  // of cloth and tape, in place of wrinkles

  double duration_s = 0.5;
  double history_hz = 5000;  // rows of the history a second, at least
  double low_pass_hz = 0;    // of the written history only; 0: none
  int frames = 200;
  std::vector<double> sheet_s = {};  // shapes on the contact sheet; none: eight, as Opening chooses
  double step_fraction = 0.9;        // of the largest stable step

  std::optional<double> measured_peak_n;
  std::optional<double> measured_inflation_time_s;
  std::optional<double> printed_peak_n;  // that the source's model gives
};

}  // namespace ripstop::inline fsi
