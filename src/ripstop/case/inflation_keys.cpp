// The keys of [inflation].
#include "ripstop/case/case.h"
#include "ripstop/core/toml/fields.h"

namespace ripstop::inline cases {
namespace {

/// The folded start.
void describe_start(Fields& fields, InflationSettings& inflation) {
  fields
      .number("initial_radius_m", inflation.initial_radius_m, above(0).up_to(1000),
              "Radius of the folded skirt, midway between its inner and outer folds.")
      .absent(
          "a closed mouth: 4 to 10 % of the nominal diameter by type of canopy, or more where the folds need "
          "it");
  fields.integer("folds", inflation.folds, from(0).up_to(1000),
                 "Number of outer folds around the canopy, equal to the number of inner folds; 0: with a "
                 "closed mouth (no initial_radius_m) the smallest multiple of the number of lines with which "
                 "the mouth closes, for example 36 for 12 lines; with initial_radius_m one per line; 4 for a "
                 "cross.");
  fields.number("slack_m", inflation.slack_m, from(0).up_to(1000),
                "Slack: length of the lines beyond the distance from the confluence to the skirt.");
}

/// Load model.
void describe_air(Fields& fields, InflationSettings& inflation) {
  fields.choice("air", inflation.air, {{"uniform", AirModel::uniform}, {"coupled", AirModel::coupled}},
                "Load model. \"uniform\": one pressure difference with absolute damping; \"coupled\": flow "
                "of [flow], computed in time together with the cloth, without a given pressure or C_a.");
  fields.number("courant", inflation.courant, above(0).up_to(1),
                "Largest Courant number of the flow steps, with air = \"coupled\".");
  fields.choice(
      "mass", inflation.mass,
      {{"infinite", InflationSettings::Mass::infinite}, {"payload", InflationSettings::Mass::payload}},
      "Coupled inflation: \"infinite\" keeps the end of the riser fixed in the stream, as in a tunnel; "
      "\"payload\" attaches payload.mass_kg, which the opening decelerates.");
  fields.number(
      "flight_angle_deg", inflation.flight_angle_deg, from(-90).up_to(90),
      "Angle of the flight path below the horizon at deployment, 90: vertical. Gravity turns the path.");
}

/// The pressure over the canopy.
void describe_pressure(Fields& fields, InflationSettings& inflation) {
  fields
      .number("pressure_pa", inflation.pressure_pa, above(0).up_to(1e6),
              "Uniform pressure difference over the canopy.")
      .absent("from drag_coefficient, or from a steady run given on the command line");
  fields
      .number("drag_coefficient", inflation.drag_coefficient, above(0).up_to(5),
              "Drag coefficient on S0. It determines the pressure for which the steady drag is C_D S0 q at "
              "the speed of [flow].")
      .absent("from pressure_pa, or from a steady run given on the command line");
  fields.choice("drag_coefficient_basis", inflation.drag_coefficient_basis,
                {{"axial", InflationSettings::Basis::axial}, {"descent", InflationSettings::Basis::descent}},
                "Motion in which drag_coefficient was found: \"axial\" in steady flow along the axis, "
                "\"descent\" in free descent, as in handbooks and catalogues. `ripstop recovery` widens the "
                "range of an axial coefficient by the ratio of the descent coefficient to the axial one in "
                "computed flights.");
  fields.number("ramp_s", inflation.ramp_s, from(0).up_to(1000),
                "Time of the linear rise of the pressure; 0: immediate.");
}

/// The damping.
void describe_damping(Fields& fields, InflationSettings& inflation) {
  fields.number("damping_n_s_m3", inflation.damping_n_s_m3, from(0).up_to(1e5),
                "Absolute damping C_a of the cloth per unit area ([NFM] Eq. 20, corrected).");
  fields.number("quadratic_damping_n_s2_m4", inflation.quadratic_damping_n_s2_m4, from(0).up_to(1e5),
                "Quadratic absolute damping per unit area, proportional to the square of the speed.");
  fields.number("line_damping_s", inflation.line_damping_s, from(0).up_to(1e-3),
                "Relative damping of lines and tape as a time: C = line_damping_s K_1 w / L0 with the tape "
                "width w, or w = 1 for lines (assumed).");
  fields
      .number("cloth_damping_s", inflation.cloth_damping_s, from(0).up_to(1e-3),
              "Relative damping of the cloth springs as a time: C = cloth_damping_s K_1 w / L0 with the "
              "spring width w.")
      .absent("1e-5 in coupled inflation, 0 in other computations");
  fields.number("cloth_damping_step_share", inflation.cloth_damping_step_share, from(0.05).up_to(0.999),
                "Smallest ratio of the stability limits with and without damping of the cloth. Where the "
                "ratio would be smaller, the damping of the cell is reduced.");
}

/// Differences of the opening from the steady canopy.
void describe_mesh(Fields& fields, InflationSettings& inflation) {
  fields
      .number("line_segment_m", inflation.line_segment_m, from(0.001).up_to(10),
              "Target rest length of the springs of a line in the opening. Stiff lines limit its time step.")
      .absent("of [parachute.mesh]");
  fields
      .number(
          "cloth_compression", inflation.cloth_compression, from(0).up_to(1),
          "Stiffness of cloth and tape under compression in an opening, as a share of K_1. Cloth with this "
          "stiffness does not wrinkle. 1: spring of [NFM].")
      .absent("cloth and tape wrinkle, at their buckling strain or 1e-6");
  fields.number("contact_pa", inflation.contact_pa, from(0).up_to(1e6),
                "Contact pressure that would compress two layers of nodes into one; 0: no contact.");
  fields.number("contact_friction", inflation.contact_friction, from(0).up_to(2),
                "Coulomb friction coefficient of cloth on cloth (assumed).");
  fields.number("imperfection_m", inflation.imperfection_m, from(0).up_to(1),
                "Amplitude of the initial imperfection: radial displacement at the outer folds of the skirt, "
                "times cos(harmonic x azimuth), proportional to the radius elsewhere; 0: symmetric.");
  fields.integer("imperfection_harmonic", inflation.imperfection_harmonic, from(1).up_to(1000),
                 "Number of waves of the imperfection around the axis.");
  fields.integer(
      "imperfection_seed", inflation.imperfection_seed, from(0).up_to(1e9),
      "Seed of a random imperfection: waves of all harmonics from 1 to 8 at random azimuths, instead of one "
      "harmonic; 0: none. `ripstop inflate --samples` uses the seeds from 1.");
}

/// Duration, resolution and output.
void describe_run(Fields& fields, InflationSettings& inflation) {
  fields.number("duration_s", inflation.duration_s, above(0).up_to(1000), "Time from deployment to the end.");
  fields.number("history_hz", inflation.history_hz, from(10).up_to(1e6),
                "Smallest number of rows of the load history per second. Each row has the mean, smallest and "
                "largest load of its time steps.");
  fields.number("low_pass_hz", inflation.low_pass_hz, from(0).up_to(1e6),
                "Cutoff frequency of a low-pass filter of the written history; the computation is not "
                "filtered; 0: none.");
  fields.numbers(
      "sheet_s", inflation.sheet_s, 0, 12, from(0).up_to(1000),
      "Times of the shapes in the overview picture; each shape is taken at the next check of the time "
      "step. Empty: eight times up to 0.1 s or, with air = \"coupled\", up to the end.");
  fields.integer("frames", inflation.frames, from(1).up_to(100000), "Number of shapes that are written.");
  fields.number("step_fraction", inflation.step_fraction, above(0).up_to(0.98),
                "Time step over the stability limit.");
}

/// Known loads.
void describe_known(Fields& fields, InflationSettings& inflation) {
  fields.number("measured_peak_n", inflation.measured_peak_n, above(0).up_to(1e7), "Measured peak load.")
      .absent("no measured value");
  fields
      .number("measured_inflation_time_s", inflation.measured_inflation_time_s, above(0).up_to(1000),
              "Measured time after which the load remains within 10 % of the steady load.")
      .absent("no measured value");
  fields
      .number("printed_peak_n", inflation.printed_peak_n, above(0).up_to(1e7),
              "Peak load that the source of the measurement computed.")
      .absent("no published value");
}

}  // namespace

void describe(Fields& fields, ReefingStage& stage) {
  fields
      .number("line_m", stage.line_m, above(0).up_to(1000),
              "Length of the closed reefing line through a ring at every suspension line; at most the "
              "circumference of the skirt, and longer than in the previous stage.")
      .required();
  fields
      .number(
          "cut_s", stage.cut_s, above(0).up_to(1000),
          "Time from deployment at which the line is cut. The cut takes effect at the next check of the time "
          "step (within 2 ms).")
      .required();
  fields.name("material", stage.material, "Material of the reefing line, of kind \"line\".")
      .absent("that of the suspension lines");
}

void describe(Fields& fields, InflationSettings& inflation) {
  describe_start(fields, inflation);
  describe_air(fields, inflation);
  describe_pressure(fields, inflation);
  describe_damping(fields, inflation);
  describe_mesh(fields, inflation);
  describe_run(fields, inflation);
  describe_known(fields, inflation);
  fields.rows("reefing", inflation.reefing,
              "Reefing stage: a line through rings at the skirt until it is cut. The stages are listed in "
              "order; after the last one the canopy opens fully.");
}

}  // namespace ripstop::inline cases
