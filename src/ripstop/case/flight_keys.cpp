// The keys of [payload] and [margins].
#include "ripstop/case/case.h"
#include "ripstop/core/toml/fields.h"

namespace ripstop {

void describe(Fields& fields, PayloadKeys& payload) {
  fields
      .number("mass_kg", payload.mass_kg, above(0).up_to(1e6),
              "Mass below the parachute, without the mass of the parachute: `ripstop steady` computes the "
              "speed at which the drag equals the weight of both.")
      .absent("the speed is given");
  fields.number(
      "drag_area_m2", payload.drag_area_m2, from(0).up_to(1e4),
      "Drag area C_D S of the payload in the undisturbed stream: it carries a part of the weight in `ripstop "
      "steady` and decelerates a free payload during the opening. The effect of its wake on the canopy is "
      "not modelled. Use a measured value for a smooth body: its flow separation is not computed.");
}

// Knacke, NWC TP 6575, 6.2, has safety factors of 1.5 (unmanned) to 2 and the losses below; the values were written
// down from memory and not checked against the print. No public text with his table was found.
void describe(Fields& fields, MarginFactors& m) {
  fields.number("safety_factor", m.safety_factor, from(1).up_to(10),
                "Design factor on every load: 1.5 for unmanned systems and cargo, 2 and more for people "
                "(order of the values of Knacke, NWC TP 6575, chapter 6, not verified in print).");
  fields.number("seam_efficiency", m.seam_efficiency, above(0).up_to(1),
                "Strength of a seam over that of cloth and tape (0.8: joints by Knacke; use values of your "
                "own seam tests if available).");
  fields.number("line_joint_efficiency", m.line_joint_efficiency, above(0).up_to(1),
                "Strength of loops, knots and stitches over that of lines and riser (0.8, likewise).");
  fields.number("abrasion", m.abrasion, above(0).up_to(1),
                "Strength after abrasion over new strength (0.95, likewise).");
  fields.number("moisture", m.moisture, above(0).up_to(1),
                "Strength of wet fibre over dry (0.95, nylon, likewise).");
  fields.number("fatigue", m.fatigue, above(0).up_to(1),
                "Strength after the planned number of uses over new strength (0.95, likewise).");
  fields.number("temperature", m.temperature, above(0).up_to(1),
                "Strength at the highest temperature of the cloth over that at 20 C (1: no heating).");
}

}  // namespace ripstop
