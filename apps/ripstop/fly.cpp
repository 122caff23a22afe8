// ripstop fly: a parachute and its payload in free flight, from a case file to a run folder.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "case_options.h"
#include "commands.h"
#include "json_option.h"
#include "margins.h"
#include "number_option.h"
#include "opening.h"
#include "option.h"
#include "progress.h"
#include "ripstop/core/error.h"
#include "ripstop/run/flight/flight_folder.h"
#include "stopping.h"
#include "units_option.h"
#include "warnings.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;

struct FlyArguments {
  fs::path case_file, out, from;
  Overrides overrides;
  int threads = 0;
  bool fresh = false, json = false;
};

std::string with_error(std::optional<double> value, std::optional<double> error, const char* unit,
                       int digits) {
  if (!value) return "not known";
  if (!error) return fmt::format("{:.{}f}{}", *value, digits, unit);
  return fmt::format("{:.{}f} +- {:.{}f}{}", *value, digits, *error, digits, unit);
}

void print_canopies(const FlightCluster& cluster) {
  const auto row = print_row;
  if (cluster.factor)
    row("cluster factor", fmt::format("{:.3f}, C_D0 in descent over that of one canopy", *cluster.factor));
  if (!cluster.motion) return;
  const ClusterMotion& m = *cluster.motion;
  row("spread angle",
      fmt::format("{:.1f} deg in the mean, standard deviation {:.1f} deg; {:g} deg at the start",
                  m.mean_spread, m.spread_deviation, cluster.first_spread));
  for (std::size_t k = 0; k < m.canopies.size(); ++k) {
    const CanopyMotion& canopy = m.canopies[k];
    row(fmt::format("canopy {}{}", k + 1,
                    canopy.size_ratio ? fmt::format(", size {:g}", *canopy.size_ratio) : "")
            .c_str(),
        fmt::format(
            "spread angle {:.1f} deg, standard deviation {:.1f} deg; riser load {:.1f} N in the mean, "
            "largest {:.1f} N at {:.2f} s",
            canopy.mean_spread, canopy.spread_deviation, canopy.mean_load, canopy.largest_load,
            canopy.largest_load_time));
  }
  row("smallest gap",
      fmt::format("{:.3g} m at {:.2f} s{}", m.smallest_gap, m.smallest_gap_time,
                  m.first_contact
                      ? fmt::format("; contact (below {:.2g} m) for {:.2g} % of the time, first at {:.2f} s",
                                    m.contact_gap, 100 * m.contact_share, *m.first_contact)
                      : ", no contact"));
}

void print_flight(const FlightResult& r, const fs::path& folder, double wall_time) {
  const auto row = print_row;
  fmt::print("\n{}\n", r.title);
  if (const auto& h = r.handover) {
    if (h->deployment_speed)
      row("airspeed at deployment",
          fmt::format("{:.4g} m/s ({})", *h->deployment_speed, *h->deployment_speed_from));
    row("inflation", fmt::format("{:.3f} s, peak load {:.1f} N, {:.1f} m lost; {:.2f} m/s at its end",
                                 h->time, h->opening_peak, h->height_lost, h->opening_speed));
    row("flight continues",
        fmt::format("{}; load {:.1f} to {:.1f} N, drag {:.1f} to {:.1f} N, elastic energy {:.3g} to {:.3g} J",
                    h->same_flow ? "in the same flow" : "in a flow interpolated to its cells and boundaries",
                    h->load_before, h->load_after, h->drag_before, h->drag_after, h->elastic_before,
                    h->elastic_after));
  }
  row("ended by", fmt::format("{}, {:.2f} s; means from {:.2f} s on", r.ended_by, r.duration, r.start_up));
  row("rate of descent", with_error(r.descent, r.descent_error, " m/s", 3) +
                             (r.axial_speed ? fmt::format(" (axial flow: {:.3f} m/s)", *r.axial_speed) : ""));
  row("C_D0 in descent",
      with_error(r.coefficient, r.coefficient_error, "", 3) +
          (r.axial_coefficient ? fmt::format("; axial flow: {:.3f}", *r.axial_coefficient) : "") +
          (r.known_coefficient ? fmt::format("; Knacke, in descent: {:.2f} to {:.2f}",
                                             (*r.known_coefficient)[0], (*r.known_coefficient)[1])
                               : ""));
  row("glide ratio", with_error(r.glide, r.glide_error, "", 3));
  row("oscillation, mean of peaks",
      with_error(r.oscillation, r.oscillation_error, " deg", 1) + fmt::format(", {} half-swings", r.peaks));
  row("oscillation, largest", with_error(r.largest, r.largest_error, " deg", 1));
  row("period", with_error(r.period, r.period_error, " s", 2));
  if (r.roundness)
    row("roundness", fmt::format("{:.2f} (0: oscillation in a plane, 1: conical)", *r.roundness));
  row("largest force of the lines",
      fmt::format("{:.1f} N, {:.2f} times the payload's weight", r.largest_load, r.load_factor));
  if (r.cluster) print_canopies(*r.cluster);
  for (const FlightBody& body : r.bodies.value_or(std::vector<FlightBody>()))
    row(("body " + body.name).c_str(),
        fmt::format(
            "drag {:.3g} N, drag area {} ({:.3f} on {:.4g} m2); {:.1f} deg between its axis and the air",
            body.drag, with_error(body.drag_area, body.drag_area_error, " m2", 5), body.drag_coefficient,
            body.reference_area, body.mean_incidence));
  print_margins(r.margins);
  if (r.air_source) row("air", fmt::format("{:.4g} kg/m3 at the start ({})", r.density, *r.air_source));
  row("path", fmt::format("{:.1f} m down, {:.1f} m over the ground", r.height_lost, r.distance));
  row("balance", fmt::format("energy {:.3f} % of the potential energy lost, momentum {:.3f} % of the weight",
                             100 * r.energy_residual, 100 * r.momentum_residual));
  row("files", fmt::format("{} (path.csv, path.png, angle.png, canopy.pvd, result.json); elapsed {}",
                           folder.string(), duration_text(wall_time)));
}

