#include "ripstop/fsi/lines_apart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "ripstop/core/quantity_error.h"
#include "ripstop/flow/apart.h"

namespace ripstop::inline fsi {
namespace {

constexpr double end_in_body = 0.05;  // of the distance from the end of the riser to the skirt

/// Axial springs in the air: the riser, and the lines from the confluence to the cloth.
std::vector<int> springs_in_air(const Rigging& rigging) {
  std::vector<int> springs = rigging.riser_springs;
  for (const LineRun& line : rigging.lines)
    if (!line.apex)
      springs.insert(springs.end(), line.springs.begin(), line.springs.begin() + line.free_springs);
  return springs;
}

}  // namespace

void require_lines_apart(const CanopyMesh& mesh, const std::vector<Vec3>& positions,
                         const std::vector<FlowBody>& bodies) {
  if (bodies.size() < 2) return;
  const Rigging& rigging = mesh.rigging;
  const int end =
      rigging.riser_springs.empty() ? rigging.confluence : mesh.springs[rigging.riser_springs.front()].a;
  const double z_end = positions[end].z,
               from = z_end + end_in_body * (skirt_centroid(mesh, positions).z - z_end);
  for (const int spring : springs_in_air(rigging)) {
    Vec3 low = positions[mesh.springs[spring].a], high = positions[mesh.springs[spring].b];
    if (low.z > high.z) std::swap(low, high);
    if (high.z <= from) continue;
    if (low.z < from) low += (from - low.z) / (high.z - low.z) * (high - low);
    for (std::size_t n = 1; n < bodies.size(); ++n) {
      const FlowBody& body = bodies[n];
      if (std::none_of(body.surface.begin(), body.surface.end(),
                       [&](const Triangle& t) { return pierces(low, high, t); }))
        continue;
      throw QuantityError(
          ExitCode::usage,
          fmt::format(
              "the lines or the riser pass through the body \"{}\" between z = {:.4g} and {:.4g} m. "
              "The riser ends at z = {:.4g} m: a body on the axis must lie upstream of it; change the "
              "position of the body, such as its trailing distance",
              body.name, low.z, high.z, z_end),
          {"the position of the body"});
    }
  }
}

}  // namespace ripstop::inline fsi
