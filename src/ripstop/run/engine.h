// The flow engine of a case.
#pragma once

#include <filesystem>

#include "ripstop/case/settings.h"
#include "ripstop/flow/engines.h"

namespace ripstop {

const EngineRecord& engine_of(const Settings& resolved);
/// What the case says to its engine; threads and folders are the run's.
EngineOptions engine_options(const Settings& resolved);
/// Throws what the run would throw about its hostfile, and Error(usage) where there is nothing to put on hosts: an
/// empty path is none. Where ranks run changes no number, so that it is no key of the case.
void require_hosts(const std::filesystem::path& hostfile, const Settings& resolved);

}  // namespace ripstop
