#include "ripstop/run/engine.h"

namespace ripstop {

const EngineRecord& engine_of(const Case& value) {
  return engine_of(value.flow.engine);
}

EngineOptions engine_options(const Case& value) {
  EngineOptions options;
  options.second_order = value.flow.convection == Convection::second_order;
  options.ranks = value.flow.ranks;
  options.time_limit_s = value.flow.time_limit_s;
  return options;
}

}  // namespace ripstop
