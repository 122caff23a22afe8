// The keys of [payload], [flight], [margins] and [hardware].
#include "ripstop/case/case.h"
#include "ripstop/core/toml/fields.h"
#include "ripstop/flight/atmosphere.h"

namespace ripstop::inline cases {

void describe(Fields& fields, PayloadKeys& payload) {
  fields
      .number("mass_kg", payload.mass_kg, above(0).up_to(1e6),
              "Mass below the parachute, without the mass of the parachute: `ripstop steady` computes the "
              "speed at which the drag equals the weight of both.")
      .absent("the speed is given");
  fields
      .number("deployment_speed_m_s", payload.deployment_speed_m_s, above(0).up_to(1000),
              "Airspeed at line stretch. `ripstop load`, `inflate` and `fly --deploy` without `--speed`, the "
              "margins of `ripstop check`, the choice of a default tape and the filling time of `ripstop "
              "export` are for this speed.")
      .absent(
          "with mass_kg the larger of 20 m/s and three times the rate of descent, without it flow.speed_m_s; "
          "`ripstop load` then needs --speed, and an opening starts at flow.speed_m_s");
  fields.number(
      "drag_area_m2", payload.drag_area_m2, from(0).up_to(1e4),
      "Drag area C_D S of the payload in the undisturbed stream: it carries a part of the weight in `ripstop "
      "steady` and decelerates a free payload during the opening. Its wake needs a body, "
      "[body.NAME]. Use a measured value for a smooth body: its flow separation is not computed.");
}

void describe(Fields& fields, Wind& wind) {
  fields.number("speed_m_s", wind.speed_m_s, from(0).up_to(100),
                "Speed of the wind at the reference height.");
  fields.number("direction_deg", wind.direction_deg, from(-360).up_to(360),
                "Direction towards which the wind blows, from x to y.");
  fields.number("exponent", wind.exponent, from(0).up_to(1),
                "Exponent p of the profile speed_m_s (h / reference_height_m)^p over the height h above "
                "the ground; 0: the same wind at all heights. The law describes the lowest few hundred "
                "metres.");
  fields.number("reference_height_m", wind.reference_height_m, above(0).up_to(10000),
                "Height above the ground at which the wind has its speed.");
  fields.number("gust_m_s", wind.gust_m_s, from(-100).up_to(100),
                "Largest addition of one gust to the wind speed. The gust rises and falls as 1 - cos.");
  fields.number("gust_start_s", wind.gust_start_s, from(0).up_to(1e5),
                "Time from the start of the flight at which the gust begins.");
  fields.number("gust_duration_s", wind.gust_duration_s, above(0).up_to(1e4), "Duration of the gust.");
}

void describe(Fields& fields, FlightSettings& flight) {
  fields.choice(
      "start", flight.start,
      {{"steady", FlightSettings::Start::steady}, {"inflation", FlightSettings::Start::inflation}},
      "\"steady\": equilibrium on the axis at the speed at which drag equals weight. \"inflation\": the "
      "end of a coupled inflation with the payload, which is computed first.");
  fields.number("duration_s", flight.duration_s, above(0).up_to(1e4),
                "Longest time of flight, without the inflation.");
  fields.number("courant", flight.courant, above(0).up_to(1),
                "Largest Courant number of the steps of the flow.");
  fields.number("cells_across", flight.cells_across, from(8).up_to(400),
                "Number of flow cells across the nominal diameter, if the case gives neither flow.cells nor "
                "flow.box_m nor flow.core.size_m.");
  fields.number("angle_deg", flight.angle_deg, from(-60).up_to(60),
                "Angle between the vertical and the line from payload to canopy at the start.");
  fields.number("azimuth_deg", flight.azimuth_deg, from(-360).up_to(360),
                "Azimuth towards which the payload is displaced from below the canopy at the start, from the "
                "x axis towards the y axis.");
  fields.number("swing_deg_s", flight.swing_deg_s, from(-360).up_to(360),
                "Rate of change of angle_deg at the start.");
  fields
      .vector("velocity_m_s", flight.velocity_m_s, from(-100).up_to(100),
              "Velocity of the parachute relative to the ground at the start, z upward.")
      .absent("horizontally the wind, downward the speed at which drag equals weight");
  fields
      .number("height_m", flight.height_m, above(0).up_to(highest_height),
              "Height of the payload above the ground at the start; the flight ends at the ground.")
      .absent("no ground");
  fields
      .number("standard_error", flight.standard_error, above(0).up_to(1),
              "Relative standard error of the rate of descent at which the flight ends.")
      .absent("the flight ends after its duration or at the ground");
  fields.number("shapes_per_s", flight.shapes_per_s, above(0).up_to(1000),
                "Number of shapes that are written per second of flight.");
  fields.table("wind", flight.wind, "Wind over the ground.");
}

// Knacke, NWC TP 6575, 6.2, has safety factors of 1.5 (unmanned) to 2 and the losses below; the values were written
// down from memory and not checked against the print. No public text with his table was found.
void describe(Fields& fields, MarginFactors& m) {
  fields.number("safety_factor", m.safety_factor, from(1).up_to(10),
                "Design factor on every load: 1.5 for unmanned systems and cargo, 2 and more for people "
                "(similar to Knacke, NWC TP 6575, chapter 6; not checked against the print).");
  fields.number("seam_efficiency", m.seam_efficiency, above(0).up_to(1),
                "Strength of a seam over that of cloth and tape (0.8: Knacke, NWC TP 6575, not checked "
                "against the print; use values of your own seam tests if available).");
  fields.number(
      "line_joint_efficiency", m.line_joint_efficiency, above(0).up_to(1),
      "Strength of sewn loops and splices over that of lines and riser (0.8: Knacke, NWC TP 6575, not "
      "checked against the print). A knot leaves about 0.5 (assumed; measure it).");
  fields.number("abrasion", m.abrasion, above(0).up_to(1),
                "Strength after abrasion over new strength (0.95: Knacke, NWC TP 6575, not checked against "
                "the print).");
  fields.number(
      "moisture", m.moisture, above(0).up_to(1),
      "Strength of wet fibre over dry (0.95: nylon, Knacke, NWC TP 6575, not checked against the print).");
  fields.number("fatigue", m.fatigue, above(0).up_to(1),
                "Strength after the planned number of uses over new strength (0.95: Knacke, NWC TP 6575, not "
                "checked against the print).");
  fields.number("temperature", m.temperature, above(0).up_to(1),
                "Strength at the highest temperature of the cloth over that at 20 C (1: no heating).");
}

void describe(Fields& fields, Hardware& part) {
  fields
      .choice("kind", part.kind, {{"metal", Hardware::Kind::metal}, {"textile", Hardware::Kind::textile}},
              "\"textile\": the reduction factors of [margins] for a line apply to its breaking load. "
              "\"metal\": only the safety factor applies. Required with length_m or stiffness_n.")
      .absent("metal");
  fields
      .number("breaking_load_n", part.breaking_load_n, above(0).up_to(1e8),
              "Load at which one strand breaks. Give this or rated_load_n.")
      .absent("rated_load_n is given");
  fields
      .number("rated_load_n", part.rated_load_n, above(0).up_to(1e8),
              "Load that the maker allows for one strand (working load limit). It includes the maker's "
              "safety factor, so that no factor of [margins] is applied.")
      .absent("breaking_load_n is given");
  fields.integer("strands", part.strands, from(1).up_to(100),
                 "Number of equal strands that share the load, such as the legs of a harness.");
  fields
      .number("length_m", part.length_m, above(0).up_to(1000),
              "Length of one strand, for the snatch load; with stiffness_n.")
      .absent("the part does not stretch");
  fields
      .number("stiffness_n", part.stiffness_n, above(0).up_to(1e9),
              "Tension of one strand over its strain, for the snatch load: 1000 N at 20 % is 5000 N.")
      .absent("the part does not stretch");
}

}  // namespace ripstop::inline cases
