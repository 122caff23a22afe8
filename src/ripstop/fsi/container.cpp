#include "ripstop/fsi/container.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "ripstop/core/error.h"

namespace ripstop::inline fsi {

double ContainerPath::outside(double at) const {
  const auto next = std::upper_bound(time.begin(), time.end(), at);
  if (next == time.begin()) return share.front();
  const auto n = static_cast<std::size_t>(next - time.begin());
  if (n == time.size()) return share.back();
  const double part = (at - time[n - 1]) / (time[n] - time[n - 1]);
  return share[n - 1] + part * (share[n] - share[n - 1]);
}

Container::Container(ContainerPath path, const Mesh& mesh, const std::vector<Vec3>& folded)
    : path_(std::move(path)) {
  if (path_.time.empty() || path_.time.size() != path_.share.size() || path_.share.back() != 1 ||
      !std::is_sorted(path_.time.begin(), path_.time.end()) ||
      !std::is_sorted(path_.share.begin(), path_.share.end()))
    throw Error(ExitCode::usage, "the canopy must leave its container in increasing times, and as a whole");
  double skirt = std::numeric_limits<double>::infinity(), vent = -skirt;
  for (const Patch& patch : mesh.patches) {
    for (int node = patch.first_node; node < patch.first_node + patch.rows * patch.columns; ++node) {
      skirt = std::min(skirt, folded[node].z);
      vent = std::max(vent, folded[node].z);
    }
  }
  for (const Vec3& x : folded) from_skirt_.push_back((x.z - skirt) / (vent - skirt));
}

std::vector<int> Container::guided(double time) const {
  const double outside = path_.outside(time);
  std::vector<int> inside;
  for (std::size_t node = 0; node < from_skirt_.size(); ++node)
    if (from_skirt_[node] > outside) inside.push_back(static_cast<int>(node));
  return inside;
}

}  // namespace ripstop::inline fsi
