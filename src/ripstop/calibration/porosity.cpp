#include "ripstop/calibration/porosity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "ripstop/core/error.h"

namespace ripstop::inline calibration {
namespace {

/// Drag area over the knob, averaged over the shifts, as straight pieces.
class Curve {
 public:
  void add(double knob, double area) { points_[knob].push_back(area); }
  void close() {
    for (const auto& [knob, areas] : points_) {
      x_.push_back(knob);
      y_.push_back(mean(areas));
    }
  }
  std::size_t size() const { return x_.size(); }
  double low() const { return x_.front(); }
  double high() const { return x_.back(); }
  double slope(double x) const {
    const std::size_t i = piece(x);
    return (y_[i + 1] - y_[i]) / (x_[i + 1] - x_[i]);
  }
  double operator()(double x) const { return y_[piece(x)] + slope(x) * (x - x_[piece(x)]); }
  const std::map<double, std::vector<double>>& points() const { return points_; }

 private:
  std::size_t piece(double x) const {
    const auto above = std::upper_bound(x_.begin(), x_.end(), x) - x_.begin();
    return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - 1, 0, std::ptrdiff_t(x_.size()) - 2));
  }
  std::map<double, std::vector<double>> points_;
  std::vector<double> x_, y_;
};

// Sum of squared misfits of the drag areas.
double squares(const std::vector<Curve>& curves, const std::vector<MeasuredDrag>& measured, double knob) {
  double sum = 0;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const double miss = curves[i](knob) - measured[i].drag_area();
    sum += miss * miss;
  }
  return sum;
}

/// The sum is a parabola between neighbouring values of the knob: the least of all its least points.
double best_knob(const std::vector<Curve>& curves, const std::vector<MeasuredDrag>& measured,
                 const std::vector<double>& knobs) {
  double best = knobs.front(), least = INFINITY;
  for (std::size_t k = 0; k + 1 < knobs.size(); ++k) {
    const double middle = 0.5 * (knobs[k] + knobs[k + 1]);
    double above = 0, below = 0;
    for (std::size_t i = 0; i < curves.size(); ++i) {
      const double slope = curves[i].slope(middle);
      above += slope * (measured[i].drag_area() - curves[i](middle));
      below += slope * slope;
    }
    if (!(below > 0)) throw Error(ExitCode::bad_data, "the computed drag does not depend on the porosity");
    double x = middle + above / below;
    if (k > 0) x = std::max(x, knobs[k]);
    if (k + 2 < knobs.size()) x = std::min(x, knobs[k + 1]);
    const double sum = squares(curves, measured, x);
    if (sum < least) least = sum, best = x;
  }
  return best;
}

}  // namespace

PressureDrop cloth_of(PorosityKnob knob, double value, double thickness) {
  return knob == PorosityKnob::gamma ? ergun({value, thickness}) : law_of_cfm(value);
}

double PorosityCalibration::error() const {
  return std::hypot(error_measured, error_computed);
}

PorosityCalibration calibrate_porosity(const std::vector<MeasuredDrag>& measured,
                                       const std::vector<PorosityTrial>& trials, double reference_area) {
  if (measured.empty()) throw Error(ExitCode::bad_data, "no measured drag for the calibration");
  std::vector<Curve> curves(measured.size());
  std::vector<std::vector<double>> knobs(measured.size()), areas(measured.size());
  std::vector<double> all_knobs, coefficients, values;
  for (const PorosityTrial& trial : trials) {
    curves.at(trial.condition).add(trial.knob, trial.drag_area);
    knobs[trial.condition].push_back(trial.knob);
    areas[trial.condition].push_back(trial.drag_area);
    all_knobs.push_back(trial.knob);
    coefficients.push_back(trial.drag_area / reference_area);
    values.push_back(trial.knob);
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  for (std::size_t i = 0; i < curves.size(); ++i) {
    curves[i].close();
    if (curves[i].size() < 2)
      throw Error(ExitCode::bad_data,
                  fmt::format("two values of the porosity are needed at {} m/s, there are {}",
                              measured[i].nominal_speed, curves[i].size()));
  }

  PorosityCalibration found;
  found.coefficient = fit_line(all_knobs, coefficients);
  found.knob = best_knob(curves, measured, values);
  double slopes = 0, computed_variance = 0, scatter = 0;
  int shifted = 0;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    found.lines.push_back(fit_line(knobs[i], areas[i]));
    found.computed.push_back(curves[i](found.knob));
    found.outside = found.outside || found.knob < curves[i].low() || found.knob > curves[i].high();
    const double slope = curves[i].slope(found.knob), error = found.lines[i].error_at(found.knob);
    slopes += slope * slope;
    computed_variance += slope * slope * error * error;
    found.misfit += std::pow(found.computed[i] / measured[i].drag_area() - 1, 2) / double(curves.size());
    for (const auto& [knob, of_shifts] : curves[i].points()) {
      if (of_shifts.size() < 2) continue;
      for (const double area : of_shifts) scatter += std::pow(area / mean(of_shifts) - 1, 2), ++shifted;
    }
  }
  found.misfit = std::sqrt(found.misfit);
  if (shifted) found.shift_scatter = std::sqrt(scatter / shifted);
  found.error_computed = std::sqrt(computed_variance) / slopes;
  const int freedom = static_cast<int>(measured.size()) - 1;
  if (freedom > 0) found.error_measured = std::sqrt(squares(curves, measured, found.knob) / freedom / slopes);
  found.interval = found.error() * (freedom > 0 ? student_t(0.95, freedom) : 1.96);
  return found;
}

}  // namespace ripstop::inline calibration
