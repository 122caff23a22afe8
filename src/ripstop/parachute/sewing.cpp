#include "ripstop/parachute/sewing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ripstop {
namespace {

// Any cross-section of a chain is crossed by one axial and two bending springs: together they are the line's
// law.
struct ChainLaws {
  int axial, bending;
};

ChainLaws add_laws(MeshBuilder& builder, const Line& line) {
  const SpringLaw whole{line.coefficients_n, line.compression};
  const int axial = builder.law(whole.scaled(1 - line.bending_fraction));
  return {axial, builder.law(whole.scaled(0.5 * line.bending_fraction))};
}

void add_riser(MeshBuilder& builder, const Design& design, const Line& riser) {
  Mesh& mesh = builder.mesh;
  if (design.riser.length_m <= 0) {
    mesh.fixed = {mesh.confluence};
    return;
  }
  const int segments = std::max(1, static_cast<int>(design.riser.length_m / design.mesh.line_segment_m));
  const Vec3 confluence = mesh.start[mesh.confluence];
  Path path;
  for (int i = 0; i < segments; ++i) {
    const double below = design.riser.length_m * (1 - double(i) / segments);
    path.nodes.push_back(builder.add_node(confluence - Vec3{0, 0, below}, 0));
  }
  path.nodes.push_back(mesh.confluence);
  path.lengths.assign(segments, design.riser.length_m / segments);
  const ChainLaws laws = add_laws(builder, riser);
  mesh.riser_springs = builder.add_chain(path, riser, laws.axial, laws.bending, builder.part("riser"));
  mesh.fixed = {path.nodes.front()};
}

}  // namespace

Path sew(MeshBuilder& builder, const Path& path, double length, double segment, bool straight) {
  std::vector<double> s(path.nodes.size());
  for (std::size_t i = 1; i < s.size(); ++i) s[i] = s[i - 1] + path.lengths[i - 1];
  std::size_t end = 0;
  while (end + 1 < s.size() && s[end + 1] <= length * (1 + 1e-9)) ++end;
  if (end == 0) return {{path.nodes[0]}, {}};
  std::vector<std::size_t> chosen;
  for (int segments = std::max(1, static_cast<int>(s[end] / segment)); segments >= 1; --segments) {
    chosen.assign(1, 0);
    double shortest = s[end];
    for (int k = 1; k <= segments; ++k) {
      const double target = s[end] * k / segments;
      std::size_t i = chosen.back() + 1;
      while (i < end && std::abs(s[i + 1] - target) < std::abs(s[i] - target)) ++i;
      shortest = std::min(shortest, s[i] - s[chosen.back()]);
      chosen.push_back(i);
      if (i == end) break;
    }
    if (shortest >= 0.95 * segment || segments == 1) break;
  }
  Path sewn{{path.nodes[0]}, {}};
  for (std::size_t k = 1; k < chosen.size(); ++k) {
    const std::size_t from = chosen[k - 1], to = chosen[k];
    for (std::size_t i = from + 1; straight && i < to; ++i) {
      const double weight = (s[i] - s[from]) / (s[to] - s[from]);
      builder.tie(path.nodes[i], {{path.nodes[from], 1 - weight}, {path.nodes[to], weight}});
    }
    sewn.append({{path.nodes[to]}, {}}, s[to] - s[from]);
  }
  return sewn;
}

void add_lines(MeshBuilder& builder, const Design& design, const PartMaterials& materials,
               const std::vector<Path>& sewn) {
  Mesh& mesh = builder.mesh;
  const double length = design.lines.length_m;
  const Line& line = materials.line;
  double confluence_z = -1e300;
  for (const Path& path : sewn) {
    const Vec3 skirt = mesh.start[path.nodes.front()];
    const double radius = std::hypot(skirt.x, skirt.y);
    confluence_z = std::max(confluence_z, skirt.z - std::sqrt(length * length - radius * radius));
  }
  mesh.confluence = builder.add_node({0, 0, confluence_z}, 0);
  const Vec3 confluence = mesh.start[mesh.confluence];
  const ChainLaws laws = add_laws(builder, line);
  const int free_segments = std::max(1, static_cast<int>(length / design.mesh.line_segment_m));
  for (std::size_t k = 0; k < sewn.size(); ++k) {
    const Vec3 skirt = mesh.start[sewn[k].nodes.front()];
    Path path{{mesh.confluence}, {}};
    for (int i = 1; i < free_segments; ++i) {
      const Vec3 place = confluence + (skirt - confluence) * (double(i) / free_segments);
      path.append({{builder.add_node(place, 0)}, {}}, length / free_segments);
    }
    path.append(sewn[k], length / free_segments);
    const int part = builder.part(fmt::format("line {}", k + 1));
    mesh.lines.push_back({static_cast<int>(k), builder.add_chain(path, line, laws.axial, laws.bending, part),
                          free_segments, 1 - line.bending_fraction});
  }
  add_riser(builder, design, materials.riser);
}

void add_vent_lines(MeshBuilder& builder, const PartMaterials& materials, const std::vector<Path>& sewn) {
  const ChainLaws laws = add_laws(builder, materials.line);
  const std::size_t half = sewn.size() / 2;
  for (std::size_t k = 0; k < half; ++k) {
    const int from = sewn[k].nodes.back(), to = sewn[k + half].nodes.back();
    const double span = norm(builder.mesh.start[to] - builder.mesh.start[from]);
    builder.add_chain({{from, to}, {span}}, materials.line, laws.axial, laws.bending,
                      builder.part("vent lines"));
  }
}

}  // namespace ripstop
