#include "ripstop/run/engine.h"

#include "ripstop/case/settings.h"
#include "ripstop/core/error.h"
#include "ripstop/flow/openfoam/hostfile.h"

namespace ripstop::inline run {

const EngineRecord& engine_of(const Settings& resolved) {
  return flow::engine_of(resolved.flow().engine);
}

EngineOptions engine_options(const Settings& resolved) {
  EngineOptions options;
  options.second_order = resolved.flow().convection == Convection::second_order;
  options.fitted_mesh = resolved.flow().mesh == FlowMesh::fitted;
  options.cloth_levels = resolved.flow().cloth_levels;
  options.ranks = resolved.flow().ranks;
  options.time_limit_s = resolved.flow().time_limit_s;
  return options;
}

void require_hosts(const std::filesystem::path& hostfile, const Settings& resolved) {
  if (hostfile.empty()) return;
  if (!engine_of(resolved).can.ranks || resolved.flow().ranks < 2)
    throw Error(ExitCode::usage, "--hostfile: requires --flow openfoam and --ranks of 2 or more");
  openfoam::require_slots(hostfile, resolved.flow().ranks);
}

}  // namespace ripstop::inline run
