#include "ripstop/parachute/gore.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ripstop::inline parachute {
namespace {

using std::numbers::pi;

double interpolate(const std::vector<Station>& stations, double height, double Station::*what) {
  std::size_t i = 1;
  while (i + 1 < stations.size() && stations[i].height < height) ++i;
  const Station& a = stations[i - 1];
  const Station& b = stations[i];
  const double share = std::clamp((height - a.height) / (b.height - a.height), 0.0, 1.0);
  return a.*what + share * (b.*what - a.*what);
}

}  // namespace

double GoreStrip::width(double height) const {
  return interpolate(stations, height, &Station::width);
}

double GoreStrip::chord(double height) const {
  return interpolate(stations, height, &Station::chord);
}

double polygon_scale(int gores) {
  return std::sqrt(pi / (gores * std::tan(pi / gores)));
}

GoreStrip strip_on(const std::string& name, const std::function<double(double)>& radius, double from,
                   double to, int gores, double leading, double trailing) {
  constexpr int pieces = 64;  // a quarter circle in so many chords has its area within 3e-5
  const double q = polygon_scale(gores);
  GoreStrip strip;
  strip.name = name;
  for (int i = 0; i <= pieces; ++i) {
    const double share = double(i) / pieces;
    const double chord = 2 * q * radius(from + share * (to - from)) * std::tan(pi / gores);
    const double fullness = leading + share * (trailing - leading);
    strip.stations.push_back({q * share * (to - from), chord * (1 + fullness), chord});
  }
  return strip;
}

Profile start_profile(const GorePattern& pattern) {
  const double per_chord = 0.5 / std::tan(pi / pattern.gores);
  Profile profile;
  ProfilePoint last;
  const auto next = [&](double chord, double distance, bool falls) {
    const double apothem = chord * per_chord, step = apothem - last.apothem;
    const double height = std::sqrt(std::max(0.0, distance * distance - step * step));
    last = {apothem, last.z + (falls ? -height : height)};
    return last;
  };
  for (const GoreStrip& strip : pattern.strips) {
    std::vector<ProfilePoint> points;
    for (std::size_t k = 0; k < strip.stations.size(); ++k) {
      const Station& here = strip.stations[k];
      if (profile.empty() && k == 0) {
        last = {here.chord * per_chord, 0};
        points.push_back(last);
      } else {
        const bool falls = strip.crown >= 0 && k > static_cast<std::size_t>(strip.crown);
        points.push_back(
            next(here.chord, k == 0 ? strip.slot : here.height - strip.stations[k - 1].height, falls));
      }
    }
    profile.push_back(std::move(points));
  }
  return profile;
}

double slot_length(const GorePattern& pattern, int index, double across) {
  if (index == 0) return 0;
  const GoreStrip& strip = pattern.strips[index];
  const double chord_below = pattern.strips[index - 1].stations.back().chord;
  return std::hypot(strip.slot, across * (strip.stations.front().chord - chord_below));
}

double length_along(const GorePattern& pattern, double across) {
  double length = 0;
  for (std::size_t i = 0; i < pattern.strips.size(); ++i) {
    const std::vector<Station>& stations = pattern.strips[i].stations;
    if (pattern.strips[i].slot > 0) length += slot_length(pattern, static_cast<int>(i), across);
    for (std::size_t k = 1; k < stations.size(); ++k)
      length += std::hypot(stations[k].height - stations[k - 1].height,
                           across * (stations[k].width - stations[k - 1].width));
  }
  return length;
}

CanopyFacts facts(const GorePattern& pattern) {
  const int n = pattern.gores;
  CanopyFacts facts;
  facts.nominal_area = pattern.nominal_area;
  facts.vertical_tapes = pattern.vertical_tapes;
  facts.line_run = length_along(pattern, 0.5);
  double widest = 0;
  for (const GoreStrip& strip : pattern.strips) {
    for (std::size_t k = 0; k < strip.stations.size(); ++k) {
      const Station& here = strip.stations[k];
      if (k > 0) {
        const Station& before = strip.stations[k - 1];
        facts.cloth_area += n * (here.height - before.height) * 0.5 * (here.width + before.width);
        facts.covered_area += n * (here.height - before.height) * 0.5 * (here.chord + before.chord);
      }
      widest = std::max(widest, here.chord);
      facts.circumference = std::max(facts.circumference, n * here.width);
    }
  }
  for (std::size_t i = 1; i < pattern.strips.size(); ++i)
    facts.slot_area +=
        n * pattern.strips[i].slot * 0.5 *
        (pattern.strips[i - 1].stations.back().chord + pattern.strips[i].stations.front().chord);
  const double vent = pattern.strips.back().stations.back().chord;
  facts.vent_area = 0.25 * n * vent * vent / std::tan(pi / n);
  const double seam_per_chord = 0.5 / std::sin(pi / n);
  facts.skirt_radius = seam_per_chord * pattern.strips.front().stations.front().chord;
  facts.start_diameter = 2 * seam_per_chord * widest;
  for (const std::vector<ProfilePoint>& points : start_profile(pattern))
    for (const ProfilePoint& point : points) facts.start_depth = std::max(facts.start_depth, point.z);
  return facts;
}

}  // namespace ripstop::inline parachute
