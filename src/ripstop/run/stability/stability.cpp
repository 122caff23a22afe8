#include "ripstop/run/stability/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "ripstop/canopy/shape.h"
#include "ripstop/case/assemble.h"
#include "ripstop/case/cluster.h"
#include "ripstop/case/resolve.h"
#include "ripstop/core/error.h"
#include "ripstop/core/quantity.h"
#include "ripstop/flow/extent.h"
#include "ripstop/flow/statistics.h"
#include "ripstop/fsi/transfer.h"
#include "ripstop/run/engine.h"
#include "ripstop/run/json.h"

namespace ripstop::inline run {
namespace {

// The box and its cells, in units of the canopy's largest width: as in bench/attack.cpp.
constexpr double half_box = 4.5, box_before = 4, box_behind = 6;
constexpr double core_margin = 0.35, core_wake = 1;
constexpr double cell_growth = 1.2;

// As for the default domain of a case with bodies, in units of the widest one.
constexpr double before_bodies = 4, core_before_bodies = 0.5;

constexpr double significant = 2;  // standard errors

Attitude attitude_in(Vec3 wind) {
  return {{0, 0, 1}, wind};
}

struct Mean {
  double value = 0;
  std::optional<double> error;
};

/// Of one number of every step of a record, without its start-up.
template <class Number>
Mean mean_of(const FlowRecord& record, const Number& number) {
  Record values;
  values.begin = record.steps.front().time - record.steps.front().length;
  for (std::size_t n = 0; n < record.steps.size(); ++n) {
    values.until.push_back(record.steps[n].time);
    values.values.push_back(number(n));
  }
  const MeanOverTime mean = mean_over_time(values, values.begin + record.start_up);
  Mean result{mean.mean, std::nullopt};
  if (std::isfinite(mean.standard_error)) result.error = mean.standard_error;
  return result;
}

Vec3 mean_vector(const FlowRecord& record, std::size_t body, Vec3 BodyLoad::*which) {
  const auto along = [&](double Vec3::*axis) {
    return mean_of(record, [&](std::size_t n) { return record.steps[n].bodies.at(body).*which.*axis; }).value;
  };
  return {along(&Vec3::x), along(&Vec3::y), along(&Vec3::z)};
}

/// `load_on(n)` for each rigid body n; nothing without any.
template <class LoadOn>
std::optional<std::vector<StabilityBody>> rigid_loads(const FlowProblem& problem, const LoadOn& load_on) {
  if (problem.bodies.size() < 2) return {};
  std::vector<StabilityBody> loads;
  for (std::size_t n = 1; n < problem.bodies.size(); ++n) {
    loads.push_back(load_on(n));
    loads.back().name = problem.bodies[n].name;
  }
  return loads;
}

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ExitCode::usage, why);
}

void check_flow(const Settings& resolved) {
  require_one_canopy(resolved, "stability");
  const FlowSettings& flow = resolved.flow();
  const char* flow_needed = "an angle of attack needs an unbounded stream";
  if (flow.tunnel.kind != TunnelKind::free_air)
    refuse(fmt::format("flow.tunnel.kind: {}, not a wind tunnel; set it to \"free-air\"", flow_needed));
  const Source& sides = resolved.source("flow.sides");
  if (sides.given && !(flow.sides == Sides::far_field) && !(flow.sides == Sides::entraining))
    refuse(fmt::format("flow.sides = \"{}\", {}: {}; leave the key out or set it to \"far-field\"",
                       flow.sides.word, sides.from, flow_needed));
  if (flow.porosity_model != PorosityModel::sheet)
    refuse(
        "flow.porosity_model = \"paper\": an angle of attack needs the \"sheet\" model; give the cloth a "
        "permeability as a pressure drop");
  if (!engine_of(resolved).can.has_boundary(Sides::far_field.word))
    refuse(
        fmt::format("flow.engine = \"{}\": this engine has no far field on all faces of the box; use \"{}\"",
                    flow.engine, engines().front().word));
}

}  // namespace

void check_angles(const std::vector<double>& angles) {
  if (angles.empty()) refuse("--angles: no angle; give at least one, as in --angles 0:40:5");
  if (angles.size() > static_cast<std::size_t>(most_angles))
    refuse(fmt::format("--angles: {} angles, at most {}; use a larger step", angles.size(), most_angles));
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (!(angles[i] >= 0 && angles[i] <= largest_angle))
      refuse(fmt::format("--angles: {:g} degrees; an angle of attack is from 0 to {:g} degrees", angles[i],
                         largest_angle));
    if (i > 0 && !(angles[i] > angles[i - 1]))
      refuse(
          fmt::format("--angles: {:g} after {:g} degrees; angles must increase", angles[i], angles[i - 1]));
  }
}

