#include "ripstop/parachute/sewing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ripstop::inline parachute {
namespace {

/// At least one of at least `segment` [m], but for rounding: 0.6 m has 12 of 0.05 m.
int whole_segments(double length, double segment) {
  return std::max(1, static_cast<int>(length / segment * (1 + 1e-9)));
}

}  // namespace

void CanopyBuilder::set_skirt(int patch) {
  rigging.skirt_nodes = row(patch, 0).nodes;
  rigging.skirt_nodes.pop_back();  // the first again
}

Path CanopyBuilder::radial(const std::vector<int>& patches, int part, int parts) const {
  Path path;
  for (const int index : patches) {
    const Patch& patch = mesh.patches[index];
    path.extend(column(index, patch.columns / parts * part, 0, patch.rows - 1));
  }
  return path;
}

int CanopyBuilder::add_tape_law(const Tape& tape) {
  SpringLaw pulled{tape.coefficients_n_m, tape.compression};
  if (tape.buckling_strain) pulled.buckling_strain = *tape.buckling_strain;
  return law(std::move(pulled));
}

void CanopyBuilder::add_tape(const Path& path, const Tape& tape, int tape_law, int tape_part) {
  const std::vector<int> springs =
      add_springs(path, {tape_law, tape_part, tape.width_m, tape.damping_n_s_m, tape.linear_density_kg_m});
  rigging.tape_springs.insert(rigging.tape_springs.end(), springs.begin(), springs.end());
}

Path CanopyBuilder::sew(const Path& path, double length, double segment, bool straight) {
  std::vector<double> s(path.nodes.size());
  for (std::size_t i = 1; i < s.size(); ++i) s[i] = s[i - 1] + path.lengths[i - 1];
  std::size_t end = 0;
  while (end + 1 < s.size() && s[end + 1] <= length * (1 + 1e-9)) ++end;
  if (end == 0) return {{path.nodes[0]}, {}};
  std::vector<std::size_t> chosen;
  for (int segments = whole_segments(s[end], segment); segments >= 1; --segments) {
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
      tie(path.nodes[i], {{path.nodes[from], 1 - weight}, {path.nodes[to], weight}});
    }
    sewn.append({{path.nodes[to]}, {}}, s[to] - s[from]);
  }
  return sewn;
}

CanopyBuilder::ChainLaws CanopyBuilder::add_laws(const Line& line) {
  const SpringLaw whole{line.coefficients_n, line.compression};
  const int axial = law(whole.scaled(1 - line.bending_fraction));
  return {axial, law(whole.scaled(0.5 * line.bending_fraction))};
}

std::vector<int> CanopyBuilder::add_chain(const Path& path, const Line& line, ChainLaws laws, int line_part) {
  const std::vector<int> axial =
      add_springs(path, {laws.axial, line_part, 1, line.damping_n_s_m, line.linear_density_kg_m});
  for (std::size_t i = 0; i + 2 < path.nodes.size(); ++i) {
    mesh.springs.push_back({path.nodes[i], path.nodes[i + 2], path.lengths[i] + path.lengths[i + 1], 1.0,
                            laws.bending, line.damping_n_s_m, line_part});
  }
  return axial;
}

void CanopyBuilder::add_riser(const Design& design, const Line& riser) {
  if (design.riser.length_m <= 0) {
    mesh.fixed = {rigging.confluence};
    return;
  }
  const int segments = whole_segments(design.riser.length_m, design.mesh.line_segment_m);
  const Vec3 confluence = mesh.start[rigging.confluence];
  Path path;
  for (int i = 0; i < segments; ++i) {
    const double below = design.riser.length_m * (1 - double(i) / segments);
    path.nodes.push_back(add_node(confluence - Vec3{0, 0, below}, 0));
  }
  path.nodes.push_back(rigging.confluence);
  path.lengths.assign(segments, design.riser.length_m / segments);
  rigging.riser_springs = add_chain(path, riser, add_laws(riser), part("riser"));
  mesh.fixed = {path.nodes.front()};
}

void CanopyBuilder::add_line(LineRun line, const std::string& name, double length, const Path& onto,
                             const Design& design, const Line& material, ChainLaws laws) {
  line.free_springs = whole_segments(length, design.mesh.line_segment_m);
  const Vec3 confluence = mesh.start[rigging.confluence], end = mesh.start[onto.nodes.front()];
  Path path{{rigging.confluence}, {}};
  for (int i = 1; i < line.free_springs; ++i) {
    const Vec3 place = confluence + (end - confluence) * (double(i) / line.free_springs);
    path.append({{add_node(place, 0)}, {}}, length / line.free_springs);
  }
  path.append(onto, length / line.free_springs);
  line.springs = add_chain(path, material, laws, part(name));
  line.axial_share = 1 - material.bending_fraction;
  rigging.lines.push_back(std::move(line));
}

void CanopyBuilder::add_lines(const Design& design, const PartMaterials& materials,
                              const std::vector<Path>& sewn, const ApexLines& apex) {
  const double length = design.lines.length_m;
  double confluence_z = -1e300;
  const auto keep_unstretched = [&](int end, double longest) {
    const Vec3 place = mesh.start[end];
    const double radius = std::hypot(place.x, place.y);
    confluence_z = std::max(confluence_z, place.z - std::sqrt(longest * longest - radius * radius));
  };
  for (const Path& path : sewn) keep_unstretched(path.nodes.front(), length);
  for (const int end : apex.ends) keep_unstretched(end, apex.length);
  rigging.confluence = add_node({0, 0, confluence_z}, 0);
  const ChainLaws laws = add_laws(materials.line);
  for (std::size_t k = 0; k < sewn.size(); ++k)
    add_line({.radial = static_cast<int>(k)}, fmt::format("line {}", k + 1), length, sewn[k], design,
             materials.line, laws);
  for (std::size_t k = 0; k < apex.ends.size(); ++k)
    add_line({.radial = static_cast<int>(k), .apex = true}, fmt::format("apex line {}", k + 1), apex.length,
             {{apex.ends[k]}, {}}, design, materials.line, laws);
  add_riser(design, materials.riser);
}

void CanopyBuilder::add_line_along(const Path& path, const Line& material) {
  int suspension_lines = 0;
  for (const LineRun& line : rigging.lines) suspension_lines += line.apex ? 0 : 1;
  LineRun line{.radial = suspension_lines};
  line.springs =
      add_chain(path, material, add_laws(material), part(fmt::format("line {}", suspension_lines + 1)));
  line.free_springs = static_cast<int>(line.springs.size());
  line.axial_share = 1 - material.bending_fraction;
  rigging.lines.push_back(std::move(line));
}

void CanopyBuilder::add_vent_lines(const PartMaterials& materials, const std::vector<Path>& sewn) {
  const ChainLaws laws = add_laws(materials.line);
  const std::size_t half = sewn.size() / 2;
  for (std::size_t k = 0; k < half; ++k) {
    const int from = sewn[k].nodes.back(), to = sewn[k + half].nodes.back();
    const double span = norm(mesh.start[to] - mesh.start[from]);
    const std::vector<int> springs =
        add_chain({{from, to}, {span}}, materials.line, laws, part("vent lines"));
    rigging.vent_line_springs.insert(rigging.vent_line_springs.end(), springs.begin(), springs.end());
  }
}

CanopyMesh CanopyBuilder::finish() {
  flatten_ties();
  return {std::move(mesh), std::move(rigging)};
}

}  // namespace ripstop::inline parachute
