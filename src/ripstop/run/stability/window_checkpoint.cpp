#include "ripstop/run/stability/window_checkpoint.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/run/json.h"

namespace ripstop {

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
constexpr const char* flow_folders[] = {"even", "odd"};

struct Steps {
  std::vector<FlowStep> steps;
  int flow = 0;  // which of its two folders
};
template <Of<Steps> T, class Visit>
void each_member(T& saved, Visit&& visit) {
  visit("steps", saved.steps);
  visit("flow", saved.flow);
}

double time_on_the_wall() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

WindowCheckpoint::WindowCheckpoint(ClaimedFolder& folder, double every_s)
    : folder_(folder), every_(every_s), saved_(time_on_the_wall()) {}

std::optional<FlowRecord> WindowCheckpoint::resume(Flow& flow) {
  const fs::path file = folder_.path() / window_folder / steps_file;
  if (!fs::exists(file)) return {};
  Steps saved = from_cbor<Steps>(read_sealed(file), window_format, "a checkpoint of an averaging window");
  const int which = std::clamp(saved.flow, 0, 1);
  flow.restore(folder_.path() / window_folder / flow_folders[which]);
  next_ = 1 - which;
  FlowRecord record;
  record.steps = std::move(saved.steps);
  return record;
}

void WindowCheckpoint::look(const Flow& flow, const FlowRecord& record) {
  if (time_on_the_wall() - saved_ < every_) return;
  const fs::path folder = folder_.own(window_folder);
  make_folder(folder / flow_folders[next_]);
  flow.save(folder / flow_folders[next_]);
  write_sealed(folder / steps_file, to_cbor(Steps{record.steps, next_}, window_format));
  next_ = 1 - next_, saved_ = time_on_the_wall();
}

void WindowCheckpoint::remove() const {
  remove_path(folder_.path() / window_folder);
}

}  // namespace ripstop
