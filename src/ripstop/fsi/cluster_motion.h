// The canopies of a cluster in free flight: their spread angles, loads, mouths and distances.
#pragma once

#include <optional>
#include <vector>

#include "ripstop/cloth/cloth.h"
#include "ripstop/core/members.h"
#include "ripstop/parachute/canopy_mesh.h"

namespace ripstop::inline fsi {

/// One canopy of a cluster at the end of a step of the flow.
struct CanopyRow {
  double time = 0;    // [s]
  double canopy = 0;  // its number, from 1
  /// Between the lines from the payload to the centre of its skirt, and to the mean of these centres [deg].
  double spread = 0;
  double azimuth = 0;  // of the centre of its skirt about that mean, over the ground from x towards y [deg]
  double riser_load = 0;  // of its riser, or of its lines, on the payload [N]
  double mouth_area = 0;  // magnitude of its area vector [m2]
  double gap = 0;         // smallest distance of a node of its cloth from one of another canopy [m]
};
template <Of<CanopyRow> T, class Visit>
void each_member(T& row, Visit&& visit) {
  visit("time_s", row.time);
  visit("canopy", row.canopy);
  visit("spread_angle_deg", row.spread);
  visit("azimuth_deg", row.azimuth);
  visit("riser_load_n", row.riser_load);
  visit("mouth_area_m2", row.mouth_area);
  visit("gap_m", row.gap);
}

/// Magnitudes of the area vectors of the canopies, whose cells follow each other [m2].
std::vector<double> mouth_areas(const std::vector<Cell>& cells, const std::vector<Vec3>& x, int canopies);

/// Force of the springs of every canopy on the node `payload`, without that of their dampers [N].
std::vector<Vec3> riser_forces(const CanopyMesh& mesh, const std::vector<Vec3>& x,
                               const std::vector<double>& tensions, int payload);

/// Smallest distance between a point of `a` and one of `b` [m].
double smallest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b);

/// Of every canopy the smallest distance of its cloth from that of another one, by nodes [m].
std::vector<double> canopy_gaps(const CanopyMesh& mesh, const std::vector<Cell>& cells,
                                const std::vector<Vec3>& x);

/// Every canopy at a state, `payload` is the node at which the risers end. Azimuths are about the z axis.
std::vector<CanopyRow> canopy_rows(const CanopyMesh& mesh, const Cloth& cloth, const ClothState& state,
                                   int payload);

/// Values of one canopy over the time after the start-up.
struct CanopyMotion {
  std::optional<double> size_ratio;                // over the largest canopy; absent: all are equal
  double mean_spread = 0, spread_deviation = 0;    // its standard deviation over time [deg]
  double mean_load = 0;                            // of the riser [N]
  double largest_load = 0, largest_load_time = 0;  // of the whole flight, at the ends of steps [N], [s]
  double mean_mouth_area = 0;                      // [m2]
};
template <Of<CanopyMotion> T, class Visit>
void each_member(T& c, Visit&& visit) {
  visit("size_ratio", c.size_ratio);
  visit("mean_spread_angle_deg", c.mean_spread);
  visit("spread_angle_standard_deviation_deg", c.spread_deviation);
  visit("mean_riser_load_n", c.mean_load);
  visit("largest_riser_load_n", c.largest_load);
  visit("largest_riser_load_time_s", c.largest_load_time);
  visit("mean_mouth_area_m2", c.mean_mouth_area);
}

struct ClusterMotion {
  double mean_spread = 0;       // over canopies and time [deg]
  double spread_deviation = 0;  // standard deviation over time of the mean over the canopies [deg]
  double smallest_gap = 0, smallest_gap_time = 0;  // of the whole flight [m], [s]
  double contact_gap = 0;                          // nodes that are nearer count as contact [m]
  std::optional<double> first_contact;             // [s]
  double contact_share = 0;                        // of the time of the whole flight
  std::vector<CanopyMotion> canopies;
};
template <Of<ClusterMotion> T, class Visit>
void each_member(T& c, Visit&& visit) {
  visit("mean_spread_angle_deg", c.mean_spread);
  visit("spread_angle_standard_deviation_deg", c.spread_deviation);
  visit("smallest_gap_m", c.smallest_gap);
  visit("smallest_gap_time_s", c.smallest_gap_time);
  visit("contact_gap_m", c.contact_gap);
  visit("first_contact_s", c.first_contact);
  visit("contact_time_share", c.contact_share);
  visit("canopies", c.canopies);
}

/// Of rows in the order of time, in which every time has one row for each canopy. The flight began at `begin`, means are
/// taken from `from` on [s]. Throws Error(usage) without a row after that.
ClusterMotion summarise_cluster(const std::vector<CanopyRow>& rows, int canopies, double begin, double from,
                                double contact_gap);

/// The opening of one canopy of a cluster.
struct CanopyOpening {
  std::optional<double> size_ratio;     // over the largest canopy; absent: all are equal
  std::optional<double> delay;          // until then it stays folded; absent: no canopy has one [s]
  double peak_load = 0, peak_time = 0;  // of the riser, of all rows after the start-up [N], [s]
  double last_load = 0;                 // mean over the last fifth [N]
  std::optional<double> filling_time;   // filling_of() the area of its mouth; absent: it has not filled [s]
  double last_spread = 0;               // spread angle at the end [deg]
};
template <Of<CanopyOpening> T, class Visit>
void each_member(T& c, Visit&& visit) {
  visit("size_ratio", c.size_ratio);
  visit("delay_s", c.delay);
  visit("peak_riser_load_n", c.peak_load);
  visit("peak_riser_load_time_s", c.peak_time);
  visit("last_riser_load_n", c.last_load);
  visit("filling_time_s", c.filling_time);
  visit("last_spread_angle_deg", c.last_spread);
}

struct ClusterOpening {
  std::vector<CanopyOpening> canopies;
  double peak_difference = 0;  // between the times of the peaks of two canopies, the largest [s]
  std::optional<double> filling_difference;  // of the filling times; absent: a canopy has not filled [s]
  double smallest_gap = 0, smallest_gap_time = 0;  // of the canopies [m], [s]
};
template <Of<ClusterOpening> T, class Visit>
void each_member(T& c, Visit&& visit) {
  visit("canopies", c.canopies);
  visit("peak_time_difference_s", c.peak_difference);
  visit("filling_time_difference_s", c.filling_difference);
  visit("smallest_gap_m", c.smallest_gap);
  visit("smallest_gap_time_s", c.smallest_gap_time);
}

/// Of rows in the order of time, in which every time has one row for each canopy; peaks are sought after `start_up` [s].
/// `delays` of the canopies [s]: empty, or one for each. All times are from the start of the opening.
ClusterOpening summarise_openings(const std::vector<CanopyRow>& rows, int canopies, double start_up,
                                  const std::vector<double>& delays = {});

}  // namespace ripstop::inline fsi
