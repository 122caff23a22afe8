// The folder of one opening: run.json, history.csv and balance.csv while it runs, shapes for ParaView,
// checkpoint, and at the end the plot, the contact sheet and result.json.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/output/plot.h"
#include "ripstop/run/opening/inflation.h"
#include "ripstop/run/run_folder.h"

namespace ripstop::inline run {

struct InflationFolderSettings {
  RunSettings run;
  int threads = 0;                 // as run.json has it
  double checkpoint_every_s = 10;  // of wall time, at the next frame
  bool keep_end = true;            // of the air about a payload, from which a flight continues
};

/// run_inflation() in a folder, from the folded start or from the state of a killed run. Returns nothing when the
/// folder contains the finished run, whose result.json is finished_result(folder). The problem is made only when
/// there is something to compute. Throws as holds_run() and run_inflation() do.
std::optional<InflationResult> run_inflation_in(const InflationFolderSettings& settings,
                                                const Settings& resolved, const LoadSource& source,
                                                const std::function<InflationProblem()>& problem,
                                                InflationObserver& observer);

/// Throws the exceptions of run_inflation_in() before the problem is made, and changes nothing.
void check_inflation_in(const InflationFolderSettings& settings, const Settings& resolved,
                        const LoadSource& source);

/// load.png: the load over time, with the loads for comparison. `smooth`: low-passed, by row [N]; empty:
/// none.
Plot load_plot(const std::vector<HistoryRow>& rows, const std::vector<double>& smooth,
               const InflationResult& result);

/// Every double bit for bit. inflation_state_from_bytes() throws Error(bad_data) for anything else.
std::string to_bytes(const InflationState& state);
InflationState inflation_state_from_bytes(const std::string& bytes);

}  // namespace ripstop::inline run
