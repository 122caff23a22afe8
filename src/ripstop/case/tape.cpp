#include "ripstop/case/tape.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "ripstop/case/payload.h"
#include "ripstop/core/error.h"
#include "ripstop/core/words.h"
#include "ripstop/fsi/opening_estimate.h"
#include "ripstop/parachute/cut.h"

namespace ripstop::inline cases {
namespace {

constexpr double unknown_opening = 1.8;  // C_x, the highest of the families' (assumed)

/// Safety factor times load over the allowable load of the tape, or of a hem (null); nothing if the strength is not known.
std::optional<double> used(const Case& given, double line_load, const Tape* tape) {
  return margins_of(edge_loads(line_load, tape), given.margins, canopy_fabric(given), tape, {}, {})
      .members.back()
      .used;
}

/// Slots that lines do not span, or that have tapes of their own.
bool slots_need_tape(const Design& design) {
  const CanopyFacts canopy = facts(design);
  const bool lines_end_below = line_length_on_disk(design) < canopy.line_run * (1 - 1e-9);
  return canopy.vertical_tapes > 0 || (canopy.slot_area > 0 && lines_end_below);
}

}  // namespace

TapeMaterial tape_for(const Case& given, double line_load) {
  line_load = std::max(1e-9, line_load);  // mistakes of air and area are reported elsewhere
  const std::optional<double> hem = used(given, line_load, nullptr);
  if (hem && *hem <= 1 && !slots_need_tape(given.parachute))
    return {no_tape,
            fmt::format("a hem of {:g} mm of the cloth carries the {} N of one line (utilisation {:.0f} %)",
                        1000 * Allowances{}.hem, rounded(line_load, 3), 100 * *hem),
            *hem};
  const Tape *lightest = nullptr, *strongest = nullptr;
  double least_used = 0;
  for (const auto& [name, material] : given.materials) {
    const Tape* tape = std::get_if<Tape>(&material);
    const std::optional<double> share = tape ? used(given, line_load, tape) : std::nullopt;
    if (!share) continue;
    if (!strongest || *share < least_used) strongest = tape, least_used = *share;
    if (*share <= 1 && (!lightest || tape->linear_density_kg_m < lightest->linear_density_kg_m))
      lightest = tape;
  }
  if (!strongest)
    throw Error(ExitCode::usage, "the case has no tape of known strength: give parachute.tape.material");
  const Tape& chosen = lightest ? *lightest : *strongest;
  const double share = *used(given, line_load, &chosen);
  return {chosen.name,
          fmt::format("{} the {} N of one line (utilisation {:.0f} %)",
                      lightest ? "the lightest tape that carries" : "the strongest tape, too weak for",
                      rounded(line_load, 3), 100 * share),
          share};
}

UsualOpening usual_opening(const Case& given) {
  const Air stream = air(given);
  const auto known = deployment_speed(given.payload);
  const bool assumed =
      !known && given.payload.mass_kg && given.inflation.mass != InflationSettings::Mass::payload;
  const double speed = known ? known->speed : assumed ? usual_deployment_speed(stream.speed) : stream.speed;
  const double coefficient = experience(given.parachute).opening_coefficient;
  const double drag = design_drag_coefficient(
      given.parachute, given.inflation.drag_coefficient.value_or(usual_drag_coefficient(given.parachute)));
  const double load = (coefficient > 0 ? coefficient : unknown_opening) * drag *
                      nominal_area(given.parachute) * 0.5 * stream.density * speed * speed;
  return {speed, load,
          known     ? known->from
          : assumed ? "assumed: the case does not give payload.deployment_speed_m_s"
                    : "flow.speed_m_s"};
}

TapeMaterial tape_material(const Case& given) {
  if (given.parachute.tape.material) return {*given.parachute.tape.material, "given", 0};
  const auto [speed, load, from] = usual_opening(given);
  TapeMaterial tape =
      tape_for(given, experience(given.parachute).line_load_factor * load / given.parachute.lines.count);
  tape.from += fmt::format(" in an opening at {:.3g} m/s ({})", speed, from);
  return tape;
}

void take_tape(const TapeMaterial& tape, Case& given) {
  given.parachute.tape.material = tape.name;
  std::erase_if(given.materials, [&](const auto& material) {
    return std::holds_alternative<Tape>(material.second) && material.first != tape.name &&
           !given.origins.contains("materials." + material.first);
  });
}

}  // namespace ripstop::inline cases
