// Several openings of one case that differ in a seeded perturbation of the folds: mean and scatter.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/run/opening/inflation_folder.h"

namespace ripstop::inline run {

struct Statistic {
  int openings = 0;                                                  // that have the value
  double mean = 0, standard_deviation = 0, lowest = 0, highest = 0;  // of a sample: divided by n - 1
};
template <Of<Statistic> T, class Visit>
void each_member(T& s, Visit&& visit) {
  visit("openings", s.openings);
  visit("mean", s.mean);
  visit("standard_deviation", s.standard_deviation);
  visit("lowest", s.lowest);
  visit("highest", s.highest);
}
/// Of the values that are there; nothing where none is.
std::optional<Statistic> statistic_of(const std::vector<std::optional<double>>& values);

/// result.json of `ripstop inflate --samples`.
struct SampleSummary {
  std::string title;
  int samples = 0;
  std::vector<std::string> folders;  // of the openings, in the order of their seeds
  std::optional<Statistic> peak_load, smooth_peak, filling_time, filling_distance, opening_force_coefficient,
      finite_mass_factor;
  std::vector<std::string> warnings;
  bool usable = true;  // false: one of the openings must not be used
};
template <Of<SampleSummary> T, class Visit>
void each_member(T& s, Visit&& visit) {
  visit("title", s.title);
  visit("samples", s.samples);
  visit("folders", s.folders);
  visit("peak_load_n", s.peak_load);
  visit("low_pass_peak_load_n", s.smooth_peak);
  visit("filling_time_s", s.filling_time);
  visit("filling_distance_diameters", s.filling_distance);
  visit("opening_force_coefficient", s.opening_force_coefficient);
  visit("finite_mass_factor", s.finite_mass_factor);
  visit("warnings", s.warnings);
  visit("usable", s.usable);
}
std::string to_json(const SampleSummary& summary);
/// Statistics and warnings of openings from the texts of their result.json; their folders are in the summary.
void summarise_samples(const std::vector<std::string>& texts, SampleSummary& summary);

/// The case with the folds perturbed by `seed`; by a hundredth of the skirt's folded radius where the case has no
/// imperfection.
Settings with_seed(const Settings& resolved, int seed);

/// Seeds 1 to `samples`, each opening in its own folder below `settings.run.folder`: a finished one is read, an
/// interrupted one resumes. Writes result.json of the summary there. `open` runs one opening in a folder.
SampleSummary run_samples(const InflationFolderSettings& settings, const Settings& resolved, int samples,
                          const std::function<void(const InflationFolderSettings&, const Settings&)>& open);

}  // namespace ripstop::inline run
