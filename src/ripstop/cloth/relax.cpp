// Equilibrium by dynamic relaxation with kinetic damping (Barnes 1999, Int. J. Space Structures 14).
//
// A node's fictitious mass is a tensor, half its block of the stiffness (node_blocks) with a margin: a step of 1 is
// then stable everywhere, since x^T K x <= 2 sum x_i^T K_ii x_i. Cloth and lines are stretched by parts of a thousand,
// so across a thread a node is a thousand times easier to move than along it, and moves as fast as possible in both.
// Whenever the kinetic energy passes a peak, that is when sum f . (v + v') turns negative, all velocities are set to 0.
//
// Stops alone remove the slowest mode and may leave its overtones unchanged (in a bar pulled at its ends, a fraction
// cos(n pi / 2) of them remains after each stop). Between stops the motion is therefore also damped at the rate 3 / t
// of Nesterov's accelerated descent, t steps since the stop, which decays before it slows the slow modes:
//   v' = t / (t + 3) v + (t + 3/2) / (t + 3) f / m
// is leapfrog with implicit damping, stable for the same masses, and starts from rest with half a kick.
//
// A wave as long as the canopy hardly stretches a spring, and yet every node in it is as heavy as its springs are
// stiff. Cloth that wrinkles therefore moves also in blocks (blocks.h), which are as heavy as the springs that leave
// them: with the nodes' masses M and the blocks' bound C, x^T K x <= 2 sum x_i^T K_ii x_i and <= y^T C y, a step of 1
// is stable for
//   v' = keep v + kick (share W f + (1 - share) I C'^-1 I^T f),    C' = C / 4 with the same margin.
//
// Far from equilibrium the sector predictor solves half a gore first (sector.h): nodes in its planes have masses and
// residuals along their free directions.
//
// A parachute is attached at one point and can rotate about it. Under a follower pressure this rotation is neutrally
// stable: a small moment of a wrinkled shape would rotate it without end. The moment of the loads about that point is
// therefore cancelled by the smallest node forces, and the rotation is removed from the velocities.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

#include "ripstop/cloth/forces.h"
#include "ripstop/cloth/pivot.h"
#include "ripstop/cloth/relaxation_step.h"
#include "ripstop/cloth/sector.h"
#include "ripstop/cloth/stability_limit.h"
#include "ripstop/cloth/symmetric.h"
#include "ripstop/cloth/watched_relaxation.h"
#include "ripstop/core/error.h"
#include "ripstop/mesh/each_spring.h"

