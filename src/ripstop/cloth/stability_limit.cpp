#include "ripstop/cloth/stability_limit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "ripstop/cloth/contact.h"
#include "ripstop/core/error.h"
#include "ripstop/mesh/each_spring.h"

namespace ripstop::inline cloth {
namespace {

/// A drawstring shorter than this by its strain is not pulled before the bound is looked at again.
constexpr double far_from_taut = -0.5;

// along n n^T + across (I - n n^T)
void add(Symmetric& sum, double along, double across, Vec3 n) {
  const double d = along - across;
  sum[0] += across + d * n.x * n.x;
  sum[1] += across + d * n.y * n.y;
  sum[2] += across + d * n.z * n.z;
  sum[3] += d * n.x * n.y;
  sum[4] += d * n.x * n.z;
  sum[5] += d * n.y * n.z;
}

// Largest root of the characteristic polynomial in trigonometric form.
double largest_eigenvalue(const Symmetric& a) {
  const double mean = (a[0] + a[1] + a[2]) / 3;
  const double off = a[3] * a[3] + a[4] * a[4] + a[5] * a[5];
  const double x = a[0] - mean, y = a[1] - mean, z = a[2] - mean;
  const double p = std::sqrt((x * x + y * y + z * z + 2 * off) / 6);
  if (!(p > 1e-14 * std::abs(mean))) return mean + p;
  const double determinant =
      x * (y * z - a[5] * a[5]) - a[3] * (a[3] * z - a[5] * a[4]) + a[4] * (a[3] * a[5] - y * a[4]);
  const double r = std::clamp(determinant / (2 * p * p * p), -1.0, 1.0);
  return mean + 2 * p * std::cos(std::acos(r) / 3);
}

void hand_to_masters(const Mesh& mesh, std::vector<Symmetric>& blocks) {
  for (const Tie& tie : mesh.ties)
    for (const auto& master : tie.masters)
      for (int i = 0; i < 6; ++i) blocks[master.node][i] += master.weight * blocks[tie.node][i];
}

}  // namespace

void node_blocks(const Cloth& cloth, const ClothState& state, double floor, ThreadTeam& team,
                 std::vector<Symmetric>& blocks) {
  const Mesh& mesh = cloth.mesh;
  blocks.resize(mesh.node_count());
  const auto at_node = [&](int node) { return get(state.x.data(), cloth.slot[node]); };
  // To its ends among the nodes [first, last).
  const auto add_spring = [&](const SpringView& s, int first, int last) {
    const auto among = [&](int end) { return first <= end && end < last; };
    if (!among(s.a) && !among(s.b)) return;
    const Vec3 d = at_node(s.b) - at_node(s.a);
    const double length = norm(d);
    const double pulled = std::max(length / s.rest_length - 1, 0.0);
    const Vec3 n = length > 0 ? d / length : Vec3{1, 0, 0};
    const double along = s.scale * std::max(s.law->tangent(pulled), 0.0) / s.rest_length;
    const double across =
        length > 0 ? std::max(floor * along, s.scale * s.law->tension(pulled) / length) : along;
    for (const int end : {s.a, s.b})
      if (among(end)) add(blocks[end], along, across, n);
  };
  // A thread also computes the springs of the rows before its own: every node has its sum in one order.
  team.run([&](int rank) {
    const IndexRange nodes = part_of(mesh.node_count(), rank, team.size());
    std::fill(blocks.begin() + nodes.begin, blocks.begin() + nodes.end, Symmetric{});
    team.barrier();
    for (int p = 0; p < static_cast<int>(mesh.patches.size()); ++p) {
      const Patch& patch = mesh.patches[p];
      const IndexRange rows = part_of(patch.rows, rank, team.size());
      each_spring_of_rows(mesh, p, std::max(0, rows.begin - ghosts), rows.end, [&](const SpringView& s) {
        add_spring(s, patch.node(rows.begin, 0), patch.node(rows.end, 0));
      });
    }
    team.barrier();
    each_irregular_spring(mesh, [&](const SpringView& s) { add_spring(s, nodes.begin, nodes.end); });
  });
  hand_to_masters(mesh, blocks);
}

// With u_i the gradient of the length at ring i, K = k u u^T + T sum 1/l (I - n n^T) over its parts, and
//   k (sum u_i . x_i)^2 <= k sum |u_j| sum |u_i| |x_i|^2     (Cauchy and Schwarz, weights |u_i|),
//   T/l |x_i - x_j|^2 <= 2 T/l (|x_i|^2 + |x_j|^2).
StringShares string_shares(const Cloth& cloth, const ClothState& state) {
  StringShares shares;
  const Mesh& mesh = cloth.mesh;
  if (!mesh.drawstring) return shares;
  const Drawstring& string = *mesh.drawstring;
  shares.stiffness.assign(mesh.node_count(), 0.0);
  shares.damping.assign(mesh.node_count(), 0.0);
  const double strain = drawn_length(cloth, state) / string.rest_length - 1;
  if (strain < far_from_taut) return shares;
  const double k = string.law.tangent(std::max(strain, 0.0)) / string.rest_length;
  const double tension = string.law.tension(std::max(strain, 0.0));
  const std::size_t count = string.rings.size();
  std::vector<Vec3> gradient(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % count;
    const Vec3 d = get(state.x.data(), cloth.rings[next]) - get(state.x.data(), cloth.rings[i]);
    const double length = norm(d);
    if (!(length > 0)) continue;
    gradient[i] -= d / length;
    gradient[next] += d / length;
    for (const std::size_t end : {i, next}) shares.stiffness[string.rings[end]] += 2 * tension / length;
  }
  double sum = 0;
  for (const Vec3 u : gradient) sum += norm(u);
  for (std::size_t i = 0; i < count; ++i) {
    shares.stiffness[string.rings[i]] += k * norm(gradient[i]) * sum;
    shares.damping[string.rings[i]] += string.damping * norm(gradient[i]) * sum;
  }
  for (const Tie& tie : mesh.ties)
    for (const auto& master : tie.masters)
      for (std::vector<double>* share : {&shares.stiffness, &shares.damping})
        (*share)[master.node] += master.weight * (*share)[tie.node];
  return shares;
}

NodeStiffness node_stiffness(const Cloth& cloth, const ClothState& state) {
  const Mesh& mesh = cloth.mesh;
  const int count = mesh.node_count();
  const std::vector<Vec3> x = positions(state, cloth);
  std::vector<Symmetric> stiffness(count, Symmetric{}), damping;
  NodeStiffness result;
  each_spring(mesh, [&](const SpringView& s) {
    const Vec3 d = x[s.b] - x[s.a];
    const double length = norm(d);
    const double strain = length / s.rest_length - 1;
    if (!(strain <= result.largest_strain)) result.largest_strain = strain, result.stretched_node = s.a;
    const Vec3 n = length > 0 ? d / length : Vec3{1, 0, 0};
    // A slack or pushed spring may be pulled within the next steps: it counts as when first pulled.
    const double tangent = std::max(s.law->tangent(strain), strain < 0 ? s.law->tangent(0) : 0.0);
    const double along = s.scale * tangent / s.rest_length;
    const double across = length > 0 ? std::max(0.0, s.scale * s.law->tension(strain) / length) : along;
    add(stiffness[s.a], along, across, n);
    add(stiffness[s.b], along, across, n);
    if (s.damping == 0) return;
    if (damping.empty()) damping.assign(count, Symmetric{});
    add(damping[s.a], s.damping, 0, n);
    add(damping[s.b], s.damping, 0, n);
  });
  hand_to_masters(mesh, stiffness);
  result.stiffness.resize(count);
  for (int node = 0; node < count; ++node) result.stiffness[node] = largest_eigenvalue(stiffness[node]);
  result.damping.assign(count, 0.0);
  if (!damping.empty()) {
    hand_to_masters(mesh, damping);
    for (int node = 0; node < count; ++node) result.damping[node] = largest_eigenvalue(damping[node]);
  }
  result.string = string_shares(cloth, state);
  return result;
}

// With s_i an upper bound on lambda_max of node i's block of A = K dt^2 + 2 C dt over m_i, and
// t_s = s_j / s_i,
//   x^T A x = sum_s a_s (n . (x_i - x_j))^2 <= sum_s a_s [(1 + t_s) (n . x_i)^2 + (1 + 1/t_s) (n . x_j)^2]
//           <= max_s (s_i + s_j)  x^T M x:
// a block form of Gershgorin's circles that no rotation of the cloth changes. Here s_i = rho_i dt^2 + 2 c_i
// dt. A tied end has (n . x)^2 <= sum w (n . x_master)^2 (Jensen), so its block goes to its masters and its s
// is the largest of theirs; a fixed end has none. With the absolute damping c_a,
//   (rho_i + rho_j) dt^2 + 2 (c_i + c_j + c_a) dt < 4
// for every spring (plus the part of a drawstring at either end, already a sum over its nodes) keeps both
// roots of every mode of semi-implicit Euler inside the unit circle. The stiffness of the pressure is neglected: a few
// hundred pascal against 1e4 N/m over a cell of millimetres. Contacts act in kicks of their own length, which is a step
// at least.
StabilityLimit stability_limit(const Cloth& cloth, const ClothState& state) {
  return stability_limit(cloth, state, node_stiffness(cloth, state));
}

StabilityLimit stability_limit(const Cloth& cloth, const ClothState& state, const NodeStiffness& node) {
  const Mesh& mesh = cloth.mesh;
  const int count = mesh.node_count();
  std::vector<double> rho(count, 0.0), rate(count, 0.0), area = cloth.area;
  std::vector<double> string_rho(count, 0.0), string_rate(count, 0.0);
  for (int i = 0; i < count; ++i) {
    if (cloth.is_tied[i] || cloth.is_fixed[i]) continue;
    rho[i] = node.stiffness[i] / cloth.total_mass[i];
    rate[i] = node.damping[i] / cloth.total_mass[i];
    if (node.string.stiffness.empty()) continue;
    string_rho[i] = node.string.stiffness[i] / cloth.total_mass[i];
    string_rate[i] = node.string.damping[i] / cloth.total_mass[i];
  }
  std::vector<int> tie_of(count, -1);
  for (std::size_t t = 0; t < mesh.ties.size(); ++t) {
    tie_of[mesh.ties[t].node] = static_cast<int>(t);
    for (const auto& master : mesh.ties[t].masters)
      area[master.node] += master.weight * area[mesh.ties[t].node];
  }
  double fastest = 0, absolute = 0;
  if (cloth.options.quadratic_damping > 0)
    for (const Vec3 v : velocities(state, cloth)) fastest = std::max(fastest, norm(v));
  const double per_area = cloth.options.absolute_damping + cloth.options.quadratic_damping * fastest;
  for (int i = 0; i < count; ++i)
    if (!cloth.is_tied[i] && !cloth.is_fixed[i])
      absolute = std::max(absolute, per_area * area[i] / cloth.total_mass[i]);

  StabilityLimit limit;
  limit.stable_step = limit.printed_step = std::numeric_limits<double>::infinity();
  // The positive root of omega^2 dt^2 + 2 c dt - 4, in the form that does not cancel; whether it is the least yet.
  const auto allow = [&](double omega2, double c) {
    if (omega2 <= 0 && c <= 0) return false;
    double step = 4 / (c + std::sqrt(c * c + 4 * omega2));
    if (!(step > 0)) step = 0;  // a stiffness that is not finite
    if (step >= limit.stable_step) return false;
    limit.stable_step = step;
    return true;
  };
  const auto look_at = [&](int a, int b) {
    const double omega2 = rho[a] + rho[b] + std::max(string_rho[a], string_rho[b]);
    const double c = rate[a] + rate[b] + std::max(string_rate[a], string_rate[b]) + absolute;
    if (!allow(omega2, c)) return;
    const double step = limit.stable_step;
    limit.node = rho[a] + rate[a] / step > rho[b] + rate[b] / step ? a : b;
  };
  const auto with_masters = [&](int end, const auto& visit) {
    if (tie_of[end] < 0) return visit(end);
    for (const auto& master : mesh.ties[tie_of[end]].masters) visit(master.node);
  };
  each_spring(mesh, [&](const SpringView& s) {
    with_masters(s.a, [&](int a) { with_masters(s.b, [&](int b) { look_at(a, b); }); });
    // The paper's ingredients: one spring K_1 w / L0 against one lumped mass, no neighbours.
    const double mass = std::min(cloth.total_mass[s.a] > 0 ? cloth.total_mass[s.a] : mesh.mass[s.a],
                                 cloth.total_mass[s.b] > 0 ? cloth.total_mass[s.b] : mesh.mass[s.b]);
    const double stiffness = s.scale * s.law->tangent(0) / s.rest_length;
    if (stiffness > 0 && mass > 0)
      limit.printed_step = std::min(limit.printed_step, std::sqrt(mass / stiffness));
  });
  for (int i = 0; i < count; ++i)  // rings without any other connection
    if (string_rho[i] > 0 && allow(string_rho[i], string_rate[i] + absolute)) limit.node = i;
  if (limit.node >= 0) limit.part = place_of(mesh, limit.node);
  if (cloth.contact && allow(std::pow(2 * cloth.contact->fastest, 2), 0)) limit.part = "contact of cloth";
  return limit;
}

void check_health(const Cloth& cloth, const ClothState& state) {
  double sum = 0;
  for (double x : state.x) sum += 0 * x;
  if (sum == 0) return;
  for (int node = 0; node < cloth.mesh.node_count(); ++node)
    if (!is_finite(get(state.x.data(), cloth.slot[node])))
      throw Error(ExitCode::diverged,
                  fmt::format("step {} (t = {:.6g} s): node {} ({}) has no finite position: the motion has "
                              "diverged; try a smaller time step, more damping or lower loads",
                              state.steps, state.time, node, place_of(cloth.mesh, node)));
}

}  // namespace ripstop::inline cloth