std::string remaining_text(std::chrono::steady_clock::time_point begin, double done, double whole) {
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return fmt::format("elapsed {}, remaining about {}", duration_text(elapsed),
                     duration_text(elapsed * (whole - done) / std::max(done, 1e-9)));
}

/// Of the inflation that comes first.
class OpeningTerminal : public InflationObserver {
 public:
  explicit OpeningTerminal(Progress& progress) : progress_(progress) {}

  void warned(const std::string& text) override { progress_.line("warning: " + text); }
  void begin(const Opening& opening, InflationState& state, InflationHistory&) override {
    if (state.blocks > 0)
      progress_.line(fmt::format("inflation, resuming at {:.2f} ms", 1000 * state.cloth.time));
    begin_ = Clock::now(), first_ = state.blocks;
    whole_ = double(opening.blocks() - first_);
  }
  void advanced(const Opening& opening, const InflationState& state, const InflationHistory& history,
                const InflationFrame*) override {
    progress_.show(fmt::format("inflation, {:.1f} of {:.0f} ms, load {:.1f} N | {}", 1000 * state.cloth.time,
                               1000 * opening.problem().settings.duration_s, history.rows.back().mean,
                               remaining_text(begin_, double(state.blocks - first_), whole_)));
  }

 private:
  using Clock = std::chrono::steady_clock;
  Progress& progress_;
  Clock::time_point begin_;
  long long first_ = 0;
  double whole_ = 1;
};

class FlightTerminal : public FlightObserver {
 public:
  FlightTerminal(Progress& progress, const fs::path& folder, bool quiet)
      : progress_(progress), folder_(folder), quiet_(quiet), opening_(progress) {}

  InflationObserver& opening() override { return opening_; }
  void warned(const std::string& text) override { progress_.line("warning: " + text); }
  void starting(const SteadyProgress& p, const SteadyState&) override {
    progress_.show(fmt::format("equilibrium on the axis, iteration {}", p.iteration));
  }
  void begin(FreeFlight& flight, FreeFlightState& state, FlightHistory&) override {
    const FlowGrid& grid = flight.air().grid();
    if (state.rows > 0)
      progress_.line(fmt::format("continues at {:.2f} s of {}", state.coupled.cloth.time, folder_.string()));
    else if (!quiet_)
      fmt::print(
          "{} nodes, step of the cloth {:.2e} s; {} x {} x {} cells; starts at {:.3f} m/s; {} threads\n",
          flight.mesh().node_count(), state.coupled.step, grid.nx, grid.ny, grid.nz, norm(state.stream),
          flight.threads());
    std::fflush(stdout);
    begin_ = Clock::now(), from_ = flight.began() + state.coupled.cloth.time;
  }
  void advanced(FreeFlight& flight, const FreeFlightState&, const FlightHistory& history, bool) override {
    const FreeFlightRow& row = history.rows.back();
    const double until = flight.began() + flight.problem().settings.duration_s;
    progress_.show(fmt::format("{:.2f} of {:.4g} s, {:.2f} m/s down, {:.1f} deg | {}", row.time, until,
                               -row.velocity.z, row.angle,
                               remaining_text(begin_, row.time - from_, until - from_)));
  }