namespace ripstop::inline cloth {
namespace {

constexpr double margin = 1.2;            // on the masses, for stiffening between two refreshes
constexpr double nodes_share = 0.8;       // of the motion, the rest is the blocks'
constexpr int least_nodes = 500;          // of cloth that has blocks: small ones have no long waves
constexpr int steps_between_checks = 50;  // between checks of the applied load and the report
// Steps between two refreshes of the masses: they follow closely while the cloth is far from equilibrium.
// Tape stiffens tenfold at strains that a wild start (sails with fullness, gathered cloth) or the jerk of
// lines that come taut makes within a few steps. Steps that run away are taken back where cloth wrinkles.
int steps_a_refresh(const RelaxResult& result, bool wrinkles) {
  if (result.steps < 500) return wrinkles ? 25 : 5;
  return result.residual > 1 ? steps_between_checks : 400;
}

/// The floor of node_blocks(): how much lighter a node is across its springs than along them. A node that moves far
/// in few steps turns its springs, and the masses of before are too light then.
struct Lightness {
  double floor = 0.2, least = 0.02, daring = 0.9;
  Lightness(bool wrinkles, bool blocks) {
    if (!wrinkles) floor = least = 1;
    if (blocks) least = 0.005, daring = 0.8;
  }
  void dare() { floor = std::max(least, daring * floor); }
  bool shy() {
    if (floor >= 1) return false;
    floor = std::min(1.0, 4 * floor);
    least = std::max(least, 0.4 * floor);
    return true;
  }
};
constexpr double runaway_speed = 0.2;  // of the shortest spring, a step

struct Masses {
  std::vector<Symmetric> mass;  // by node; 0: does not move
  FictitiousMasses fictitious;
};

// Cloth that carries compression has many equilibria close together, and the path decides between them. The
// path is that of the printed lattice, with equal masses along all directions and no soft start.
bool wrinkles(const Mesh& mesh) {
  return std::any_of(mesh.patches.begin(), mesh.patches.end(), [](const Patch& patch) {
    return std::any_of(std::begin(patch.law), std::end(patch.law),
                       [](const SpringLaw& law) { return law.buckling_strain < 1; });
  });
}

// Isotropic stiffness of the regularisation and the drawstring, by node [N/m]: x^T K x <= sum k |x_i|^2.
std::vector<double> round_stiffness(const Cloth& cloth, const ClothState& state, double regularisation) {
  std::vector<double> stiffness(cloth.mesh.node_count(), 0.0);
  if (regularisation > 0) {
    for (int node = 0; node < cloth.mesh.node_count(); ++node)
      stiffness[node] = 2 * regularisation * cloth.area[node];
    for (const Tie& tie : cloth.mesh.ties)
      for (const auto& master : tie.masters)
        stiffness[master.node] += 2 * master.weight * regularisation * cloth.area[tie.node];
  }
  if (const StringShares string = string_shares(cloth, state); !string.stiffness.empty())
    for (int node = 0; node < cloth.mesh.node_count(); ++node) stiffness[node] += string.stiffness[node];
  return stiffness;
}

/// `share` of the motion is that of the nodes by themselves.
void set_fictitious_masses(Masses& masses, const Cloth& cloth, const ClothState& state, double floor,
                           const std::vector<double>& round, double share, ThreadTeam& team) {
  const std::vector<Symmetric>& freedom = masses.fictitious.freedom;
  if (wrinkles(cloth.mesh)) {
    node_blocks(cloth, state, floor, team, masses.mass);
  } else {
    masses.mass.clear();
    for (const double k : node_stiffness(cloth, state).stiffness) masses.mass.push_back({k, k, k, 0, 0, 0});
  }
  for (int node : cloth.mesh.fixed) masses.mass[node] = {};
  for (const Tie& tie : cloth.mesh.ties) masses.mass[tie.node] = {};
  masses.fictitious.inverse.resize(masses.mass.size());
  team.run([&](int rank) {
    const IndexRange nodes = part_of(cloth.mesh.node_count(), rank, team.size());
    for (int node = nodes.begin; node < nodes.end; ++node) {
      Symmetric& mass = masses.mass[node];
      if (!cloth.is_fixed[node] && !cloth.is_tied[node])
        for (int i = 0; i < 3; ++i) mass[i] += 0.5 * round[node];
      for (double& component : mass) component *= 0.5 * margin / share;
      Symmetric& inverse = masses.fictitious.inverse[node];
      if (freedom.empty())
        inverse = inverse_of(mass);
      else
        inverse = within(freedom[node], inverse_of(held_beside(freedom[node], mass)));
    }
  });
}

double fictitious_energy(const Cloth& cloth, const ClothState& state, const std::vector<Symmetric>& mass) {
  double sum = 0;
  for (std::size_t node = 0; node < mass.size(); ++node) {
    const Vec3 v = get(state.v.data(), cloth.slot[node]);
    sum += 0.5 * dot(v, mass[node] * v);
  }
  return sum;
}

double shortest_spring(const Mesh& mesh) {
  double shortest = std::numeric_limits<double>::infinity();
  each_spring(mesh, [&](const SpringView& s) { shortest = std::min(shortest, s.rest_length); });
  return shortest;
}

void undo_last_move(ClothState& state, const Cloth& cloth) {
  for (std::size_t i = 0; i < state.x.size(); ++i) state.x[i] -= state.v[i];
  follow(cloth, state.x.data(), 0, cloth.row_count, true);
  mirror(cloth, state.x.data(), 0, cloth.row_count);
}

double mean_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0;
  for (std::size_t node = 0; node < a.size(); ++node) sum += norm(a[node] - b[node]);
  return sum / static_cast<double>(a.size());
}

/// Dynamic relaxation of one cloth, its steps and looks.
class Relaxation {
 public:
  /// Held, if so, toward `start`; of a sector with its `freedom`.
  Relaxation(ClothState& state, const Cloth& cloth, const Loads& loads, const RelaxOptions& options,
             ThreadTeam& team, const ClothState& start, const std::vector<Symmetric>& freedom = {})
      : state_(state),
        cloth_(cloth),
        loads_(loads),
        options_(options),
        team_(team),
        wrinkles_(wrinkles(cloth.mesh)),
        freedom_(freedom),
        blocks_(has_blocks() ? std::optional<Blocks>(std::in_place, cloth, restricted()) : std::nullopt),
        lightness_(wrinkles_, blocks_.has_value()),
        masses_(first_masses()),
        forces_(cloth, loads, false, team.size()),
        step_(cloth, forces_, state, masses_.fictitious),
        pivot_(freedom.empty() ? pivot_of(cloth, state) : std::nullopt),
        runaway_(runaway_speed * shortest_spring(cloth.mesh)),
        good_(state) {
    if (options.regularisation > 0) forces_.regularise(options.regularisation, start.x);
    if (blocks_) step_.set_blocks(&*blocks_);
    stop();
  }

