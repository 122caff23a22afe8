#include "ripstop/run/steady/checkpoint.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/run/checkpoint_parts.h"
#include "ripstop/run/json.h"

namespace ripstop::inline run {
namespace {

namespace fs = std::filesystem;

// Of SteadyState's list of members: one more with every change of it.
constexpr int format_version = 13;

}  // namespace

std::string to_bytes(const SteadyState& state) {
  return to_cbor(state, format_version);
}

SteadyState steady_state_from_bytes(const std::string& bytes) {
  return from_cbor<SteadyState>(bytes, format_version, "a checkpoint of a steady run");
}

void save_checkpoint(const fs::path& folder, const SteadyState& state, const Flow& flow) {
  make_folder(folder);
  const std::string name = alternating_folders[state.iterations.size() % 2];
  remove_path(folder / name);
  make_folder(folder / name);
  write_sealed(folder / name / "state", to_bytes(state));
  make_folder(folder / name / "flow");
  flow.save(folder / name / "flow");
  write_sealed(folder / "current", name);
}

namespace {

/// Of the two, the one that `current` names first.
std::vector<std::string> in_turn(const fs::path& folder) {
  std::vector<std::string> names(alternating_folders.rbegin(), alternating_folders.rend());
  try {
    if (read_sealed(folder / "current") == names[1]) std::swap(names[0], names[1]);
  } catch (const Error&) {  // damaged, or never written: any whole one will do
  }
  return names;
}

}  // namespace

std::optional<LoadedCheckpoint> load_checkpoint(const fs::path& folder, Flow& flow) {
  std::string damage;
  for (const std::string& name : in_turn(folder)) {
    try {
      LoadedCheckpoint loaded{steady_state_from_bytes(read_sealed(folder / name / "state")), damage};
      flow.restore(folder / name / "flow");
      return loaded;
    } catch (const Error& error) {
      if (damage.empty()) damage = error.what();
    }
  }
  // One that nothing names was never whole: a start that was killed.
  if (damage.empty() || !fs::exists(folder / "current")) return std::nullopt;
  throw Error(ExitCode::bad_data,
              damage + "; the run has no other complete checkpoint: start again with --fresh");
}

}  // namespace ripstop::inline run
