// The flow engine of a case.
#pragma once

#include <filesystem>

#include "ripstop/case/settings.h"
#include "ripstop/flow/engines.h"

namespace ripstop::inline run {

const EngineRecord& engine_of(const Settings& resolved);
/// Engine settings of the case; threads and folders are those of the run.
EngineOptions engine_options(const Settings& resolved);
/// Throws the error of the run about its hostfile, and Error(usage) if there are no ranks for hosts; an empty
/// path is no hostfile. The hosts of the ranks change no result, so they are not a key of the case.
void require_hosts(const std::filesystem::path& hostfile, const Settings& resolved);

}  // namespace ripstop::inline run
