#include "ripstop/run/opening/snatch.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "ripstop/case/deployment.h"
#include "ripstop/core/error.h"
#include "ripstop/core/units.h"
#include "ripstop/core/words.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flight/deployment.h"
#include "ripstop/flight/snatch.h"
#include "ripstop/material/strength.h"
#include "ripstop/run/opening/load.h"

namespace ripstop::inline run {
namespace {

bool gives_difference(const LoadRequest& request) {
  return request.snatch_speed || request.packed_drag_area;
}

/// The snatch of one case and request, whose parts can be changed.
class Snatch {
 public:
  Snatch(const Settings& resolved, const LoadRequest& request, const LoadResult& result)
      : request_(request),
        masses_{result.payload_mass, result.parachute_mass},
        density_(result.density),
        payload_area_(request.payload_drag_area.value_or(resolved.payload().drag_area_m2)) {
    if (gives_difference(request)) return;
    packed_ = packed_parachute(resolved);
    packed_->speed = request.speed, packed_->density = density_;
    packed_->payload_mass = result.payload_mass, packed_->payload_drag_area = payload_area_;
    packed_->gravity = standard_gravity * std::sin(request.path_angle * std::numbers::pi / 180);
  }

  SnatchResult with(const std::vector<SnatchPart>& parts) const {
    SnatchResult snatch;
    if (packed_) {
      PackedParachute packed = *packed_;
      packed.lines = parts;
      const Deployment d = deploy_parachute(packed);
      snatch.from = "[deployment] of the case", snatch.model = deployment_model;
      snatch.speed_difference = d.relative_speed, snatch.load = d.snatch_load;
    } else {
      snatch.from = request_.snatch_speed ? "given" : "drag area of the packed canopy";
      snatch.model = energy_model;
      snatch.speed_difference = request_.snatch_speed ? *request_.snatch_speed : difference(parts);
      const SnatchLoad load = snatch_load(masses_.first, masses_.second, snatch.speed_difference, parts);
      snatch.load = load.load, snatch.time = load.time, snatch.stretch = load.stretch;
    }
    snatch.line_load = snatch.load / parts.front().strands;
    return snatch;
  }

  /// The load with one part changed; nothing where the parts would break.
  std::optional<double> changed(std::vector<SnatchPart> parts, std::size_t part, double length,
                                double stiffness) const {
    parts[part].length *= length;
    for (double& k : parts[part].coefficients) k *= stiffness;
    try {
      return with(parts).load;
    } catch (const Error& error) {
      if (error.code() != ExitCode::usage) throw;
      return {};
    }
  }

 private:
  double difference(const std::vector<SnatchPart>& parts) const {
    double length = 0;
    for (const SnatchPart& part : parts) length += part.length;
    return speed_difference_at_stretch({masses_.first, payload_area_},
                                       {masses_.second, *request_.packed_drag_area}, request_.speed, density_,
                                       length);
  }

  const LoadRequest& request_;
  std::pair<double, double> masses_;  // payload, parachute [kg]
  double density_, payload_area_;
  std::optional<PackedParachute> packed_;
};

}  // namespace

std::string two_snatch_loads(const SnatchResult& s) {
  return fmt::format(
      "two snatch loads: {} N at a speed difference of {} m/s ({}; {}), and {} N at {} m/s ([deployment] "
      "of the case; {}). Lines, riser and hardware are designed for the larger one. Omit the one that does "
      "not "
      "describe your deployment",
      rounded(s.load), rounded(s.speed_difference), s.from, s.model, rounded(*s.other_load),
      rounded(*s.other_speed_difference), deployment_model);
}

std::optional<SnatchResult> snatch_of(const Settings& resolved, const LoadRequest& request,
                                      const LoadResult& result) {
  if (!gives_difference(request) && !resolved.deployment()) return {};
  const Snatch snatch(resolved, request, result);
  const std::vector<SnatchPart> parts = stretching_parts(resolved);
  SnatchResult found = snatch.with(parts);
  const Strength line = strength_of(resolved.materials().line),
                 riser = strength_of(resolved.materials().riser);
  if (line.value) found.line_margin = *line.value / found.line_load;
  if (riser.value && resolved.parachute().riser.length_m > 0) found.riser_margin = *riser.value / found.load;
  if (gives_difference(request) && resolved.deployment()) {
    LoadRequest other = request;
    other.snatch_speed.reset(), other.packed_drag_area.reset();
    const SnatchResult deployed = Snatch(resolved, other, result).with(parts);
    found.other_load = deployed.load, found.other_speed_difference = deployed.speed_difference;
  }
  if (!request.descent) return found;
  for (std::size_t i = 0; i < parts.size(); ++i)
    found.changes.push_back({parts[i].name, snatch.changed(parts, i, 0.5, 1), snatch.changed(parts, i, 2, 1),
                             snatch.changed(parts, i, 1, 0.5), snatch.changed(parts, i, 1, 2)});
  return found;
}

std::optional<double> separation_load(const Settings& resolved, const std::vector<double>& sections,
                                      double speed) {
  std::vector<SnatchPart> cord = stretching_parts(resolved);
  std::erase_if(cord, [&](const SnatchPart& part) { return !resolved.hardware().contains(part.name); });
  if (cord.empty()) return {};
  const double all = std::accumulate(sections.begin(), sections.end(), 0.0);
  double front = 0, most_even = 0;
  for (std::size_t i = 0; i + 1 < sections.size(); ++i) {
    front += sections[i];
    if (front * (all - front) > most_even * (all - most_even)) most_even = front;
  }
  return snatch_load(most_even, all - most_even, speed, cord).load;
}

}  // namespace ripstop::inline run
