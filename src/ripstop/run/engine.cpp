#include "ripstop/run/engine.h"

#include "ripstop/case/resolve.h"

namespace ripstop {

const EngineRecord& engine_of(const Case& given) {
  return engine_of(given.flow.engine);
}

EngineOptions engine_options(const Case& given) {
  EngineOptions options;
  options.second_order = resolve(given).flow.convection == Convection::second_order;
  options.ranks = given.flow.ranks;
  options.time_limit_s = given.flow.time_limit_s;
  return options;
}

}  // namespace ripstop
