#include "ripstop/studio/live_shape.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "ripstop/canopy/shape.h"
#include "ripstop/case/assemble.h"
#include "ripstop/core/error.h"
#include "ripstop/output/vtk.h"
#include "ripstop/report/report.h"
#include "ripstop/report/shape_view.h"
#include "ripstop/run/sizing/fabric.h"

namespace ripstop::inline studio {
namespace {

constexpr std::size_t most_views = 4;
constexpr int threads =
    1;  // the others are left to the page and to runs; results do not depend on their number

struct Superseded {};

std::string answer_json(unsigned number, bool done, const std::string& result, const VtkSurface& canopy,
                        const VtkSurface& lines) {
  return fmt::format("{{\"number\": {}, \"done\": {}, \"result\": {}, \"shape\": {}}}", number, done, result,
                     shape_json(shape_of(canopy, lines)));
}

std::string answer_json(unsigned number, bool done, const FabricSolution& solution) {
  return answer_json(number, done, to_json(solution.result), fabric_canopy(solution), fabric_lines(solution));
}

/// Without stresses: a relaxation passes through states of softened cloth.
std::string passing_json(unsigned number, const Settings& resolved, std::optional<double> pressure,
                         const RelaxProgress& progress, const std::vector<Vec3>& shape) {
  const CanopyMesh mesh = parachute_mesh(resolved);
  const nlohmann::ordered_json result = {
      {"pressure_pa", fabric_pressure(resolved, pressure)},
      {"projected_diameter_m", canopy_size(mesh, shape).projected_diameter},
      {"nodes", mesh.node_count()},
      {"residual", progress.residual},
      {"converged", false}};
  return answer_json(number, false, result.dump(), canopy_surface(mesh, shape), spring_lines(mesh, shape));
}

/// glibc keeps freed memory for each of its threads: some megabytes more after each shape, without end.
void return_freed_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

std::string refining_json(unsigned number, int nodes) {
  return fmt::format("{{\"number\": {}, \"done\": false, \"refining\": {}}}", number, nodes);
}

}  // namespace

LiveShape::LiveShape(double idle_s) : idle_s_(idle_s), worker_([this] { work(); }) {}

LiveShape::~LiveShape() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  worker_.join();
}

unsigned LiveShape::begin(std::vector<Settings> stages, std::optional<double> pressure) {
  const std::lock_guard lock(mutex_);
  next_ = Request{std::move(stages), pressure};
  wanted_ = false;
  changed_.notify_all();
  return ++newest_;
}

std::string LiveShape::answer(unsigned number, double wait_s) {
  std::unique_lock lock(mutex_);
  const auto superseded = [&] { return closing_ || number != newest_; };
  const auto ready = [&] { return superseded() || answer_.number == number; };
  if (!changed_.wait_for(lock, std::chrono::duration<double>(wait_s), ready)) {
    wanted_ = true;
    changed_.notify_all();
    changed_.wait(lock, ready);
  }
  if (superseded()) return "{\"superseded\": true}";
  if (answer_.error) throw Error(answer_.error->first, answer_.error->second);
  if (answer_.done) return answer_.json;
  return std::exchange(answer_, {}).json;  // the next answer is a later one
}

void LiveShape::publish(Answer answer) {
  const std::lock_guard lock(mutex_);
  answer_ = std::move(answer);
  wanted_ = false;
  changed_.notify_all();
}

bool LiveShape::wanted(unsigned number) {
  const std::lock_guard lock(mutex_);
  if (closing_ || number != newest_) throw Superseded();
  return wanted_;
}

void LiveShape::work() {
  for (;;) {
    std::optional<Request> request;
    unsigned number = 0;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return closing_ || next_; });
      if (closing_) return;
      request = std::move(next_);
      next_.reset();
      number = newest_;
    }
    try {
      compute(*request, number);
    } catch (const Superseded&) {  // the next request follows
    } catch (const Error& error) {
      publish({number, true, "", std::pair{error.code(), error.what()}});
    } catch (const std::exception& error) {
      publish({number, true, "", std::pair{ExitCode::resources, std::string(error.what())}});
    }
    return_freed_memory();
  }
}

void LiveShape::compute(const Request& request, unsigned number) {
  const Settings& first = request.stages.front();
  const bool whole = request.stages.size() == 1;
  const RelaxWatch watch = [&](const RelaxProgress& progress, const auto& positions) {
    if (wanted(number))
      publish({number, false, passing_json(number, first, request.pressure, progress, positions()), {}});
  };
  const FabricSolution solution = run_watched_fabric(first, request.pressure, threads, watch);
  publish({number, whole, answer_json(number, whole, solution), {}});
  if (!whole) refine(request, number);
}

void LiveShape::refine(const Request& request, unsigned number) {
  const Settings& last = request.stages.back();
  const auto say = [&] {
    if (wanted(number))
      publish({number, false, refining_json(number, last.parachute().mesh.cloth_nodes), {}});
  };
  rest(number, say);
  const FabricSolution solution =
      run_watched_fabric(last, request.pressure, threads, [&](const RelaxProgress&, const auto&) { say(); });
  publish({number, true, answer_json(number, true, solution), {}});
}

template <class Work>
void LiveShape::rest(unsigned number, const Work& work) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(idle_s_);
  for (bool over = false; !over;) {
    {
      std::unique_lock lock(mutex_);
      over = !changed_.wait_until(lock, end, [&] { return closing_ || wanted_ || number != newest_; });
    }
    work();
  }
}

std::shared_ptr<LiveShape> LiveShapes::of(const std::string& view) {
  std::shared_ptr<LiveShape> dropped;  // ends outside of the lock
  const std::lock_guard lock(mutex_);
  const auto found =
      std::find_if(views_.begin(), views_.end(), [&](const auto& one) { return one.first == view; });
  if (found != views_.end()) {
    views_.splice(views_.begin(), views_, found);
  } else {
    views_.emplace_front(view, std::make_shared<LiveShape>());
    if (views_.size() > most_views) {
      dropped = std::move(views_.back().second);
      views_.pop_back();
    }
  }
  return views_.front().second;
}

}  // namespace ripstop::inline studio
