// Several canopies on risers to one confluence: [cluster].
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ripstop/core/vec3.h"
#include "ripstop/parachute/cluster.h"

namespace ripstop {
class Fields;
class Findings;
}  // namespace ripstop

namespace ripstop::inline cases {

class Settings;
struct Case;
struct FlowSettings;

/// [cluster] as given.
struct ClusterKeys {
  int canopies = 0;
  double spread_angle_deg = 0;  // between the axes of a canopy and of the cluster; of a search the first one
  bool equilibrium = false;     // the run searches for the angle
  std::optional<double> single_drag_coefficient;               // of one canopy alone, for the cluster factor
  std::optional<double> single_descent_drag_coefficient = {};  // likewise of a flight
  std::optional<double> widest_spread_angle_deg = {};          // in flight, for the domain
  std::vector<double> size_ratios = {};  // of each canopy over [parachute]; empty: all of them 1
  std::vector<double> delays_s = {};     // of each canopy in a coupled inflation; empty: all open at once
};
void describe(Fields& fields, ClusterKeys& keys);

inline constexpr double widest_spread = 60;  // largest spread angle [deg]
/// The search for the equilibrium tries spread angles up to so far from the first one (assumed) [deg].
inline constexpr double spread_search = 10;

ClusterLayout layout_of(const ClusterKeys& keys);
/// The layout of the largest spread angle that the run may have, for which the domain is made.
ClusterLayout widest_layout(const ClusterKeys& keys);
/// Spread angles among which the run of a case with a cluster searches for the equilibrium [deg].
struct SpreadRange {
  double least = 0, largest = 0;
};
/// From the angle at which the canopies touch, at most `spread_search` from the given one.
SpreadRange spread_range(const Case& given);
/// Number of canopies of the case: 1 without a cluster.
int canopy_count(const Case& given);
/// Whether all canopies are as in [parachute].
bool equal_canopies(const Case& given);
/// Of canopy `k` from 0: every length over that of [parachute], which is the largest canopy.
double size_ratio(const Case& given, int k);
double smallest_size_ratio(const Case& given);
/// Nominal area of all canopies over that of [parachute]: the number of canopies if they are equal.
double area_ratio(const Case& given);
/// When the largest canopy of a cluster fails: load of the others over that before, in a steady descent.
double load_after_failure(const Case& given);
/// The settings of canopy `k` alone, in its size.
Settings canopy_settings(const Settings& resolved, int k);

/// From the confluence to the middle of a canopy, about [m].
double cluster_arm(const Case& given);
/// By which the core of fine cells is larger than for one canopy of the inflated diameter `d`; 0 without a cluster [m].
Vec3 core_for_cluster(const Case& given, double d);

/// Settings that a cluster cannot have, and canopies that touch.
void check_cluster(const Case& given, const FlowSettings& flow, Findings& findings);
/// Keys of a coupled inflation that `what` does not use.
std::vector<std::string> unused_delays(const Case& given, const char* what);
/// Throws Error(usage) for a case with a cluster: `what` computes one canopy.
void require_one_canopy(const Settings& resolved, const char* what);

}  // namespace ripstop::inline cases
