// Measures that are taken from a state at intervals, in plain scalar code.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ripstop/cloth/layout.h"
#include "ripstop/cloth/stability_limit.h"
#include "ripstop/core/error.h"
#include "ripstop/mesh/each_spring.h"

namespace ripstop::inline cloth {
namespace {

double tension_of(const SpringView& s, const std::vector<Vec3>& x) {
  return s.scale * s.law->tension(norm(x[s.b] - x[s.a]) / s.rest_length - 1);
}

double length_round(const std::vector<int>& rings, const std::vector<Vec3>& x) {
  double length = 0;
  for (std::size_t i = 0; i < rings.size(); ++i)
    length += norm(x[rings[(i + 1) % rings.size()]] - x[rings[i]]);
  return length;
}

/// The pull between the ends of every spring, and of every part of the drawstring: visit(a, b, force on a).
template <class Visit>
void each_pull(const Cloth& cloth, const std::vector<Vec3>& x, Visit&& visit) {
  each_spring(cloth.mesh, [&](const SpringView& s) {
    const Vec3 d = x[s.b] - x[s.a];
    visit(s.a, s.b, (tension_of(s, x) / norm(d)) * d);
  });
  if (!cloth.mesh.drawstring) return;
  const Drawstring& string = *cloth.mesh.drawstring;
  const std::vector<int>& rings = string.rings;
  const double tension = string.law.tension(std::max(length_round(rings, x) / string.rest_length - 1, 0.0));
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const int next = rings[(i + 1) % rings.size()];
    const Vec3 d = x[next] - x[rings[i]];
    if (norm(d) > 0) visit(rings[i], next, (tension / norm(d)) * d);
  }
}

std::vector<Vec3> load_on_nodes(const Cloth& cloth, const std::vector<Vec3>& x, const Loads& loads) {
  std::vector<Vec3> force = loads.node_force;
  force.resize(x.size());
  if (!loads.cell_pressure.empty()) {
    for (std::size_t i = 0; i < cloth.cells.size(); ++i) {
      const auto& c = cloth.cells[i].corner;
      if (c[0] < 0) continue;
      const Vec3 each = 0.25 * loads.cell_pressure[i] * area_vector(x[c[0]], x[c[1]], x[c[2]], x[c[3]]);
      for (int corner : c) force[corner] += each;
    }
  }
  return force;
}

}  // namespace

AppliedLoad applied_load(const Cloth& cloth, const ClothState& state, const Loads& loads, Vec3 pivot) {
  const std::vector<Vec3> x = positions(state, cloth);
  std::vector<Vec3> force = load_on_nodes(cloth, x, loads);
  for (const Tie& tie : cloth.mesh.ties) {
    for (const auto& master : tie.masters) force[master.node] += master.weight * force[tie.node];
    force[tie.node] = {};
  }
  for (int node : cloth.mesh.fixed) force[node] = {};
  AppliedLoad load;
  for (std::size_t node = 0; node < force.size(); ++node) {
    load.norm += dot(force[node], force[node]);
    load.sum += norm(force[node]);
    load.moment += cross(x[node] - pivot, force[node]);
  }
  load.norm = std::sqrt(load.norm);
  return load;
}

std::vector<double> spring_tensions(const Cloth& cloth, const ClothState& state) {
  const std::vector<Vec3> x = positions(state, cloth);
  std::vector<double> tension(cloth.mesh.springs.size());
  each_spring(cloth.mesh, [&](const SpringView& s) {
    if (s.index >= 0) tension[s.index] = tension_of(s, x);
  });
  return tension;
}

double drawn_length(const Cloth& cloth, const ClothState& state) {
  return cloth.mesh.drawstring ? length_round(cloth.mesh.drawstring->rings, positions(state, cloth)) : 0;
}

std::vector<Vec3> tie_forces(const Cloth& cloth, const ClothState& state) {
  const std::vector<Vec3> x = positions(state, cloth);
  std::vector<Vec3> on_node(x.size());
  each_pull(cloth, x, [&](int a, int b, Vec3 pull) {
    on_node[a] += pull;
    on_node[b] -= pull;
  });
  std::vector<Vec3> result;
  for (const Tie& tie : cloth.mesh.ties) result.push_back(on_node[tie.node]);
  return result;
}

Vec3 force_on(const Cloth& cloth, const ClothState& state, const std::vector<int>& fixed_nodes) {
  const std::vector<Vec3> x = positions(state, cloth);
  // Share of the force on a node that reaches these nodes: all of its own, the weights of a tied one's.
  std::vector<double> share(x.size(), 0.0);
  for (int node : fixed_nodes) {
    if (node < 0 || node >= cloth.mesh.node_count() || !cloth.is_fixed[node])
      throw Error(ExitCode::bad_data, fmt::format("cloth: node {} is not fixed", node));
    share[node] = 1;
  }
  const std::vector<double> own = share;
  for (const Tie& tie : cloth.mesh.ties)
    for (const auto& master : tie.masters) share[tie.node] += master.weight * own[master.node];
  Vec3 sum;
  each_pull(cloth, x, [&](int a, int b, Vec3 pull) {
    if (share[a] != share[b]) sum += (share[a] - share[b]) * pull;
  });
  return sum;
}

Vec3 force_on_fixed(const Cloth& cloth, const ClothState& state) {
  return force_on(cloth, state, cloth.mesh.fixed);
}

Vec3 pressure_force(const Cloth& cloth, const ClothState& state, const Loads& loads) {
  Vec3 sum;
  for (Vec3 f : load_on_nodes(cloth, positions(state, cloth), {loads.cell_pressure, {}})) sum += f;
  return sum;
}

double elastic_energy(const Cloth& cloth, const ClothState& state) {
  const std::vector<Vec3> x = positions(state, cloth);
  double sum = 0;
  each_spring(cloth.mesh, [&](const SpringView& s) {
    sum += s.scale * s.rest_length * s.law->energy(norm(x[s.b] - x[s.a]) / s.rest_length - 1);
  });
  if (const auto& string = cloth.mesh.drawstring) {
    const double strain = drawn_length(cloth, state) / string->rest_length - 1;
    sum += string->rest_length * string->law.energy(std::max(strain, 0.0));
  }
  return sum + contact_report(cloth, state).energy;
}

double kinetic_energy(const Cloth& cloth, const ClothState& state) {
  double sum = 0;
  for (int node = 0; node < cloth.mesh.node_count(); ++node) {
    const Vec3 v = get(state.v.data(), cloth.slot[node]);
    sum += 0.5 * cloth.total_mass[node] * dot(v, v);
  }
  return sum;
}

Vec3 momentum(const Cloth& cloth, const ClothState& state) {
  Vec3 sum;
  for (int node = 0; node < cloth.mesh.node_count(); ++node)
    sum += cloth.total_mass[node] * get(state.v.data(), cloth.slot[node]);
  return sum;
}

}  // namespace ripstop::inline cloth
