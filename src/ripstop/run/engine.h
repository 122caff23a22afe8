// The flow engine of a case.
#pragma once

#include "ripstop/case/case.h"
#include "ripstop/flow/engines.h"

namespace ripstop {

const EngineRecord& engine_of(const Case& given);
/// What the case says to its engine; threads and folders are the run's.
EngineOptions engine_options(const Case& given);

}  // namespace ripstop
