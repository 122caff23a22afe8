#include "ripstop/case/cluster.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ripstop/case/bodies.h"
#include "ripstop/case/case.h"
#include "ripstop/case/settings.h"
#include "ripstop/core/angle.h"
#include "ripstop/core/error.h"
#include "ripstop/core/toml/fields.h"
#include "ripstop/core/toml/problem.h"
#include "ripstop/parachute/scale.h"

namespace ripstop::inline cases {
namespace {

// Depth of the inflated canopy to its widest part, in inflated diameters (about).
constexpr double widest_part = 0.25;
// Inflated over the inflated diameter of the domain, which is a generous one: canopies closer than this do touch.
constexpr double narrow = 0.9;

constexpr double smallest_ratio = 0.2;  // of canopies in one flow: a smaller one has too few of its cells

/// The list has a value for each canopy, or none.
void check_count(const ClusterKeys& keys, const std::vector<double>& values, const char* key,
                 const char* each, Findings& findings) {
  if (values.empty() || std::ssize(values) == keys.canopies) return;
  findings.add(
      fmt::format("cluster.{}", key), fmt::format("[{:g}]", fmt::join(values, ", ")),
      fmt::format("{} values", keys.canopies),
      fmt::format("has {} values for cluster.canopies = {}; give {}", values.size(), keys.canopies, each));
}

void check_sizes(const Case& given, Findings& findings) {
  const ClusterKeys& keys = *given.cluster;
  check_count(keys, keys.size_ratios, "size_ratios", "the size of each canopy, 1 for the largest", findings);
  if (equal_canopies(given) || !findings.sound({"cluster.size_ratios"})) return;
  if (const double ratio = std::ranges::max(keys.size_ratios); ratio < 1)
    findings.add(
        "cluster.size_ratios", fmt::format("[{:g}]", fmt::join(keys.size_ratios, ", ")),
        "a largest value of 1",
        fmt::format("the largest value is {:g}; describe the largest canopy in [parachute] and give the "
                    "other ones over it",
                    ratio));
  if (keys.equilibrium)
    findings.add("cluster.equilibrium", "true", "false",
                 "canopies of different size have no common spread angle of equilibrium; remove "
                 "cluster.size_ratios, or compute a flight (ripstop fly)");
}

/// Sine of the spread angle at which neighbouring canopies touch, about; above 1 where they do at every angle. The arm
/// of a smaller canopy is so much shorter that it touches at the same angle.
double touching_sine(const Case& given) {
  const double radius = 0.5 * inflated_diameter(given.parachute);
  return narrow * radius / (cluster_arm(given) * std::sin(std::numbers::pi / given.cluster->canopies));
}

}  // namespace

void describe(Fields& fields, ClusterKeys& keys) {
  fields
      .integer(
          "canopies", keys.canopies, from(fewest_in_cluster).up_to(most_in_cluster),
          "Number of canopies, all of them as in [parachute] or smaller (size_ratios), each on its own riser "
          "(parachute.riser.length_m) to the common confluence.")
      .required();
  fields
      .number("spread_angle_deg", keys.spread_angle_deg, above(0).up_to(widest_spread),
              "Angle between the axis of each canopy and the axis of the cluster. The result of a steady run "
              "contains the moment that would change it. In a flight or an inflation it is the angle at the "
              "start.")
      .required();
  fields.toggle(
      "equilibrium", keys.equilibrium,
      fmt::format("Search for the spread angle at which the force of each canopy points along its axis. "
                  "The search starts at spread_angle_deg and tries angles up to {:g} degrees from it.",
                  spread_search));
  fields
      .number("single_drag_coefficient", keys.single_drag_coefficient, above(0).up_to(5),
              "Drag coefficient of one canopy alone, from a run of the same case without this table. The "
              "cluster factor is relative to it.")
      .absent("no cluster factor in the result");
  fields
      .number(
          "single_descent_drag_coefficient", keys.single_descent_drag_coefficient, above(0).up_to(5),
          "Drag coefficient in descent of one canopy alone, from a flight of the same case without this "
          "table and with the same share of the payload. The cluster factor in descent is relative to it.")
      .absent("no cluster factor in the result of a flight");
  fields
      .number("widest_spread_angle_deg", keys.widest_spread_angle_deg, above(0).up_to(widest_spread),
              "Largest angle between a canopy and the axis of the cluster in flight, for which the default "
              "flow domain is made.")
      .absent("the larger of `45` and spread_angle_deg + 15, at most `60`");
  fields.numbers(
      "size_ratios", keys.size_ratios, 0, most_in_cluster, from(smallest_ratio).up_to(1),
      "Sizes of the canopies over that of [parachute], one value for each canopy: factor of every "
      "length of canopy, lines and riser. [parachute] is the largest canopy, so that one value is 1. "
      "Empty: all canopies are as in [parachute].");
  fields.numbers(
      "delays_s", keys.delays_s, 0, most_in_cluster, from(0).up_to(1000),
      "Times from the start of a coupled inflation until which each canopy stays folded, one value "
      "for each canopy. A folded canopy moves along its own axis only. Empty: all canopies open at "
      "the start. Not used in a steady run and in a flight.");
}

ClusterLayout layout_of(const ClusterKeys& keys) {
  return {keys.canopies, degree * keys.spread_angle_deg};
}

ClusterLayout widest_layout(const ClusterKeys& keys) {
  const double more = keys.equilibrium ? spread_search : 0;
  return {keys.canopies, degree * std::min(widest_spread, keys.spread_angle_deg + more)};
}

int canopy_count(const Case& given) {
  return given.cluster ? given.cluster->canopies : 1;
}

bool equal_canopies(const Case& given) {
  return !given.cluster || std::ranges::all_of(given.cluster->size_ratios, [](double r) { return r == 1; });
}

double size_ratio(const Case& given, int k) {
  if (equal_canopies(given) || k >= std::ssize(given.cluster->size_ratios)) return 1;
  return given.cluster->size_ratios[static_cast<std::size_t>(k)];
}

double smallest_size_ratio(const Case& given) {
  return equal_canopies(given) ? 1 : std::ranges::min(given.cluster->size_ratios);
}

double area_ratio(const Case& given) {
  double sum = 0;
  for (int k = 0; k < canopy_count(given); ++k) sum += size_ratio(given, k) * size_ratio(given, k);
  return sum;
}

double load_after_failure(const Case& given) {
  return area_ratio(given) / (area_ratio(given) - 1);
}

Settings canopy_settings(const Settings& resolved, int k) {
  Case one = resolved.written();
  one.parachute = in_size(one.parachute, size_ratio(one, k));
  one.cluster.reset();
  return resolve(one);
}

double cluster_arm(const Case& given) {
  return usual_trailing_distance(given.parachute) + widest_part * inflated_diameter(given.parachute);
}

SpreadRange spread_range(const Case& given) {
  const double first = given.cluster->spread_angle_deg;
  const double touching = std::asin(std::min(1.0, touching_sine(given))) / degree;
  return {std::max(first - spread_search, std::min(first, touching)),
          widest_layout(*given.cluster).spread / degree};
}

Vec3 core_for_cluster(const Case& given, double d) {
  if (!given.cluster) return {};
  const ClusterLayout layout = widest_layout(*given.cluster);
  return cluster_arm(given) * layout.width() + Vec3{0, 0, d * std::sin(layout.spread)};
}

void check_cluster(const Case& given, const FlowSettings& flow, Findings& findings) {
  if (!given.cluster || !findings.sound({"cluster"})) return;
  if (flow.porosity_model != PorosityModel::sheet)
    findings.add("flow.porosity_model", "\"paper\"", "\"sheet\"", "a cluster needs the sheet model");
  if (flow.tunnel.kind != TunnelKind::free_air)
    findings.add("flow.tunnel.kind", "", "\"free-air\"", "a cluster is computed in free air only");
  if (!given.bodies.empty())
    findings.add("body." + given.bodies.begin()->first, "", "",
                 "rigid bodies and a cluster cannot be in one case; remove one of the tables");
  if (given.payload.mass_kg && given.cluster->equilibrium)
    findings.add("cluster.equilibrium", "true", "false",
                 "the search for the spread angle is at a given speed; remove the payload (payload.mass_kg) "
                 "and give flow.speed_m_s");
  if (const auto& widest = given.cluster->widest_spread_angle_deg;
      widest && *widest < given.cluster->spread_angle_deg)
    findings.add("cluster.widest_spread_angle_deg", *widest,
                 fmt::format("at least {:g}", given.cluster->spread_angle_deg),
                 "is below cluster.spread_angle_deg, the angle at the start");
  check_sizes(given, findings);
  check_count(*given.cluster, given.cluster->delays_s, "delays_s",
              "the delay of each canopy, 0 for one that opens at the start", findings);
  const double across = start_diameter(given.parachute);
  const Vec3 room = cluster_arm(given) * widest_layout(*given.cluster).width();
  const double needed[] = {room.x + across, room.y + across}, box[] = {flow.box_m.x, flow.box_m.y},
               core[] = {flow.core.size_m.x, flow.core.size_m.y};
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string allowed = fmt::format("at least {:.6g}", 1.001 * needed[i]);
    const auto refuse = [&](const char* key, double value, const char* part) {
      findings.add(fmt::format("{}[{}]", key, i), value, allowed,
                   fmt::format("the cluster does not fit into the {}; it needs {} m", part, allowed));
    };
    if (box[i] <= needed[i] && findings.sound({"flow.box_m"})) refuse("flow.box_m", box[i], "flow domain");
    if (core[i] > 0 && core[i] < (1 - 1e-12) * needed[i] && findings.sound({"flow.core.size_m"}))
      refuse("flow.core.size_m", core[i], "fine core");
  }
  const int n = given.cluster->canopies;
  const double arm = cluster_arm(given), radius = 0.5 * inflated_diameter(given.parachute);
  const double share = touching_sine(given);
  if (std::sin(layout_of(*given.cluster).spread) >= share) return;
  const bool possible = share < std::sin(degree * widest_spread);
  const double least = std::ceil(10 * std::asin(std::min(1.0, share)) / degree) / 10;
  const double longer = (share / std::sin(layout_of(*given.cluster).spread) - 1) * arm;
  const std::string wider = possible ? fmt::format("increase the angle to at least {:.1f}, or ", least) : "";
  findings.add("cluster.spread_angle_deg", given.cluster->spread_angle_deg,
               possible ? fmt::format("at least {:.1f}", least) : "",
               fmt::format("{} canopies of about {:.3g} m inflated diameter, {:.3g} m from the confluence, "
                           "touch; {}lengthen the riser (parachute.riser.length_m = {:g}) by {:.3g} m",
                           n, 2 * radius, arm, wider, given.parachute.riser.length_m, longer));
}

std::vector<std::string> unused_delays(const Case& given, const char* what) {
  if (!given.cluster || given.cluster->delays_s.empty()) return {};
  return {
      fmt::format("cluster.delays_s: not used; {} has open canopies from the start. Only a coupled "
                  "inflation (ripstop inflate) uses the delays",
                  what)};
}

void require_one_canopy(const Settings& resolved, const char* what) {
  if (!resolved.written().cluster) return;
  throw Error(
      ExitCode::usage,
      fmt::format("cluster.canopies = {}: {} computes one canopy; only a steady run, a sweep, a flight "
                  "and a coupled inflation compute a cluster (remove the table, or --unset cluster)",
                  resolved.written().cluster->canopies, what));
}

}  // namespace ripstop::inline cases
