#include "ripstop/run/engine.h"

#include "ripstop/case/resolve.h"
#include "ripstop/core/error.h"
#include "ripstop/flow/openfoam/hostfile.h"

namespace ripstop {

const EngineRecord& engine_of(const Case& given) {
  return engine_of(given.flow.engine);
}

EngineOptions engine_options(const Case& given) {
  EngineOptions options;
  options.second_order = resolve(given).flow.convection == Convection::second_order;
  options.fitted_mesh = given.flow.mesh == FlowMesh::fitted;
  options.cloth_levels = given.flow.cloth_levels;
  options.ranks = given.flow.ranks;
  options.time_limit_s = given.flow.time_limit_s;
  return options;
}

void require_hosts(const std::filesystem::path& hostfile, const Case& given) {
  if (hostfile.empty()) return;
  if (!engine_of(given).can.ranks || given.flow.ranks < 2)
    throw Error(ExitCode::usage,
                "--hostfile: needs ranks to put on hosts: --flow openfoam and --ranks of 2 or more");
  openfoam::require_slots(hostfile, given.flow.ranks);
}

}  // namespace ripstop
