// State from which a killed run resumes: that of the coupling and that of the flow engine; damage is
// detected.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "ripstop/flow/flow.h"
#include "ripstop/fsi/steady_loop.h"

namespace ripstop::inline run {

/// Every double bit for bit (CBOR). from_bytes() throws Error(bad_data) for anything
/// to_bytes() did not write.
std::string to_bytes(const SteadyState& state);
SteadyState steady_state_from_bytes(const std::string& bytes);

/// Two folders in turn, and a sealed file that names the whole one: the last checkpoint stays good until the
/// next is on the disk. Throws Error(io).
void save_checkpoint(const std::filesystem::path& folder, const SteadyState& state, const Flow& flow);
struct LoadedCheckpoint {
  SteadyState state;
  std::string damage;  // of the newer checkpoint that this older one replaces; empty: this is the newest
};
/// The last whole checkpoint, or nothing when there is none. Throws Error(bad_data) when all
/// there are are damaged.
std::optional<LoadedCheckpoint> load_checkpoint(const std::filesystem::path& folder, Flow& flow);

}  // namespace ripstop::inline run