std::vector<double> angles_of_text(const std::string& text) {
  const std::string form = "FROM:TO:STEP in degrees, as in 0:40:5, or one angle";
  std::vector<double> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(':', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    const TypedNumber read = read_typed(part, "deg");
    if (!read.refusal.empty() || part.find(' ') != std::string::npos)
      refuse(fmt::format("--angles {}: \"{}\" is not a number; give {}", text, part, form));
    parts.push_back(read.value);
    begin = end + 1;
  }
  if (parts.size() != 1 && parts.size() != 3)
    refuse(fmt::format("--angles {}: {} numbers; give {}", text, parts.size(), form));
  std::vector<double> angles = {parts[0]};
  if (parts.size() == 3) {
    const double from = parts[0], to = parts[1], step = parts[2];
    if (!(step > 0)) refuse(fmt::format("--angles {}: a step of {:g}; it must be above 0", text, step));
    if (to < from)
      refuse(
          fmt::format("--angles {}: from {:g} down to {:g}; give the smaller angle first", text, from, to));
    const double count = std::floor((to - from) / step * (1 + 1e-12) + 1e-9);
    if (count + 1 > most_angles)
      refuse(fmt::format("--angles {}: {:g} angles, at most {}; use a larger step", text, count + 1,
                         most_angles));
    for (int n = 1; n <= static_cast<int>(count); ++n) angles.push_back(from + n * step);
  }
  check_angles(angles);
  return angles;
}

std::vector<Settings> stability_cases(const Case& given, const std::vector<double>& angles) {
  check_angles(angles);
  if (given.flow.angle_of_attack_deg != 0)
    refuse(fmt::format("flow.angle_of_attack_deg = {:g}: this command sets the angle; leave the key out",
                       given.flow.angle_of_attack_deg));
  check_flow(resolve(given));
  std::vector<Settings> cases;
  for (const double angle : angles) {
    Case at = given;
    at.flow.angle_of_attack_deg = angle;
    cases.push_back(resolve(at));
  }
  return cases;
}

RigidCanopy rigid_canopy(const Settings& resolved, const std::vector<Vec3>& shape) {
  const CanopyMesh mesh = parachute_mesh(resolved);
  RigidCanopy canopy;
  canopy.surface = surface_of(cells_of(mesh), shape);
  canopy.confluence = shape.at(static_cast<std::size_t>(mesh.rigging.confluence));
  canopy.width = canopy_size(mesh, shape).projected_diameter;
  return canopy;
}

// The vent is the ring of cloth that is nearest to the axis. Its nodes lie on a polygon.
CanopyMesh restrained_mesh(const Settings& resolved, const SteadyState& state) {
  constexpr double polygon = 1.1;  // largest to smallest radius of a ring, with a margin
  CanopyMesh mesh = parachute_mesh(resolved);
  std::set<int> cloth;
  for (const Cell& cell : cells_of(mesh))
    if (cell.corner[0] >= 0) cloth.insert(std::begin(cell.corner), std::end(cell.corner));
  for (const Tie& tie : mesh.ties) cloth.erase(tie.node);  // follows other nodes
  const auto radius = [&](int node) { return std::hypot(mesh.start[node].x, mesh.start[node].y); };
  double nearest = std::numeric_limits<double>::infinity();
  for (const int node : cloth) nearest = std::min(nearest, radius(node));
  std::set<int> fixed(mesh.fixed.begin(), mesh.fixed.end());
  fixed.insert(mesh.rigging.confluence);
  for (const int node : cloth)
    if (radius(node) <= polygon * nearest + 1e-9) fixed.insert(node);
  mesh.fixed.assign(fixed.begin(), fixed.end());
  for (const int node : mesh.fixed) mesh.start[node] = state.shape[node];
  return mesh;
}

