#include "ripstop/run/margins.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string>

#include "ripstop/core/words.h"

namespace ripstop::inline run {

Margins case_margins(const Settings& resolved, const CanopyMesh& mesh,
                     const std::vector<double>& spring_tensions, const StressPeak& stress,
                     const std::vector<double>& reefing_tensions) {
  const Line& riser = resolved.materials().riser;
  MemberLoads loads;
  loads.cloth = std::max(stress.warp, stress.weft);
  if (!spring_tensions.empty()) {
    for (const LineTension& t : line_tensions(mesh, spring_tensions))
      if (t.apex)
        loads.others.push_back(
            {fmt::format("apex line {}", t.number), t.largest_tension, resolved.materials().line});
      else
        loads.lines.push_back(t.largest_tension);
    for (const int spring : mesh.rigging.tape_springs)
      loads.tape = std::max(loads.tape, spring_tensions[spring]);
    // A cluster has a riser of equal length for each canopy; the hardware below the confluence carries all of them.
    const std::vector<int>& springs = mesh.rigging.riser_springs;
    const std::size_t count = springs.size() / std::max<std::size_t>(1, mesh.fixed.size());
    for (std::size_t first = 0; count > 0 && first < springs.size(); first += count) {
      double load = 0;
      for (std::size_t i = 0; i < count; ++i)
        load = std::max(load, chain_tension(spring_tensions[static_cast<std::size_t>(springs[first + i])],
                                            riser.bending_fraction, i, count));
      loads.riser = std::max(loads.riser, load);
      loads.hardware += load;
    }
  }
  // Without a riser the lines pull at the hardware; the sum of their peaks is an upper bound of that load.
  if (!(loads.riser > 0)) loads.hardware = std::accumulate(loads.lines.begin(), loads.lines.end(), 0.0);
  for (std::size_t i = 0; i < reefing_tensions.size(); ++i)
    loads.others.push_back(
        {"reefing line " + std::to_string(i + 1), reefing_tensions[i], resolved.reefing_lines()[i]});
  const std::optional<Tape>& tape = resolved.materials().tape;
  return margins_of(loads, resolved.margins(), resolved.materials().canopy, tape ? &*tape : nullptr,
                    resolved.materials().line, riser, resolved.hardware());
}

Margins load_margins(const Settings& resolved, double load) {
  const PartMaterials& materials = resolved.materials();
  return load_margins(resolved.parachute(), resolved.margins(), materials.canopy,
                      materials.tape ? &*materials.tape : nullptr, load, materials.line, materials.riser,
                      resolved.hardware());
}

Margins load_margins(const Design& design, const MarginFactors& factors, const Fabric& cloth,
                     const Tape* tape, double load, const Line& line, const Line& riser,
                     const HardwareParts& hardware) {
  const double line_load = experience(design).line_load_factor * load / design.lines.count;
  MemberLoads loads = edge_loads(line_load, tape);
  loads.lines = {line_load};
  if (design.riser.length_m > 0) loads.riser = load;
  loads.hardware = load;
  Margins margins = margins_of(loads, factors, cloth, tape, line, riser, hardware);
  if (tape)
    std::erase_if(margins.members,
                  [](const Margin& m) { return m.member == "cloth"; });  // its load is not known
  for (Margin& m : margins.members) {
    if (m.member == "cloth") m.member = "hem";
    if (m.member == "line 1") m.member = "line";
  }
  const Margin* least = weakest(margins);
  margins.weakest = least ? least->member : "";
  return margins;
}

std::vector<Margin> weakest_of_kinds(const Margins& margins) {
  const auto kind_of = [](const Margin& m) {
    for (const char* kind : {"line ", "apex line "})
      if (m.member.starts_with(kind)) return std::string(kind);
    return m.member;
  };
  std::vector<Margin> rows;
  for (const Margin& m : margins.members) {
    if (rows.empty() || kind_of(rows.back()) != kind_of(m)) {
      rows.push_back(m);
    } else if (m.used.value_or(0) > rows.back().used.value_or(0)) {
      rows.back() = m;
    }
  }
  return rows;
}

std::vector<std::string> margin_warnings(const std::optional<Margins>& margins) {
  std::vector<std::string> all;
  if (!margins) return all;
  for (const Margin& m : weakest_of_kinds(*margins))
    if (m.margin && *m.margin < 0)
      all.push_back(
          fmt::format("{} exceeds its allowable load: its load of {} {} with the safety factor is {} "
                      "times the allowable {} {} (margin of safety {:+.2f}); use a stronger material",
                      m.member, rounded(m.load), m.unit, rounded(*m.used, 3),
                      rounded(*m.strength * m.knock_down), m.unit, *m.margin));
  return all;
}

}  // namespace ripstop::inline run
