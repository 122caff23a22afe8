#include "ripstop/run/stability/window_checkpoint.h"

#include <filesystem>

#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/run/json.h"

namespace ripstop::inline run {

template <Of<BodyLoad> T, class Visit>
void each_member(T& load, Visit&& visit) {
  visit("force", load.force);
  visit("moment", load.moment);
}
template <Of<FlowStep> T, class Visit>
void each_member(T& step, Visit&& visit) {
  visit("step", step.step);
  visit("time", step.time);
  visit("length", step.length);
  visit("courant", step.courant);
  visit("force", step.force);
  visit("bodies", step.bodies);
  visit("momentum_gap", step.momentum_gap);
  visit("mass_defect", step.mass_defect);
}

namespace {

namespace fs = std::filesystem;

constexpr int window_format = 1;
constexpr const char* window_folder = "window/";
constexpr const char* steps_file = "steps";

struct Steps {
  std::vector<FlowStep> steps;
  int flow = 0;  // which of its two folders
};
template <Of<Steps> T, class Visit>
void each_member(T& saved, Visit&& visit) {
  visit("steps", saved.steps);
  visit("flow", saved.flow);
}

}  // namespace

WindowCheckpoint::WindowCheckpoint(ClaimedFolder& folder, double every_s)
    : folder_(folder), timer_(every_s) {}

std::optional<FlowRecord> WindowCheckpoint::resume(Flow& flow) {
  const fs::path file = folder_.path() / window_folder / steps_file;
  if (!fs::exists(file)) return {};
  Steps saved = from_cbor<Steps>(read_sealed(file), window_format, "a checkpoint of an averaging window");
  const std::size_t which = saved.flow == 0 ? 0 : 1;
  flow.restore(folder_.path() / window_folder / alternating_folders[which]);
  next_ = 1 - which;
  FlowRecord record;
  record.steps = std::move(saved.steps);
  return record;
}

void WindowCheckpoint::look(const Flow& flow, const FlowRecord& record) {
  if (!timer_.due()) return;
  const fs::path folder = folder_.own(window_folder);
  make_folder(folder / alternating_folders[next_]);
  flow.save(folder / alternating_folders[next_]);
  write_sealed(folder / steps_file, to_cbor(Steps{record.steps, static_cast<int>(next_)}, window_format));
  next_ = 1 - next_;
  timer_.restart();
}

void WindowCheckpoint::remove() const {
  remove_path(folder_.path() / window_folder);
}

}  // namespace ripstop::inline run
