// The keys of [inflation].
#include "ripstop/case/case.h"
#include "ripstop/core/toml/fields.h"

namespace ripstop {
namespace {

/// The folded start.
void describe_start(Fields& fields, InflationSettings& inflation) {
  fields
      .number("initial_radius_m", inflation.initial_radius_m, above(0).up_to(1000),
              "Radius of the folded skirt, midway between its inner and outer folds.")
      .absent("needed by ripstop inflate");
  fields.integer("folds", inflation.folds, from(0).up_to(1000),
                 "Outer folds round the canopy, as many inner ones; 0: one a line.");
  fields.number("slack_m", inflation.slack_m, from(0).up_to(1000),
                "By which the lines are longer than their way from confluence to skirt.");
}

/// What presses.
void describe_air(Fields& fields, InflationSettings& inflation) {
  fields.choice(
      "air", inflation.air, {{"uniform", AirModel::uniform}, {"coupled", AirModel::coupled}},
      "What presses on the cloth: one pressure for all of it, with a damping; or the air of [flow], "
      "stepped in time together with the cloth, which takes no pressure and no C_a.");
  fields.number("courant", inflation.courant, above(0).up_to(1),
                "Largest Courant number of the air's steps, with air = \"coupled\".");
  fields.choice(
      "mass", inflation.mass,
      {{"infinite", InflationSettings::Mass::infinite}, {"payload", InflationSettings::Mass::payload}},
      "What the riser's end does in its own air: held in the stream, as in a tunnel; or it is the "
      "payload.mass_kg, which the opening slows down.");
  fields.number("flight_angle_deg", inflation.flight_angle_deg, from(-90).up_to(90),
                "Of the payload's path below the horizon at deployment, 90 straight down; weight turns it.");
}

/// The pressure over the canopy.
void describe_pressure(Fields& fields, InflationSettings& inflation) {
  fields
      .number("pressure_pa", inflation.pressure_pa, above(0).up_to(1e6),
              "Uniform pressure difference over the canopy.")
      .absent("from drag_coefficient, or from a steady run given on the command line");
  fields
      .number("drag_coefficient", inflation.drag_coefficient, above(0).up_to(5),
              "C_D on S0: the pressure is such that the steady drag is C_D S0 q at the speed of [flow].")
      .absent("from pressure_pa, or from a steady run given on the command line");
  fields.number("ramp_s", inflation.ramp_s, from(0).up_to(1000),
                "Time in which the pressure rises in proportion to time; 0: at once.");
}

/// The damping.
void describe_damping(Fields& fields, InflationSettings& inflation) {
  fields.number("damping_n_s_m3", inflation.damping_n_s_m3, from(0).up_to(1e5),
                "C_a: absolute damping of the cloth a unit area ([NFM] Eq. 20, mended).");
  fields.number("quadratic_damping_n_s2_m4", inflation.quadratic_damping_n_s2_m4, from(0).up_to(1e5),
                "The same in proportion to the square of the speed.");
  fields.number("line_damping_s", inflation.line_damping_s, from(0).up_to(1e-3),
                "Relative damping of lines and tape as a time: C = line_damping_s K_1 / L0 (assumed).");
  fields.number("cloth_damping_s", inflation.cloth_damping_s, from(0).up_to(1e-3),
                "Relative damping of the cloth's springs, likewise (none assumed).");
  fields.number(
      "cloth_damping_step_share", inflation.cloth_damping_step_share, from(0.05).up_to(0.999),
      "Where the cloth's damping would leave less than this of the stable step, a cell has less of it");
}

/// What the opening has unlike the steady canopy.
void describe_mesh(Fields& fields, InflationSettings& inflation) {
  fields
      .number("line_segment_m", inflation.line_segment_m, from(0.001).up_to(10),
              "Rest length that the springs of a line aim at, in the opening: stiff lines set its step.")
      .absent("that of [parachute.mesh]");
  fields
      .number("cloth_compression", inflation.cloth_compression, from(0).up_to(1),
              "Stiffness of cloth and tape in compression relative to K_1 at any strain, in the opening, in "
              "place of wrinkles; 1 is the spring that [NFM] prints.")
      .absent("cloth and tape wrinkle, at their buckling strain or 1e-6");
  fields.number("contact_pa", inflation.contact_pa, from(0).up_to(1e6),
                "Pressure that would press two layers of cloth into one; 0: cloth passes through cloth.");
  fields.number("contact_friction", inflation.contact_friction, from(0).up_to(2),
                "Coulomb's coefficient of cloth on cloth (assumed).");
  fields.number("imperfection_m", inflation.imperfection_m, from(0).up_to(1),
                "The folded cloth starts moved outward by this much times cos(harmonic x azimuth) at the "
                "outer folds of the skirt, in proportion to the radius elsewhere; 0: symmetric.");
  fields.integer("imperfection_harmonic", inflation.imperfection_harmonic, from(1).up_to(1000),
                 "Waves round the axis of that imperfection.");
  fields.integer(
      "imperfection_seed", inflation.imperfection_seed, from(0).up_to(1e9),
      "Above 0: in place of that harmonic, waves of all harmonics from 1 to 8 at random azimuths, which "
      "follow from this number. `ripstop inflate --samples` counts it up.");
}

/// How long, how finely and what is written.
void describe_run(Fields& fields, InflationSettings& inflation) {
  fields.number("duration_s", inflation.duration_s, above(0).up_to(1000), "Time from deployment to the end.");
  fields.number(
      "history_hz", inflation.history_hz, from(10).up_to(1e6),
      "Rows a second of the load history, at least; each has the mean, least and largest load of all "
      "its steps.");
  fields.number("low_pass_hz", inflation.low_pass_hz, from(0).up_to(1e6),
                "Cutoff of a low-pass over the written history; the computation is not filtered; 0: none.");
  fields.numbers(
      "sheet_s", inflation.sheet_s, 0, 12, from(0).up_to(1000),
      "Instants whose shapes the contact sheet shows, at the next look at the step; none: eight, up to "
      "0.1 s or, with air = \"coupled\", to the end.");
  fields.integer("frames", inflation.frames, from(1).up_to(100000), "Shapes that are written.");
  fields.number("step_fraction", inflation.step_fraction, above(0).up_to(0.98),
                "Time step over the largest stable one.");
}

/// What is known of the load.
void describe_known(Fields& fields, InflationSettings& inflation) {
  fields.number("measured_peak_n", inflation.measured_peak_n, above(0).up_to(1e7), "Measured peak load.")
      .absent("withheld or not measured");
  fields
      .number("measured_inflation_time_s", inflation.measured_inflation_time_s, above(0).up_to(1000),
              "Measured time until the load stays within 10 % of steady.")
      .absent("withheld or not measured");
  fields
      .number("printed_peak_n", inflation.printed_peak_n, above(0).up_to(1e7),
              "Peak load that the source's model gives.")
      .absent("not printed");
}

}  // namespace

void describe(Fields& fields, ReefingStage& stage) {
  fields
      .number("line_m", stage.line_m, above(0).up_to(1000),
              "Length of the reefing line, once round through a ring where every line meets the skirt; at "
              "most the "
              "skirt's circumference, and longer than that of the stage before.")
      .required();
  fields
      .number("cut_s", stage.cut_s, above(0).up_to(1000),
              "Time from deployment at which the line is cut, at the next look at the step (2 ms at most).")
      .required();
  fields.name("material", stage.material, "Line of the library or of this case: its stiffness and strength.")
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
              "A stage of reefing: a line through rings at the skirt, until it is cut. Stages in order; "
              "after the last the canopy is fully open.");
}

}  // namespace ripstop
