// The flow engine of a case.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "ripstop/case/case.h"
#include "ripstop/flow/flow.h"

namespace ripstop {

/// Where an engine works, and with what.
struct EngineSettings {
  int threads = 0;                 // 0: as many as the machine has
  std::filesystem::path folder;    // of OpenFOAM's case; it is cleared
  std::filesystem::path hostfile;  // for MPI; empty: none
};

/// The flow engine of a case by name and version, known before it is made. Throws Error(external) where
/// OpenFOAM is asked for and missing.
std::string name_of_engine(const Case& value);
std::unique_ptr<FlowEngine> make_engine(const Case& value, const EngineSettings& settings);

}  // namespace ripstop
