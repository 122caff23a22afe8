#include "ripstop/run/margins.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "ripstop/core/words.h"

namespace ripstop::inline run {

namespace {

/// Without a tape a hem of the cloth carries the load of one line [N]; listed after the cloth.
void add_hem(double line_load, const MarginFactors& factors, const Fabric& cloth, Margins& margins) {
  Margin hem = margins_of(edge_loads(line_load, nullptr), factors, cloth, nullptr, {}, {}).members.front();
  hem.member = "hem";
  margins.members.insert(margins.members.begin() + 1, std::move(hem));
}

}  // namespace

Margins case_margins(const Settings& resolved, const CanopyMesh& mesh,
                     const std::vector<double>& spring_tensions, const StressPeak& stress,
                     const std::vector<double>& reefing_tensions, std::optional<double> largest_load) {
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
    const std::size_t count = springs.size() / static_cast<std::size_t>(mesh.rigging.canopies);
    for (std::size_t first = 0; count > 0 && first < springs.size(); first += count) {
      double load = 0;
      for (std::size_t i = 0; i < count; ++i)
        load = std::max(load, chain_tension(spring_tensions[static_cast<std::size_t>(springs[first + i])],
                                            riser.bending_fraction, i, count));
      loads.riser = std::max(loads.riser, load);
      loads.hardware += load;
    }
  }
  // Without a riser the lines pull at the hardware; the sum of their loads is an upper bound of that load.
  if (!(loads.riser > 0)) loads.hardware = std::accumulate(loads.lines.begin(), loads.lines.end(), 0.0);
  if (largest_load) loads.hardware = *largest_load, loads.hardware_from = "largest riser load";
  for (std::size_t i = 0; i < reefing_tensions.size(); ++i)
    loads.others.push_back(
        {"reefing line " + std::to_string(i + 1), reefing_tensions[i], resolved.reefing_lines()[i]});
  const std::optional<Tape>& tape = resolved.materials().tape;
  const Fabric& cloth = resolved.materials().canopy;
  Margins margins = margins_of(loads, resolved.margins(), cloth, tape ? &*tape : nullptr,
                               resolved.materials().line, riser, resolved.hardware());
  if (!tape && !loads.lines.empty())
    add_hem(*std::max_element(loads.lines.begin(), loads.lines.end()), resolved.margins(), cloth, margins);
  take_weakest(margins);
  return margins;
}

Margins load_margins(const Settings& resolved, double load, double snatch, const MemberShares& shares) {
  const PartMaterials& materials = resolved.materials();
  return load_margins(resolved.parachute(), resolved.margins(), materials.canopy,
                      materials.tape ? &*materials.tape : nullptr, load, materials.line, materials.riser,
                      resolved.hardware(), snatch, shares);
}

Margins load_margins(const Design& design, const MarginFactors& factors, const Fabric& cloth,
                     const Tape* tape, double load, const Line& line, const Line& riser,
                     const HardwareParts& hardware, double snatch, const MemberShares& shares) {
  const double share = experience(design).line_load_factor / design.lines.count;
  const double line_load = std::max(share, shares.line) * load, largest = std::max(load, snatch);
  MemberLoads loads;
  if (tape) loads = edge_loads(std::max(line_load, shares.tape * load), tape);
  loads.cloth = shares.cloth * load;
  loads.lines = {std::max(line_load, share * snatch)};
  if (design.riser.length_m > 0) loads.riser = std::max(largest, shares.riser * load);
  loads.hardware = largest;
  Margins margins = margins_of(loads, factors, cloth, tape, line, riser, hardware);
  if (!tape) add_hem(line_load, factors, cloth, margins);
  if (!(shares.cloth > 0))
    margins.members.erase(margins.members.begin());  // the load of the cloth is not known
  for (Margin& m : margins.members)
    if (m.member == "line 1") m.member = "line";
  take_weakest(margins);
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

std::string margin_text(double margin) {
  return margin < 0 && margin > -0.005 ? rounded(margin, 1) : fmt::format("{:+.2f}", margin);
}

std::vector<std::string> margin_warnings(const std::optional<Margins>& margins) {
  std::vector<std::string> all;
  if (!margins) return all;
  for (const Margin& m : weakest_of_kinds(*margins))
    if (m.margin && *m.margin < 0)
      all.push_back(
          fmt::format("{} exceeds its allowable load: its load of {} {} times the safety factor is {} "
                      "times the allowable {} {} (margin of safety {}); use a stronger part or material",
                      m.member, rounded(m.load), m.unit, rounded_apart(*m.used, 1).first,
                      rounded(*m.strength * m.knock_down), m.unit, margin_text(*m.margin)));
  return all;
}

}  // namespace ripstop::inline run
