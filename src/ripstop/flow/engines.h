// The flow engines: one row contains the word of an engine, its abilities and its factory. A new engine is a
// separate folder and its row in engines.cpp.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "ripstop/flow/flow.h"

namespace ripstop::inline flow {

/// Settings of a run for any engine; an engine ignores those that it does not use.
struct EngineOptions {
  bool second_order = false;                     // convection of the velocity; false: upwind
  SmallEddies small_eddies = SmallEddies::wale;  // in time
  bool fitted_mesh = false;                      // cells moved onto the sheets
  int cloth_levels = 0;                          // fitted: times that the cells at the cloth are halved
  int threads = 0;                               // 0: as many as the process may run on
  int ranks = 1;                                 // processes
  std::filesystem::path folder;                  // of an engine's own files
  std::filesystem::path hostfile;                // for MPI; empty: this machine only
  double time_limit_s = 0;                       // of one child process; 0: none
};

/// Features of an engine that a case may request in addition to the common ones.
struct Abilities {
  bool sheets = false;         // the `sheet` model
  bool jets = false;           // FlowProblem::jet
  bool averages = false;       // a field after every iteration, for Stopping::average_over
  bool ranks = false;          // several processes
  bool fitted_meshes = false;  // EngineOptions::fitted_mesh
  bool other_air = false;      // a saved flow may start one of another speed or density
  bool time = false;           // Flow::march()
  bool other_cells = false;    // Flow::continue_from()
  bool quarters = false;       // FlowProblem::quarter
  std::vector<std::string> boundaries = {"zero-gradient", "slip", "fixed-pressure"};  // words of boundaries.h

  bool has_boundary(std::string_view word) const;
};

/// Memory and time of an engine, measured once: for the estimates of a batch job.
struct EngineCost {
  double cell_time = 1e-7;  // of a cell and iteration [core s]
  double cell_memory = 0;   // beyond Cost::memory [bytes]
  double rank_memory = 0;   // of each process of its own [bytes]
};

struct EngineRecord {
  std::string word;     // of flow.engine
  std::string meaning;  // for the reference, one clause
  Abilities can;
  /// "OpenFOAM 1912": name and version, without making the engine. Throws Error(external) when it is missing.
  std::function<std::string(const EngineOptions&)> name;
  std::function<std::unique_ptr<FlowEngine>(const EngineOptions&)> make;
  bool needs_folder = false;  // EngineOptions::folder
  EngineCost takes = {};
};

/// All engines; the first one is the default.
const std::vector<EngineRecord>& engines();
/// Throws Error(usage) for a word that is none's.
const EngineRecord& engine_of(const std::string& word);
/// One more row, for whoever links an engine of their own to the library: before any case is read.
void add_engine(EngineRecord engine);

/// A quantity whose value the engine has not, and a value that it has.
struct Lack {
  std::string quantity, value, instead;
};
std::vector<Lack> lacks(const EngineRecord& engine, const Abilities& wanted);

}  // namespace ripstop::inline flow
