// A method of run_load() by its name.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "ripstop/run/opening/load.h"

namespace ripstop {

inline const MethodLoad& method(const StageLoads& stage, std::string_view name) {
  for (const MethodLoad& m : stage.methods)
    if (m.method == name) return m;
  throw std::runtime_error("no method " + std::string(name));
}

}  // namespace ripstop
