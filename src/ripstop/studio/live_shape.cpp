#include "ripstop/studio/live_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "ripstop/canopy/shape.h"
#include "ripstop/case/assemble.h"
#include "ripstop/core/error.h"
#include "ripstop/output/vtk.h"
#include "ripstop/report/report.h"
#include "ripstop/report/shape_view.h"

namespace ripstop::inline studio {
namespace {

constexpr std::size_t most_views = 4;

struct Superseded {};

std::string answer_json(unsigned number, bool done, const std::string& result, const VtkSurface& canopy,
                        const VtkSurface& lines) {
  return fmt::format("{{\"number\": {}, \"done\": {}, \"result\": {}, \"shape\": {}}}", number, done, result,
                     shape_json(shape_of(canopy, lines)));
}

/// Without stresses: a relaxation passes through states of softened cloth.
std::string passing_json(unsigned number, const CanopyMesh& mesh, double pressure,
                         const RelaxProgress& progress, const std::vector<Vec3>& shape) {
  const nlohmann::ordered_json result = {
      {"pressure_pa", pressure},
      {"projected_diameter_m", canopy_size(mesh, shape).projected_diameter},
      {"nodes", mesh.node_count()},
      {"residual", progress.residual},
      {"converged", false}};
  return answer_json(number, false, result.dump(), canopy_surface(mesh, shape), spring_lines(mesh, shape));
}

bool same_springs(const CanopyMesh& a, const CanopyMesh& b) {
  return a.node_count() == b.node_count() && a.cell_count() == b.cell_count() && a.fixed == b.fixed &&
         std::equal(a.springs.begin(), a.springs.end(), b.springs.begin(), b.springs.end(),
                    [](const Spring& s, const Spring& t) { return s.a == t.a && s.b == t.b; });
}

}  // namespace

LiveShape::LiveShape() : worker_([this] { work(); }) {}

LiveShape::~LiveShape() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  worker_.join();
}

unsigned LiveShape::begin(Settings resolved, std::optional<double> pressure) {
  const std::lock_guard lock(mutex_);
  next_ = Request{std::move(resolved), pressure};
  wanted_ = false;
  changed_.notify_all();
  return ++newest_;
}

std::string LiveShape::answer(unsigned number, double wait_s) {
  std::unique_lock lock(mutex_);
  const auto superseded = [&] { return closing_ || number != newest_; };
  const auto done = [&] { return superseded() || (answer_.number == number && answer_.done); };
  if (!changed_.wait_for(lock, std::chrono::duration<double>(wait_s), done)) {
    answer_ = {};  // a shape of the moment is made on request
    wanted_ = true;
    changed_.wait(lock, [&] { return superseded() || answer_.number == number; });
  }
  if (superseded()) return "{\"superseded\": true}";
  if (answer_.error) throw Error(answer_.error->first, answer_.error->second);
  return answer_.json;
}

void LiveShape::publish(Answer answer) {
  const std::lock_guard lock(mutex_);
  answer_ = std::move(answer);
  wanted_ = false;
  changed_.notify_all();
}

bool LiveShape::ends(unsigned number, bool& wanted) {
  const std::lock_guard lock(mutex_);
  wanted = wanted_;
  return closing_ || number != newest_;
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
    } catch (const Superseded&) {
      continue;
    } catch (const Error& error) {
      publish({number, true, "", std::pair{error.code(), error.what()}});
    } catch (const std::exception& error) {
      publish({number, true, "", std::pair{ExitCode::resources, std::string(error.what())}});
    }
  }
}

/// The last shape in proportion to the new size, held where the new canopy is.
std::vector<Vec3> LiveShape::start_of(const CanopyMesh& mesh, double diameter) const {
  if (!last_ || mesh.fixed.empty() || !same_springs(last_->mesh, mesh)) return {};
  std::vector<Vec3> start = last_->shape;
  const double scale = diameter / last_diameter_;
  const Vec3 from = start[mesh.fixed.front()], to = mesh.start[mesh.fixed.front()];
  for (Vec3& x : start) x = to + scale * (x - from);
  for (const int node : mesh.fixed) start[node] = mesh.start[node];
  return start;
}

/// A large change of the design may diverge from the last shape.
FabricSolution LiveShape::solved(const Request& request, const std::vector<Vec3>& start,
                                 const RelaxWatch& watch) {
  try {
    return run_fabric_from(request.resolved, request.pressure, start, watch);
  } catch (const Error& error) {
    if (start.empty() || error.code() != ExitCode::diverged) throw;
    return run_fabric_from(request.resolved, request.pressure, {}, watch);
  }
}

void LiveShape::compute(const Request& request, unsigned number) {
  const CanopyMesh mesh = parachute_mesh(request.resolved);
  const double diameter = nominal_diameter(request.resolved.parachute());
  const double speed = request.resolved.flow().speed_m_s;
  const double pressure =
      request.pressure.value_or(0.5 * request.resolved.flow().density_kg_m3 * speed * speed);
  const RelaxWatch watch = [&](const RelaxProgress& progress, const auto& positions) {
    bool wanted = false;
    if (ends(number, wanted)) throw Superseded();
    if (wanted) publish({number, false, passing_json(number, mesh, pressure, progress, positions()), {}});
  };
  FabricSolution solution = solved(request, start_of(mesh, diameter), watch);
  publish(
      {number,
       true,
       answer_json(number, true, to_json(solution.result), fabric_canopy(solution), fabric_lines(solution)),
       {}});
  last_ = std::move(solution);
  last_diameter_ = diameter;
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
