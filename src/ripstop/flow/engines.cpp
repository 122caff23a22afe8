#include "ripstop/flow/engines.h"

#include <fmt/format.h>

#include <algorithm>

#include "ripstop/core/error.h"
#include "ripstop/flow/boundaries.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/openfoam/installation.h"
#include "ripstop/flow/openfoam/openfoam.h"

namespace ripstop::inline flow {
namespace {

std::vector<std::string> words_of(const std::vector<std::unique_ptr<BoundaryRecord>>& rows) {
  std::vector<std::string> words;
  for (const auto& row : rows) words.push_back(row->word);
  return words;
}

EngineRecord builtin() {
  const auto make = [](const EngineOptions& options) {
    CartesianSettings settings;
    settings.threads = options.threads;
    settings.second_order = options.second_order;
    settings.small_eddies = options.small_eddies;
    return make_cartesian(settings);
  };
  return {"builtin",
          "the built-in solver",
          {.sheets = true,
           .jets = true,
           .averages = true,
           .ranks = false,
           .fitted_meshes = false,
           .other_air = true,
           .time = true,
           .other_cells = true,
           .quarters = true,
           .boundaries = words_of(boundaries())},
          [](const EngineOptions&) { return make_cartesian()->name(); },
          make};
}

EngineRecord openfoam_rho_porous() {
  const auto make = [](const EngineOptions& options) {
    OpenFoamSettings settings;
    settings.folder = options.folder;
    settings.ranks = options.ranks;
    settings.second_order = options.second_order;
    settings.fitted_mesh = options.fitted_mesh;
    settings.cloth_levels = options.cloth_levels;
    settings.hostfile = options.hostfile;
    if (options.time_limit_s > 0) settings.time_limit_s = options.time_limit_s;
    return make_openfoam(settings);
  };
  return {"openfoam",
          "rhoPorousSimpleFoam of OpenFOAM with the same equations, simpleFoam for sheets",
          {.sheets = true,
           .ranks = true,
           .fitted_meshes = true,
           .quarters = true,
           .boundaries = {"zero-gradient", "slip", "far-field", "fixed-pressure"}},
          [](const EngineOptions& options) {
            return "OpenFOAM " + openfoam::find_installation({}, options.ranks > 1).version;
          },
          make,
          true,
          // Table of docs/guide/cluster.md; the time is that of the printed grid, whose cells fit no cache.
          {.cell_time = 5e-6, .cell_memory = 1.4e3, .rank_memory = 1.2e8}};
}

std::vector<EngineRecord>& table() {
  static std::vector<EngineRecord> rows = {builtin(), openfoam_rho_porous()};
  return rows;
}

}  // namespace

bool Abilities::has_boundary(std::string_view word) const {
  return std::find(boundaries.begin(), boundaries.end(), word) != boundaries.end();
}

const std::vector<EngineRecord>& engines() {
  return table();
}

void add_engine(EngineRecord engine) {
  table().push_back(std::move(engine));
}

const EngineRecord& engine_of(const std::string& word) {
  std::string known;
  for (const EngineRecord& engine : engines()) {
    if (engine.word == word) return engine;
    known += (known.empty() ? "" : ", ") + engine.word;
  }
  throw Error(ExitCode::usage, fmt::format("there is no flow engine \"{}\"; available: {}", word, known));
}

std::vector<Lack> lacks(const EngineRecord& engine, const Abilities& wanted) {
  const struct {
    bool Abilities::*ability;
    Lack lack;
  } all[] = {{&Abilities::sheets, {"porosity model", "sheet", "paper"}},
             {&Abilities::jets, {"kind of tunnel", "open-jet", "free-air or closed"}},
             {&Abilities::averages, {"iterations of the mean", "more than 0", "0"}},
             {&Abilities::time, {"unsteady flow", "true", "false"}},
             {&Abilities::quarters, {"symmetry of the flow", "quarter", "full"}},
             {&Abilities::ranks, {"MPI ranks", "more than 1", "1"}},
             {&Abilities::fitted_meshes, {"kind of mesh", "fitted", "grid"}}};
  std::vector<Lack> result;
  for (const auto& one : all)
    if (wanted.*one.ability && !(engine.can.*one.ability)) result.push_back(one.lack);
  for (const auto& row : boundaries()) {
    if (!wanted.has_boundary(row->word) || engine.can.has_boundary(row->word)) continue;
    std::string instead;
    for (const auto& other : boundaries())
      if (bool(other->sides) == bool(row->sides) && engine.can.has_boundary(other->word))
        instead += (instead.empty() ? "" : " or ") + other->word;
    result.push_back({row->sides ? "sides" : "outlet", row->word, instead});
  }
  return result;
}

}  // namespace ripstop::inline flow
