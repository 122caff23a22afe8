// The keys of [payload] and [margins].
#include "ripstop/case/case.h"
#include "ripstop/core/toml/fields.h"

namespace ripstop {

void describe(Fields& fields, PayloadKeys& payload) {
  fields
      .number("mass_kg", payload.mass_kg, above(0).up_to(1e6),
              "Mass below the parachute, without the parachute's own: `ripstop steady` finds the speed at "
              "which the "
              "drag is the weight of both.")
      .absent("the speed is given");
  fields.number(
      "drag_area_m2", payload.drag_area_m2, from(0).up_to(1e4),
      "C_D S of the payload itself, in the undisturbed stream: it holds a part of the weight in `ripstop "
      "steady` and slows a payload that flies in an opening. Its wake on the canopy is not in it. Take a "
      "measured value for a smooth body: its separation is not "
      "computed.");
}

// Knacke, NWC TP 6575, 6.2, has safety factors of 1.5 (unmanned) to 2 and the losses below; the values were written
// down from memory and not checked against the print. No public text with his table was found.
void describe(Fields& fields, MarginFactors& m) {
  fields.number(
      "safety_factor", m.safety_factor, from(1).up_to(10),
      "Design factor on every load: 1.5 for unmanned systems and cargo, 2 and more for people (order of "
      "Knacke's, NWC TP 6575, chapter 6, not checked against the print).");
  fields.number(
      "seam_efficiency", m.seam_efficiency, above(0).up_to(1),
      "Strength that a seam leaves of cloth and tape (0.8 as Knacke's joints; from your own seams if you "
      "have pulled them).");
  fields.number("line_joint_efficiency", m.line_joint_efficiency, above(0).up_to(1),
                "Strength that loops, knots and stitches leave of lines and riser (0.8, likewise).");
  fields.number("abrasion", m.abrasion, above(0).up_to(1), "Strength left after abrasion (0.95, likewise).");
  fields.number("moisture", m.moisture, above(0).up_to(1),
                "Strength of wet fibre over dry (0.95, nylon, likewise).");
  fields.number("fatigue", m.fatigue, above(0).up_to(1),
                "Strength left after the uses planned (0.95, likewise).");
  fields.number("temperature", m.temperature, above(0).up_to(1),
                "Strength at the highest temperature of the cloth over that at 20 C (1: cool).");
}

}  // namespace ripstop