namespace {

/// Of the rigid bodies of a flow, which come after the canopy.
struct BodyExtent {
  Extent all;
  double width = 0;  // of the widest one [m]
};

BodyExtent extent_of_bodies(const FlowProblem& problem) {
  BodyExtent bodies;
  for (std::size_t n = 1; n < problem.bodies.size(); ++n) {
    const Extent e = extent_of(problem.bodies[n].surface);
    bodies.all.add(e.lower()), bodies.all.add(e.upper());
    bodies.width = std::max({bodies.width, e.high[0] - e.low[0], e.high[1] - e.low[1]});
  }
  return bodies;
}

/// The smallest box about both.
Extent joined(Extent a, const Extent& b) {
  a.add(b.lower()), a.add(b.upper());
  return a;
}

}  // namespace

FlowProblem stability_flow(const Settings& at_angle, const RigidCanopy& canopy, int across, double widest) {
  FlowProblem problem = flow_problem(at_angle);
  const Extent of_canopy = extent_of(canopy.surface);
  const Vec3 size = of_canopy.upper() - of_canopy.lower(),
             middle = 0.5 * (of_canopy.lower() + of_canopy.upper());
  const double width = std::max(size.x, size.y), h = canopy.width / across;
  const BodyExtent bodies = extent_of_bodies(problem);
  const Extent e = bodies.width > 0 ? joined(of_canopy, bodies.all) : of_canopy;
  const Vec3 wind = wind_direction(std::min(widest, 90.0), at_angle.flow().azimuth_deg);
  const double wake = core_wake * width;
  const auto shifted = [&](double low, double high, double towards) {
    return std::pair{low - core_margin * width + std::min(0.0, wake * towards),
                     high + core_margin * width + std::max(0.0, wake * towards)};
  };
  const auto [x0, x1] = shifted(e.low[0], e.high[0], wind.x);
  const auto [y0, y1] = shifted(e.low[1], e.high[1], wind.y);
  const auto [z0, z1] = shifted(e.low[2], e.high[2], 1);
  // No two sides of the canopy lie alike on the cells: docs/theory/flow-cartesian.md.
  const Vec3 off = in_time_off_axis * h * Vec3{1, 0.5, 0};
  Vec3 low = Vec3{x0, y0, z0} + off;
  const Vec3 high = Vec3{x1, y1, z1} + off;
  Vec3 corner = middle - width * Vec3{half_box, half_box, box_before};
  const Vec3 far = middle + width * Vec3{half_box, half_box, box_behind};
  if (bodies.width > 0) {
    const double front = bodies.all.low[2];
    low.z = std::min(low.z, front - core_before_bodies * bodies.width);
    corner.z = std::min(corner.z, front - before_bodies * bodies.width);
  }
  const auto cells = [&](double from, double core_from, double core_to, double to) {
    return static_cast<int>(std::lround((core_to - core_from) / h)) +
           cells_outside(h, core_from - from, cell_growth) + cells_outside(h, to - core_to, cell_growth);
  };
  problem.grid = graded({corner, far - corner, cells(corner.x, low.x, high.x, far.x),
                         cells(corner.y, low.y, high.y, far.y), cells(corner.z, low.z, high.z, far.z)},
                        low, high, cell_growth);
  problem.sides = Sides::far_field;
  FlowBody& body = problem.bodies.at(0);
  body.surface = canopy.surface;
  body.moment_about = canopy.confluence;
  return problem;
}

Reference stability_reference(const Settings& resolved) {
  return {resolved.flow().density_kg_m3, nominal_area(resolved.parachute()),
          nominal_diameter(resolved.parachute())};
}

std::vector<Trim> trims_of(const std::vector<StabilityRow>& rows) {
  std::vector<Trim> trims;
  const auto differs = [](const StabilityRow& row) {
    return std::abs(row.c_m) > significant * row.c_m_error.value_or(0);
  };
  std::size_t first = 0;
  if (rows.size() > 1 && rows[0].angle == 0) {
    trims.push_back({0, std::nullopt, rows[1].c_m < 0, differs(rows[1])});
    first = 1;
  }
  for (std::size_t i = first; i + 1 < rows.size(); ++i) {
    const StabilityRow &a = rows[i], &b = rows[i + 1];
    if (!(a.c_m * b.c_m < 0)) continue;
    const double slope = (b.c_m - a.c_m) / (b.angle - a.angle), share = a.c_m / (a.c_m - b.c_m);
    Trim trim{a.angle + share * (b.angle - a.angle), std::nullopt, slope < 0, differs(a) && differs(b)};
    if (a.c_m_error && b.c_m_error)
      trim.standard_error = std::hypot((1 - share) * *a.c_m_error, share * *b.c_m_error) / std::abs(slope);
    trims.push_back(trim);
  }
  return trims;
}

