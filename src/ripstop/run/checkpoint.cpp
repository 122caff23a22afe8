#include "ripstop/run/checkpoint.h"

#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json.hpp>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"

namespace ripstop {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr int format_version = 3;

std::vector<double> flat(const std::vector<Vec3>& vectors) {
  std::vector<double> values;
  values.reserve(3 * vectors.size());
  for (const Vec3& v : vectors) values.insert(values.end(), {v.x, v.y, v.z});
  return values;
}

std::vector<Vec3> vectors(const std::vector<double>& values) {
  std::vector<Vec3> result(values.size() / 3);
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  return result;
}

// One list of the members for both directions.
template <class Visit>
void each_member(Visit&& visit, SteadyIteration& i) {
  visit("iteration", i.iteration);
  visit("fluid_force", i.fluid_force);
  visit("nodal_load", i.nodal_load);
  visit("line_tension", i.line_tension);
  visit("momentum_deficit", i.momentum_deficit);
  visit("transfer_factor", i.transfer_factor);
  visit("load_remainder", i.load_remainder);
  visit("drag_change", i.drag_change);
  visit("shape_change", i.shape_change);
  visit("omega", i.omega);
  visit("printed_tolerance", i.printed_tolerance);
  visit("cloth_steps", i.cloth_steps);
  visit("cloth_residual", i.cloth_residual);
  visit("flow_iterations", i.flow_iterations);
  visit("flow_residual", i.flow_residual);
  visit("flow_converged", i.flow_converged);
  visit("flow_averaged", i.flow_averaged);
  visit("drag_deviation", i.drag_deviation);
  visit("cut_cells", i.cut_cells);
  visit("wall_time", i.wall_time);
}

}  // namespace

std::string to_bytes(const SteadyState& state) {
  json j;
  j["format"] = format_version;
  j["iterations"] = json::array();
  for (SteadyIteration iteration : state.iterations) {
    json row;
    each_member([&](const char* name, auto& value) { row[name] = value; }, iteration);
    j["iterations"].push_back(row);
  }
  j["shape"] = flat(state.shape);
  j["pressure"] = state.pressure;
  j["remainder"] = flat({state.remainder.at_centre, state.remainder.twist});
  j["inside"] = state.sides.inside;
  j["outside"] = state.sides.outside;
  j["applied"] = state.applied;
  j["update"] = static_cast<int>(state.accelerator.update);
  j["relaxation"] = state.accelerator.relaxation;
  j["memory"] = state.accelerator.memory;
  j["guesses"] = state.accelerator.guesses;
  j["residuals"] = state.accelerator.residuals;
  j["aitken_factor"] = state.accelerator.aitken_factor;
  j["converged"] = state.converged;
  const std::vector<std::uint8_t> bytes = json::to_cbor(j);
  return {bytes.begin(), bytes.end()};
}

SteadyState steady_state_from_bytes(const std::string& bytes) {
  try {
    const json j = json::from_cbor(bytes);
    if (j.at("format") != format_version) {
      throw Error(ExitCode::bad_data, "a checkpoint of another version of Ripstop; start again with --fresh");
    }
    SteadyState state;
    for (const json& row : j.at("iterations")) {
      SteadyIteration iteration;
      each_member([&](const char* name, auto& value) { row.at(name).get_to(value); }, iteration);
      state.iterations.push_back(iteration);
    }
    state.shape = vectors(j.at("shape").get<std::vector<double>>());
    j.at("pressure").get_to(state.pressure);
    const std::vector<Vec3> remainder = vectors(j.at("remainder").get<std::vector<double>>());
    state.remainder = {remainder.at(0), remainder.at(1)};
    j.at("inside").get_to(state.sides.inside);
    j.at("outside").get_to(state.sides.outside);
    j.at("applied").get_to(state.applied);
    state.accelerator.update = static_cast<Acceleration>(j.at("update").get<int>());
    j.at("relaxation").get_to(state.accelerator.relaxation);
    j.at("memory").get_to(state.accelerator.memory);
    j.at("guesses").get_to(state.accelerator.guesses);
    j.at("residuals").get_to(state.accelerator.residuals);
    j.at("aitken_factor").get_to(state.accelerator.aitken_factor);
    j.at("converged").get_to(state.converged);
    return state;
  } catch (const json::exception& error) {
    throw Error(ExitCode::bad_data, fmt::format("not a checkpoint of Ripstop: {}", error.what()));
  }
}

void save_checkpoint(const fs::path& folder, const SteadyState& state, const FlowEngine& engine) {
  make_folder(folder);
  const std::string name = state.iterations.size() % 2 == 0 ? "even" : "odd";
  std::error_code ignored;
  fs::remove_all(folder / name, ignored);
  make_folder(folder / name);
  write_sealed(folder / name / "state", to_bytes(state));
  make_folder(folder / name / "flow");
  engine.save(folder / name / "flow");
  write_sealed(folder / "current", name);
}

std::optional<SteadyState> load_checkpoint(const fs::path& folder, FlowEngine& engine) {
  if (!fs::exists(folder / "current")) return std::nullopt;
  const std::string name = read_sealed(folder / "current");
  if (name != "even" && name != "odd") {
    throw Error(ExitCode::bad_data, fmt::format("{}: names no checkpoint", (folder / "current").string()));
  }
  SteadyState state = steady_state_from_bytes(read_sealed(folder / name / "state"));
  engine.restore(folder / name / "flow");
  return state;
}

}  // namespace ripstop
