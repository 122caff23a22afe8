#include "ripstop/canopy/margins.h"

#include <utility>

#include "ripstop/material/strength.h"
#include "ripstop/parachute/cut.h"

namespace ripstop::inline canopy {
namespace {

Margin margin_of(std::string member, double load, std::string unit, Strength strength, double knock_down,
                 double safety) {
  Margin m;
  m.member = std::move(member), m.load = load, m.unit = std::move(unit);
  m.strength = strength.value, m.strength_from = std::move(strength.from);
  m.knock_down = knock_down;
  if (m.strength && load > 0) {
    m.used = safety * load / (*m.strength * knock_down);
    m.margin = 1 / *m.used - 1;
  }
  return m;
}

/// Share of the strength that is left of a line or a textile part with its joints.
double joined_share(const MarginFactors& f) {
  return f.abrasion * f.moisture * f.fatigue * f.temperature * f.line_joint_efficiency;
}

}  // namespace

HardwareNeed hardware_need(double load, const MarginFactors& f) {
  return {load, f.safety_factor * load, f.safety_factor * load / joined_share(f)};
}

MemberLoads edge_loads(double line_load, const Tape* tape) {
  MemberLoads loads;
  (tape ? loads.tape : loads.cloth) = tape ? line_load : line_load / Allowances{}.hem;
  return loads;
}

Margins margins_of(const MemberLoads& loads, const MarginFactors& f, const Fabric& cloth, const Tape* tape,
                   const Line& line, const Line& riser, const HardwareParts& hardware) {
  const double sewn = f.abrasion * f.moisture * f.fatigue * f.temperature * f.seam_efficiency;
  const double joined = joined_share(f);
  Margins result;
  auto& members = result.members;
  members.push_back(margin_of("cloth", loads.cloth, "N/m", strength_of(cloth), sewn, f.safety_factor));
  if (tape && loads.tape > 0)
    members.push_back(margin_of("tape", loads.tape, "N", strength_of(*tape), sewn, f.safety_factor));
  const auto add_line = [&](std::string member, double load, const Line& material) {
    members.push_back(
        margin_of(std::move(member), load, "N", strength_of(material), joined, f.safety_factor));
  };
  for (std::size_t i = 0; i < loads.lines.size(); ++i)
    add_line("line " + std::to_string(i + 1), loads.lines[i], line);
  if (loads.riser > 0) add_line("riser", loads.riser, riser);
  for (const MemberLoads::OtherLine& other : loads.others) add_line(other.member, other.load, other.material);
  for (const auto& [name, part] : hardware) {
    const double one = part.rated_load_n ? *part.rated_load_n : part.breaking_load_n.value_or(0);
    const Strength strength{part.strands * one, part.rated_load_n ? "rated load" : "breaking load"};
    const bool textile = part.kind == Hardware::Kind::textile && !part.rated_load_n;
    members.push_back(margin_of(name, loads.hardware, "N", strength, textile ? joined : 1,
                                part.rated_load_n ? 1 : f.safety_factor));
    members.back().load_from = loads.hardware_from;
  }
  take_weakest(result);
  return result;
}

const Margin* weakest(const Margins& margins) {
  const Margin* least = nullptr;
  for (const Margin& m : margins.members)
    if (m.used && (!least || *m.used > *least->used)) least = &m;
  return least;
}

void take_weakest(Margins& margins) {
  const Margin* least = weakest(margins);
  margins.weakest = least ? least->member : "";
}

}  // namespace ripstop::inline canopy