  RelaxResult run(const RelaxWatch& watch) {
    while (!result_.converged && result_.steps < options_.max_steps) {
      const int refresh_after = steps_a_refresh(result_, wrinkles_);
      const int count = std::min({steps_between_checks, refresh_after, options_.max_steps - result_.steps});
      since_refresh_ += take_steps(count, applied());
      if (runs_away()) {
        if (lightness_.shy()) {
          start_again();
          continue;
        }
        check_health(cloth_, state_);
      }
      // With blocks a momentum is none of the nodes' masses alone: theirs taken out would turn the cloth. A moment that
      // is cancelled turns nothing.
      if (pivot_ && !result_.converged && !blocks_) stop_turning(cloth_, state_, masses_.mass, *pivot_);
      keep();
      if (watch)
        watch({result_.steps, result_.residual, fictitious_energy(cloth_, state_, masses_.mass)},
              [this] { return positions(state_, cloth_); });
      if (since_refresh_ < refresh_after || result_.converged) continue;
      lightness_.dare();
      refresh();
    }
    if (result_.converged) undo_last_move(state_, cloth_);  // the residual is that of the positions before it
    std::fill(state_.v.begin(), state_.v.end(), 0.0);
    return result_;
  }

 private:
  /// The norm that residuals are compared with [N]; cancels the moment about a lone held point.
  double applied() {
    const AppliedLoad load = applied_load(cloth_, state_, loads_, pivot_.value_or(Vec3{}));
    if (pivot_) {
      std::vector<Vec3> force = loads_.node_force;
      cancel_moment(cloth_, state_, load.moment, *pivot_, force);
      forces_.set_node_force(force);
      result_.unbalanced_moment = norm(load.moment);
    }
    return std::max(load.norm, options_.least_load);
  }

  int take_steps(int count, double scale) {
    int done = 0;
    team_.run([&](int rank) {
      for (int i = 0; i < count; ++i) {
        step_.move_rows(rank);
        team_.barrier();
        step_.move_irregular_nodes(rank);
        team_.barrier();
        RowSums sums = step_.sums();
        const double residual = std::sqrt(sums.force_squared) / scale;
        const bool ends = residual <= options_.tolerance;
        if (blocks_ && !ends) {
          step_.gather_blocks(rank);
          team_.barrier();
          step_.solve_blocks(rank);
          team_.barrier();
          sums.power += step_.move_blocks(rank);
          team_.barrier();  // tied nodes follow other ranks' rows
        }
        if (sums.power < 0 && !ends) {
          step_.stop(rank);
          team_.barrier();  // tied nodes take the velocities of other ranks' rows
        }
        forces_.follow_masters(rank, state_);
        if (rank == 0) {
          ++done;
          result_.residual = residual;
          result_.converged = ends;
        }
        team_.barrier();
        if (ends) break;
      }
    });
    result_.steps += done;
    return done;
  }

