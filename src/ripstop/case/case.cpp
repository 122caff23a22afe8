#include "ripstop/case/case.h"

#include <cmath>

#include "ripstop/case/payload.h"
#include "ripstop/case/tape.h"
#include "ripstop/core/toml/fields.h"
#include "ripstop/flight/atmosphere.h"

namespace ripstop::inline cases {
namespace {

template <class Kind>
const Kind& material(const Case& given, const std::string& name) {
  const auto found = given.materials.find(name);
  const Kind* chosen = found == given.materials.end() ? nullptr : std::get_if<Kind>(&found->second);
  if (!chosen) throw Error(ExitCode::usage, "no material \"" + name + "\" of the required kind");
  return *chosen;
}

}  // namespace

void describe(Fields& fields, Measured& measured) {
  fields
      .number("nominal_speed_m_s", measured.nominal_speed_m_s, above(0).up_to(100),
              "Nominal speed of the wind tunnel.")
      .required();
  fields
      .number("measured_speed_m_s", measured.measured_speed_m_s, above(0).up_to(100),
              "Measured speed of the wind tunnel.")
      .required();
  fields.number("density_kg_m3", measured.density_kg_m3, above(0).up_to(20), "Density of the air.")
      .required();
  fields.number("drag_n", measured.drag_n, above(0).up_to(1e7), "Measured drag.").absent("no measured value");
  fields
      .number("printed_nonlinear_n", measured.printed_nonlinear_n, above(0).up_to(1e7),
              "Drag that the source of the measurement computed with its nonlinear model.")
      .absent("no published value");
  fields
      .number("printed_linear_n", measured.printed_linear_n, above(0).up_to(1e7),
              "Drag that this source computed with its linear model.")
      .absent("no published value");
}

void describe(Fields& fields, Case& given) {
  fields.text("title", given.title, 200, "Title for reports.");
  fields.table("parachute", given.parachute, "The parachute.").required();
  fields.named_tables(
      "materials", given.materials,
      "Materials of this case. They take precedence over those of the library with the same name.");
  fields
      .table("flow", given.flow,
             "The air, the flow domain and the flow solver. A default marked `paper` is that of the porosity "
             "model `paper`; the other is that of `sheet`. The inflated diameter d is 0.7 nominal diameters, "
             "or more if the undeformed start shape needs more.")
      .required();
  fields.named_tables("body", given.bodies,
                      "Rigid bodies upstream of the canopy, such as the rocket or the capsule: [body.NAME].");
  fields.table("cluster", given.cluster,
               "Cluster of canopies in place of one, only for `ripstop steady`, `sweep`, `fly` and "
               "coupled `inflate`; experimental.");
  fields.table("coupling", given.coupling, "Steady coupling of cloth and flow.");
  fields.table("inflation", given.inflation, "The opening of the folded canopy.");
  fields.table("deployment", given.deployment,
               "Deployment before the opening of `ripstop inflate --air coupled`: from the extraction of the "
               "bag until the canopy has left it. An empty table has default values. Without the table a "
               "coupled opening starts from the folded canopy, stretched out.");
  fields.table("payload", given.payload, "Payload below the parachute, instead of a given flow speed.");
  fields.table("flight", given.flight, "Free flight of parachute and payload.");
  fields.table("margins", given.margins,
               "Safety and strength reduction factors for the margins of cloth, tape, lines and riser.");
  fields.named_tables("hardware", given.hardware,
                      "Parts between riser and payload, each with its name: swivel, links, harness, shock "
                      "cord. Every one carries the load of the riser and is a member of the margins.");
  fields.rows("measured", given.measured,
              "Wind-tunnel conditions: state of the air, and measurements for comparison.");
}

const Measured* measured_row(const Case& given) {
  if (!given.flow.speed_m_s) return nullptr;
  const double wanted = *given.flow.speed_m_s;
  for (const Measured& row : given.measured)
    if (std::abs(row.nominal_speed_m_s - wanted) <= 1e-9 * wanted) return &row;
  return nullptr;
}

Air air(const Case& given) {
  const FlowKeys& flow = given.flow;
  const Measured* row = measured_row(given);
  if (!row && (flow.speed_basis == SpeedBasis::measured || !(flow.density_kg_m3 || flow.height_m)))
    throw Error(ExitCode::usage, "no row of [[measured]] has the nominal speed of this case");
  Air air;
  air.density = flow.density_kg_m3 ? *flow.density_kg_m3
                : flow.height_m    ? standard_air(*flow.height_m).density
                                   : row->density_kg_m3;
  air.speed = flow.speed_basis == SpeedBasis::measured ? row->measured_speed_m_s
              : flow.speed_m_s                         ? *flow.speed_m_s
                                                       : payload_first_speed(given, air.density);
  return air;
}

const Fabric& canopy_fabric(const Case& given) {
  return material<Fabric>(given, given.parachute.canopy_material);
}
const Line& suspension_line(const Case& given) {
  return material<Line>(given, given.parachute.lines.material);
}
const Line& riser_line(const Case& given) {
  return material<Line>(given, given.parachute.riser.material);
}
const Line& reefing_line(const Case& given, const ReefingStage& stage) {
  return material<Line>(given, stage.material.value_or(given.parachute.lines.material));
}
const Tape* reinforcement_tape(const Case& given) {
  const std::string name = tape_material(given).name;
  return name == no_tape ? nullptr : &material<Tape>(given, name);
}

}  // namespace ripstop::inline cases