 private:
  using Clock = std::chrono::steady_clock;
  Progress& progress_;
  const fs::path& folder_;
  bool quiet_;
  OpeningTerminal opening_;
  Clock::time_point begin_;
  double from_ = 0;
};

int fly(const FlyArguments& options) {
  const auto begin = std::chrono::steady_clock::now();
  const Settings resolved = flight_settings(read_given(options.case_file, options.overrides), options.from);
  const fs::path folder = options.out.empty() ? default_run_folder(options.case_file, "flight") : options.out;
  const int threads = options.threads > 0 ? options.threads : resolved.coupling().threads;
  if (!options.json && options.from.empty() && resolved.flight().start == FlightSettings::Start::inflation)
    print_deployment_speed(resolved);
  goes_on_when_repeated();
  Progress progress;
  FlightTerminal terminal(progress, folder, options.json);
  const auto result = run_flight_in({{folder, options.fresh}, threads, 30, options.from}, resolved, terminal);
  if (!result) {
    const std::string finished = *finished_result(folder);
    fmt::print("{}", finished);
    fmt::print(stderr, "{} contains the finished run; use --fresh to compute it again\n", folder.string());
    const auto json = nlohmann::json::parse(finished);
    return print_result_warnings(json.at("warnings").get<std::vector<std::string>>(),
                                 json.at("usable").get<bool>());
  }
  if (options.json)
    fmt::print("{}", to_json(*result));
  else
    print_flight(*result, folder,
                 std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  return print_result_warnings(result->warnings, result->usable);
}

}  // namespace

void add_fly(CLI::App& app, int& status) {
  auto options = std::make_shared<FlyArguments>();
  CLI::App* command = app.add_subcommand(
      "fly", "Compute the free flight of parachute and payload: rate of descent, glide and oscillation");
  command->footer(
      "The canopy starts in equilibrium on the axis, at the speed at which its drag equals the weight, and\n"
      "is released at an angle. With --deploy or --from the flight continues from the end of a coupled\n"
      "inflation. Air, cloth and payload are stepped together in time. A case with\n"
      "[cluster] flies with all of its canopies, one with [body.NAME] with its rigid bodies.\n"
      "Example: ripstop fly examples/flat-circular/case.toml --mass 2.4 --duration 30 --cloth-nodes 2000");
  command->add_option("case", options->case_file, "Case file (TOML)")->required();
  add_key_option(*command, "--mass", "payload.mass_kg", "Mass of the payload, without the parachute [kg]",
                 options->overrides);
  add_key_option(*command, "--duration", "flight.duration_s", "Longest time of flight [s]",
                 options->overrides);
  add_key_option(*command, "--until-error", "flight.standard_error",
                 "End at this relative standard error of the rate of descent, after ten periods",
                 options->overrides);
  add_key_option(*command, "--cloth-nodes", "parachute.mesh.cloth_nodes", "Target number of cloth nodes",
                 options->overrides);
  add_key_option(*command, "--angle", "flight.angle_deg",
                 "Angle between the vertical and the line from payload to canopy at the start [deg]",
                 options->overrides);
  add_key_option(*command, "--height", "flight.height_m",
                 "Height of the payload above the ground at the start [m] (in other commands: above sea "
                 "level); the flight ends at the ground",
                 options->overrides);
  add_key_option(*command, "--wind", "flight.wind.speed_m_s", "Speed of the wind [m/s]", options->overrides);
  add_key_option(
      *command, "--cells-across", "flight.cells_across",
      "Number of flow cells across the nominal diameter (ripstop stability: across the projected one)",
      options->overrides);
  add_key_number(*command, "--speed", "flow.speed_m_s", options->overrides.speed,
                 "Airspeed of the payload at deployment, with --deploy [m/s]")
      ->default_str("payload.deployment_speed_m_s, else flow.speed_m_s");
  CLI::Option* deploy = command->add_flag_callback(
      "--deploy",
      [options] {
        options->overrides.set.push_back({"flight.start", "inflation", "--deploy"});
      },
      "Compute the coupled inflation with the payload first (flight.start = \"inflation\")");
  add_run_folder(
      *command, "--from", options->from,
      "Run folder of ripstop inflate, coupled and with the payload; the flight continues from its end")
      ->excludes(deploy);
  add_set_option(*command, options->overrides);
  add_number(*command, "--threads", options->threads, from(1).up_to(key_range("coupling.threads").high),
             "Number of threads")
      ->default_str("coupling.threads");
  command->add_option("--out", options->out, "Run folder")->default_str("runs/<name of the case>-flight");
  command->add_flag("--fresh", options->fresh,
                    "Replace the files of Ripstop in the run folder; without this option the run resumes");
  add_json_option(*command, options->json);
  command->callback([options, &status] { status = fly(*options); });
}

}  // namespace ripstop::cli
