// The folder of a curve over the angle of attack: the steady run on the axis (axis/), a folder for each angle, tables
// and plots.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/run/run_folder.h"
#include "ripstop/run/stability/stability.h"
#include "ripstop/run/steady/steady.h"

namespace ripstop::inline run {

struct StabilitySettings {
  RunSettings run;
  int threads = 0;               // 0: coupling.threads
  int across = 16;               // cells over the projected diameter
  bool equilibrium = false;      // the canopy deforms under the mean load, restrained at vent and confluence
  bool warm = true;              // each angle starts from the flow of the one before
  std::filesystem::path steady;  // folder of a finished steady run with the shape; empty: computed in axis/
  bool elsewhere = false;        // another machine runs it: this one's memory does not matter
  double checkpoint_every_s = 60;  // of wall time, within an angle
};

/// Receives the events of a curve.
class StabilityObserver {
 public:
  virtual ~StabilityObserver() = default;
  /// Receives those of the steady run on the axis.
  virtual SteadyObserver& axis() = 0;
  /// Before the first angle; `so_far` has no rows yet.
  virtual void begin(const StabilityResult& /*so_far*/, const std::string& /*engine*/) {}
  virtual void warned(const std::string&) {}
  /// Of an angle of attack under way, by its place in the list; `share` of it lies behind.
  virtual void progress(std::size_t /*angle*/, const std::string& /*text*/, double /*share*/) {}
  /// `earlier`: an earlier call computed it.
  virtual void ended(std::size_t /*angle*/, const StabilityRow&, bool /*earlier*/) {}
};

/// Computes the missing rows of the folder. stability.csv has a row as soon as its angle has ended. Throws
/// Error(usage) for inputs that no curve can have and for a folder with other files, and the exceptions of the steady
/// run and the flow; finished angles are kept.
StabilityResult run_stability(const Case& given, const std::vector<double>& angles,
                              const StabilitySettings& settings, StabilityObserver& observer);

/// Throws the exceptions of run_stability() before it computes, and changes nothing.
void check_stability(const Case& given, const std::vector<double>& angles, const StabilitySettings& settings);

/// Name of an angle's folder: "angle=10".
std::string angle_name(double angle);
/// And of the folder of the steady run.
inline constexpr const char* axis_name = "axis";

/// The parts of a curve by their folders, in waves: each part needs those of earlier waves only.
std::vector<std::vector<std::string>> stability_waves(const Case& given, const std::vector<double>& angles,
                                                      const StabilitySettings& settings);
/// Makes the folder of a curve whose parts are computed one by one elsewhere. Throws as check_stability().
void prepare_stability(const Case& given, const std::vector<double>& angles,
                       const StabilitySettings& settings);
/// One part in that folder, which is not claimed, so that other processes may compute other parts. Throws Error(usage)
/// for another name, Error(io) where a part that it needs has not ended.
void run_stability_part(const Case& given, const std::vector<double>& angles,
                        const StabilitySettings& settings, const std::string& name,
                        StabilityObserver& observer);
/// Tables and plots of the angles that have ended; computes nothing. `missing`: folders of the others.
StabilityResult gather_stability(const Case& given, const std::vector<double>& angles,
                                 const StabilitySettings& settings, std::vector<std::string>& missing,
                                 StabilityObserver& observer);

}  // namespace ripstop::inline run
