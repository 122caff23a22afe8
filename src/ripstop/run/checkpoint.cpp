#include "ripstop/run/checkpoint.h"

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/run/json.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

// Of SteadyState's list of members: one more with every change of it.
constexpr int format_version = 4;

}  // namespace

std::string to_bytes(const SteadyState& state) {
  return to_cbor(state, format_version);
}

SteadyState steady_state_from_bytes(const std::string& bytes) {
  return from_cbor<SteadyState>(bytes, format_version, "a checkpoint of a steady run");
}

void save_checkpoint(const fs::path& folder, const SteadyState& state, const Flow& flow) {
  make_folder(folder);
  const std::string name = state.iterations.size() % 2 == 0 ? "even" : "odd";
  std::error_code ignored;
  fs::remove_all(folder / name, ignored);
  make_folder(folder / name);
  write_sealed(folder / name / "state", to_bytes(state));
  make_folder(folder / name / "flow");
  flow.save(folder / name / "flow");
  write_sealed(folder / "current", name);
}

std::optional<SteadyState> load_checkpoint(const fs::path& folder, Flow& flow) {
  if (!fs::exists(folder / "current")) return std::nullopt;
  const std::string name = read_sealed(folder / "current");
  if (name != "even" && name != "odd") {
    throw Error(ExitCode::bad_data, fmt::format("{}: names no checkpoint", (folder / "current").string()));
  }
  SteadyState state = steady_state_from_bytes(read_sealed(folder / name / "state"));
  flow.restore(folder / name / "flow");
  return state;
}

}  // namespace ripstop
