#include "ripstop/parachute/hang.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "ripstop/core/error.h"
#include "ripstop/core/quantity_error.h"

namespace ripstop::inline parachute {

double LineLink::length() const {
  return std::accumulate(lengths.begin(), lengths.end(), 0.0);
}

std::vector<LineLink> line_links(const CanopyMesh& mesh, const std::vector<int>& piece) {
  std::vector<LineLink> links;
  for (const LineRun& line : mesh.rigging.lines) {
    LineLink link{mesh.rigging.confluence, -1, {mesh.rigging.confluence}, {}};
    for (const int s : line.springs) {
      const Spring& spring = mesh.springs[s];
      const int next = spring.a == link.nodes.back() ? spring.b : spring.a;
      link.nodes.push_back(next);
      link.lengths.push_back(spring.rest_length);
      if (piece[next] < 0) continue;
      link.to = next;
      if (link.from == mesh.rigging.confluence || piece[link.from] != piece[next]) links.push_back(link);
      link = {next, -1, {next}, {}};
    }
  }
  return links;
}

double free_way(const LineLink& link, const CanopyMesh& mesh, const std::vector<Vec3>& x, double slack) {
  const double length = link.length() - (link.from == mesh.rigging.confluence ? slack : 0.0);
  const Vec3 from = x[link.from], to = x[link.to];
  const double lateral = std::hypot(to.x - from.x, to.y - from.y);
  if (!(length > lateral)) {
    throw QuantityError(ExitCode::usage,
                        fmt::format("slack of the lines = {}: a line of {:.4g} m does not reach from the "
                                    "confluence to the folded skirt at {:.4g} m from the axis",
                                    slack, link.length(), lateral),
                        {"slack of the lines"});
  }
  return from.z + std::sqrt(length * length - lateral * lateral) - to.z;
}

// The distance that an arc of curvature k spans is D = (2 / k) sin(sum asin(l_i k / 2)).
void hang(const LineLink& link, std::vector<Vec3>& x) {
  const Vec3 from = x[link.from], to = x[link.to];
  const double distance = norm(to - from), length = link.length();
  if (link.nodes.size() < 3) return;
  const Vec3 way = (to - from) / distance;
  const auto half_angle = [&](double curvature) {
    double sum = 0;
    for (const double l : link.lengths) sum += std::asin(std::min(1.0, 0.5 * l * curvature));
    return sum;
  };
  double low = 0, high = 2 / *std::max_element(link.lengths.begin(), link.lengths.end());
  if (length > distance * (1 + 1e-12)) {
    for (int i = 0; i < 200; ++i) {
      const double k = 0.5 * (low + high);
      const double half = half_angle(k);
      (half < std::numbers::pi && 2 / k * std::sin(half) > distance ? low : high) = k;
    }
  }
  const double curvature = low, half = half_angle(curvature);
  const double azimuth = std::atan2(to.y, to.x);
  const Vec3 outward{std::cos(azimuth), std::sin(azimuth), 0};
  const Vec3 across = outward - dot(outward, way) * way;
  const Vec3 side = across / norm(across);
  double turned = -half;  // angle on the circle, from the middle of the arc
  Vec3 p = from;
  for (std::size_t i = 0; i + 2 < link.nodes.size(); ++i) {
    const double step = 2 * std::asin(std::min(1.0, 0.5 * link.lengths[i] * curvature));
    // A segment points along the circle's tangent at its middle.
    const double tangent = turned + 0.5 * step;
    const double l = curvature > 0 ? link.lengths[i] : link.lengths[i] * distance / length;
    p += l * (std::cos(tangent) * way - std::sin(tangent) * side);
    turned += step;
    x[link.nodes[i + 1]] = p;
  }
}

}  // namespace ripstop::inline parachute