  void stop() {
    std::fill(state_.v.begin(), state_.v.end(), 0.0);
    for (int rank = 0; rank < team_.size(); ++rank) step_.stop(rank);
  }
  /// A look at the residual needs none.
  bool has_blocks() const {
    return wrinkles_ && !cloth_.mesh.fixed.empty() && cloth_.mesh.node_count() >= least_nodes &&
           options_.max_steps > 1;
  }
  std::vector<char> restricted() const {
    std::vector<char> result;
    for (const Symmetric& p : freedom_) result.push_back(p[0] + p[1] + p[2] < 2.5);
    return result;
  }
  void set_masses(Masses& masses) {
    const std::vector<double> round = round_stiffness(cloth_, state_, options_.regularisation);
    if (blocks_) blocks_->set_stiffness(cloth_, state_, round, (1 - nodes_share) / (0.25 * margin), team_);
    set_fictitious_masses(masses, cloth_, state_, lightness_.floor, round, blocks_ ? nodes_share : 1, team_);
  }
  Masses first_masses() {
    Masses masses;
    masses.fictitious.freedom = freedom_;
    set_masses(masses);
    return masses;
  }
  void refresh() {
    since_refresh_ = 0;
    set_masses(masses_);
    step_.set_masses(masses_.fictitious);
  }
  bool runs_away() {
    std::atomic<bool> runs = false;
    team_.run([&](int rank) {
      const IndexRange mine = part_of(static_cast<int>(state_.v.size()), rank, team_.size());
      bool fast = false;
      for (int i = mine.begin; i < mine.end; ++i) fast |= !(std::abs(state_.v[i]) <= runaway_);
      if (fast) runs = true;
    });
    return runs;
  }
  void keep() {
    team_.run([&](int rank) {
      const IndexRange mine = part_of(static_cast<int>(state_.v.size()), rank, team_.size());
      std::copy(state_.x.begin() + mine.begin, state_.x.begin() + mine.end, good_.x.begin() + mine.begin);
      std::copy(state_.v.begin() + mine.begin, state_.v.begin() + mine.end, good_.v.begin() + mine.begin);
    });
  }
  void start_again() {
    state_ = good_;
    result_.converged = false;
    stop();
    refresh();
  }

  ClothState& state_;
  const Cloth& cloth_;
  const Loads& loads_;
  const RelaxOptions& options_;
  ThreadTeam& team_;
  bool wrinkles_;
  std::vector<Symmetric> freedom_;
  std::optional<Blocks> blocks_;
  Lightness lightness_;
  Masses masses_;
  Forces forces_;
  RelaxationStep step_;
  std::optional<Vec3> pivot_;
  double runaway_;
  ClothState good_;  // positions and velocities as they were after the last steps that did not run away
  RelaxResult result_;
  int since_refresh_ = 0;
};

// A flat canopy far from its inflated shape approaches it with cloth and lines so soft that they are
// stretched by about `strain` under any load: the number of steps grows with the square root of stiffness
// over tension. Lines and tape, in newtons, share the load; the numbers affect only the path.
constexpr double soft_strains[] = {0.1, 0.02, 0.004};
constexpr double soft_tolerance = 3e-3;
constexpr int soft_steps = 3000;
constexpr double far_residual = 0.5;
constexpr double share_of_width = 4, share_of_springs = 12;

/// Absent where nothing is stiffer than that. `images` of the mesh make up the canopy that carries `load`.
std::optional<Mesh> softened(const Mesh& mesh, double load, double strain, int images) {
  std::optional<Mesh> soft = mesh;
  double least = 1;
  double area = 0;
  for (const Patch& patch : mesh.patches)
    area += images * std::accumulate(patch.cell_area.begin(), patch.cell_area.end(), 0.0);
  for (Patch& patch : soft->patches) {
    double stiffest = 0;
    for (const SpringLaw& law : patch.law) stiffest = std::max(stiffest, law.tangent(0));
    const double factor = std::min(1.0, load / std::sqrt(area) / (share_of_width * strain * stiffest));
    for (SpringLaw& law : patch.law) law = law.linearised().scaled(factor);
    least = std::min(least, factor);
  }
  for (Spring& spring : soft->springs) {
    const SpringLaw& law = mesh.laws[spring.law];
    const double factor = std::min(1.0, load / (share_of_springs * strain * spring.scale * law.tangent(0)));
    spring.law = static_cast<int>(soft->laws.size());
    soft->laws.push_back(law.linearised().scaled(factor));
    least = std::min(least, factor);
  }
  if (least == 1) soft.reset();
  return soft;
}

/// The path from a start to equilibrium, with soft cloth if the start is far from it.
class Way {
 public:
  /// Of a canopy, or of its sector with `images` of it and its `freedom`.
  Way(const Cloth& cloth, const Loads& loads, const RelaxOptions& options, ThreadTeam& team,
      const RelaxWatch& watch, int images = 1, std::vector<Symmetric> freedom = {})
      : cloth_(cloth),
        loads_(loads),
        options_(options),
        team_(team),
        watch_(watch),
        images_(images),
        freedom_(std::move(freedom)) {}

  bool is_far(const ClothState& start) const {
    if (!wrinkles(cloth_.mesh)) return false;
    const RelaxOptions look{options_.tolerance, 1, options_.least_load, options_.regularisation};
    ClothState state = start;
    return Relaxation(state, cloth_, loads_, look, team_, start, freedom_).run({}).residual > far_residual;
  }

