#include "ripstop/run/engine.h"

#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/openfoam/installation.h"
#include "ripstop/flow/openfoam/openfoam.h"

namespace ripstop {

std::string name_of_engine(const Case& value) {
  if (value.flow.engine == EngineKind::builtin) return make_cartesian()->name();
  return "OpenFOAM " + openfoam::find_installation({}, value.flow.ranks > 1).version;
}

std::unique_ptr<FlowEngine> make_engine(const Case& value, const EngineSettings& settings) {
  const bool second_order = value.flow.convection == Convection::second_order;
  if (value.flow.engine == EngineKind::builtin) {
    CartesianSettings cartesian;
    cartesian.threads = settings.threads;
    cartesian.second_order = second_order;
    return make_cartesian(cartesian);
  }
  OpenFoamSettings foam;
  foam.folder = settings.folder;
  foam.ranks = value.flow.ranks;
  foam.second_order = second_order;
  foam.hostfile = settings.hostfile;
  foam.time_limit_s = value.flow.time_limit_s > 0 ? value.flow.time_limit_s : 1e9;
  return make_openfoam(foam);
}

}  // namespace ripstop
