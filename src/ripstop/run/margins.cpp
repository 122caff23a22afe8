#include "ripstop/run/margins.h"

#include <algorithm>
#include <string>

namespace ripstop {

Margins case_margins(const Settings& resolved, const CanopyMesh& mesh,
                     const std::vector<double>& spring_tensions, const StressPeak& stress,
                     const std::vector<double>& reefing_tensions) {
  const Line& riser = resolved.materials().riser;
  MemberLoads loads;
  loads.cloth = std::max(stress.warp, stress.weft);
  if (!spring_tensions.empty()) {
    for (const LineTension& t : line_tensions(mesh, spring_tensions))
      loads.lines.push_back(t.largest_tension);
    for (const int spring : mesh.rigging.tape_springs)
      loads.tape = std::max(loads.tape, spring_tensions[spring]);
    const std::vector<int>& chain = mesh.rigging.riser_springs;
    for (std::size_t i = 0; i < chain.size(); ++i)
      loads.riser = std::max(
          loads.riser, chain_tension(spring_tensions[chain[i]], riser.bending_fraction, i, chain.size()));
  }
  for (std::size_t i = 0; i < reefing_tensions.size(); ++i)
    loads.others.push_back(
        {"reefing line " + std::to_string(i + 1), reefing_tensions[i], resolved.reefing_lines()[i]});
  const std::optional<Tape>& tape = resolved.materials().tape;
  return margins_of(loads, resolved.margins(), resolved.materials().canopy, tape ? &*tape : nullptr,
                    resolved.materials().line, riser);
}

}  // namespace ripstop