  /// Held toward `start`, if so.
  RelaxResult go(ClothState& state, const ClothState& start, bool from_afar) const {
    const int steps = from_afar ? go_softly(state, start) : 0;
    RelaxOptions rest = options_;
    rest.max_steps = std::max(1, options_.max_steps - steps);
    RelaxResult result = Relaxation(state, cloth_, loads_, rest, team_, start, freedom_).run(watch_);
    result.steps += steps;
    return result;
  }

 private:
  int go_softly(ClothState& state, const ClothState& start) const {
    int steps = 0;
    const double load = images_ * applied_load(cloth_, state, loads_).sum;
    for (const double strain : soft_strains) {
      if (!(load > 0)) break;
      const std::optional<Mesh> mesh = softened(cloth_.mesh, load, strain, images_);
      if (!mesh) break;
      const ClothPtr soft = make_cloth(*mesh, cloth_.options);
      const int most = std::min(soft_steps, options_.max_steps - steps);
      const RelaxOptions roughly{soft_tolerance, most, options_.least_load, options_.regularisation};
      steps += Relaxation(state, *soft, loads_, roughly, team_, start, freedom_).run(watch_).steps;
    }
    return steps;
  }

  const Cloth& cloth_;
  const Loads& loads_;
  const RelaxOptions& options_;
  ThreadTeam& team_;
  const RelaxWatch& watch_;
  int images_;
  std::vector<Symmetric> freedom_;
};

/// A canopy that is far from equilibrium is first solved as a sector, under the part of its load that is
/// common to all gores. Returns whether the sector reached equilibrium; if not, the canopy is unchanged.
bool predict_by_sector(ClothState& state, const Cloth& cloth, const Loads& loads, const RelaxOptions& options,
                       const RelaxWatch& watch) {
  const std::optional<Sector> sector = sector_of(cloth.mesh, positions(state, cloth), loads);
  if (!sector) return false;
  ClothOptions of_sector = cloth.options;
  of_sector.contact.reset();
  const ClothPtr part = make_cloth(sector->mesh, of_sector);
  const ClothState start = start_state(*part);
  ClothState rests = start;
  ThreadTeam alone(1);  // some hundred nodes
  RelaxWatch watch_sector;
  if (watch)
    watch_sector = [&](const RelaxProgress& progress, const std::function<std::vector<Vec3>()>& of_part) {
      watch(progress, [&] { return sector->whole(of_part()); });
    };
  const Way way(*part, sector->loads, options, alone, watch_sector, sector->images, sector->freedom);
  try {
    if (!way.go(rests, start, true).converged) return false;
  } catch (const Error& error) {
    if (error.code() != ExitCode::diverged) throw;
    return false;
  }
  set_positions(state, cloth, sector->whole(positions(rests, *part)));
  return true;
}

}  // namespace

RelaxResult relax(ClothState& state, const Cloth& cloth, const Loads& loads, const RelaxOptions& options,
                  ThreadTeam& team, const std::function<void(const RelaxProgress&)>& report) {
  RelaxWatch watch;
  if (report) watch = [&](const RelaxProgress& progress, const auto&) { report(progress); };
  return watched_relax(state, cloth, loads, options, team, watch);
}

RelaxResult watched_relax(ClothState& state, const Cloth& cloth, const Loads& loads,
                          const RelaxOptions& options, ThreadTeam& team, const RelaxWatch& watch) {
  const ClothState start = state;
  const Way way(cloth, loads, options, team, watch);
  bool far = way.is_far(state);
  if (far && options.regularisation == 0) far = !predict_by_sector(state, cloth, loads, options, watch);
  RelaxResult result = way.go(state, start, far);
  const std::vector<Vec3> before = positions(start, cloth), now = positions(state, cloth);
  result.mean_displacement = mean_distance(now, before);
  if (options.regularisation > 0) {
    double squared = 0;
    for (std::size_t node = 0; node < now.size(); ++node) {
      const Vec3 force = options.regularisation * cloth.area[node] * (now[node] - before[node]);
      squared += dot(force, force);
    }
    result.regularisation_share =
        std::sqrt(squared) / std::max(applied_load(cloth, state, loads).norm, options.least_load);
  }
  return result;
}

}  // namespace ripstop::inline cloth