void take_trims(StabilityResult& result) {
  result.trims = trims_of(result.rows);
  result.trim_angles.clear(), result.stable_trim_angles.clear(), result.warnings.clear();
  for (const Trim& trim : result.trims) {
    result.trim_angles.push_back(trim.angle);
    if (trim.stable) result.stable_trim_angles.push_back(trim.angle);
    if (!trim.certain)
      result.warnings.push_back(
          fmt::format("trim at {:.1f} degrees: C_m next to it differs from 0 by less than {:g} "
                      "standard errors; use a longer averaging window (flow.watch)",
                      trim.angle, significant));
  }
  for (const StabilityRow& row : result.rows)
    if (!row.enough)
      result.warnings.push_back(
          row.c_t_error
              ? fmt::format(
                    "{:g} degrees: the standard error of the drag is above flow.watch.standard_error; "
                    "raise flow.watch.longest",
                    row.angle)
              : fmt::format(
                    "{:g} degrees: the flow did not reach its residual, the row is a mean over its last "
                    "iterations; raise flow.max_iterations",
                    row.angle));
}

std::string to_json(const StabilityResult& result) {
  return json_text(result);
}

// The far field changes with the air's own velocity, so that no pressure wave has to pass the box: dU/dt as a force on
// all of the air, in a frame that accelerates (flow/flow.h).
void turn_stream(Flow& flow, Vec3 from, Vec3 to, double length, double courant) {
  const double whole = length / norm(to);
  Vec3 now = from;
  for (double time = 0; time < whole;) {
    const double step = std::min(flow.longest_step(courant), whole - time);
    time += step;
    const double share = whole - time < 1e-9 * whole ? 1 : time / whole;
    if (share == 1) time = whole;
    const Vec3 next = from + share * (to - from);
    flow.stream(next, (next - now) / step);
    flow.step(step);
    now = next;
  }
  flow.stream(to, {});
}

StabilityRow row_of_record(const FlowRecord& record, const FlowProblem& problem, double angle,
                           const Reference& reference) {
  const Attitude attitude = attitude_in(problem.air.velocity);
  std::vector<Coefficients> steps;
  for (const FlowStep& step : record.steps)
    steps.push_back(coefficients(step.bodies.at(0), attitude, reference));
  StabilityRow row;
  row.angle = angle;
  const auto take = [&](double Coefficients::*which, double& value, std::optional<double>& error) {
    const Mean mean = mean_of(record, [&](std::size_t n) { return steps[n].*which; });
    value = mean.value, error = mean.error;
  };
  take(&Coefficients::tangential, row.c_t, row.c_t_error);
  take(&Coefficients::normal, row.c_n, row.c_n_error);
  take(&Coefficients::moment, row.c_m, row.c_m_error);
  take(&Coefficients::drag, row.c_d, row.c_d_error);
  take(&Coefficients::lift, row.c_l, row.c_l_error);
  take(&Coefficients::side, row.c_y, row.c_y_error);
  row.time = record.watched(), row.start_up = record.start_up;
  row.steps = static_cast<int>(record.steps.size());
  row.enough = record.enough;
  row.mass_defect = record.largest_mass_defect();
  row.bodies = rigid_loads(problem, [&](std::size_t body) {
    const Mean drag = mean_of(record, [&](std::size_t n) {
      return dot(record.steps[n].bodies.at(body).force, problem.air.direction());
    });
    return StabilityBody{{},
                         drag.value,
                         drag.error,
                         mean_vector(record, body, &BodyLoad::force),
                         mean_vector(record, body, &BodyLoad::moment)};
  });
  return row;
}

StabilityRow row_of_field(const FlowField& field, const FlowProblem& problem, double angle,
                          const Reference& reference) {
  const Coefficients c = coefficients(field.bodies.at(0), attitude_in(problem.air.velocity), reference);
  StabilityRow row;
  row.angle = angle;
  row.c_t = c.tangential, row.c_n = c.normal, row.c_m = c.moment;
  row.c_d = c.drag, row.c_l = c.lift, row.c_y = c.side;
  row.steps = field.last.iteration;
  row.enough = field.converged;
  row.bodies = rigid_loads(problem, [&](std::size_t body) {
    const BodyLoad& load = field.bodies.at(body);
    return StabilityBody{{}, dot(load.force, problem.air.direction()), {}, load.force, load.moment};
  });
  return row;
}

}  // namespace ripstop::inline run
