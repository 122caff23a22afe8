#include "ripstop/run/margins.h"

#include <algorithm>

namespace ripstop {

Margins case_margins(const Case& given, const CanopyMesh& mesh, const std::vector<double>& spring_tensions,
                     const StressPeak& stress) {
  const Line& riser = riser_line(given);
  MemberLoads loads;
  loads.cloth = std::max(stress.warp, stress.weft);
  if (!spring_tensions.empty()) {
    for (const LineTension& t : line_tensions(mesh, spring_tensions))
      loads.lines.push_back(t.largest_tension);
    for (const int spring : mesh.rigging.tape_springs)
      loads.tape = std::max(loads.tape, spring_tensions[spring]);
    for (const int spring : mesh.rigging.riser_springs)
      loads.riser = std::max(loads.riser, spring_tensions[spring] / (1 - riser.bending_fraction));
  }
  return margins_of(loads, given.margins, canopy_fabric(given), reinforcement_tape(given),
                    suspension_line(given), riser);
}

}  // namespace ripstop
