// The built-in engine compared with OpenFOAM on a mesh that follows the cloth: rigid bodies, and inflated canopies
// from the STL of a run.
//   bench_judge FOLDER ACROSS [--alone] [BODY ...]
//     FOLDER  of OpenFOAM's case and the plots
//     ACROSS  cells across the body, the built-in engine's, even; those of OpenFOAM's mesh are half as wide at the
//             cloth and twice as wide elsewhere
//     --alone without OpenFOAM
//     BODY    disk, plate, cup, porous-disk-K (K v |v| rho / 2), disk-gap-band (rigid_disk_gap_band()), or
//             NAME=FILE.stl:A:B, cloth with the law A v + B v |v| [Pa]; without one all but the last, K = 0.5, 1, 2
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "far_box.h"
#include "ripstop/core/error.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/openfoam/openfoam.h"
#include "ripstop/flow/steady.h"
#include "ripstop/flow/stl.h"
#include "ripstop/output/plot.h"
#include "table.h"

using namespace ripstop;

namespace {

constexpr double box = 12;                    // widths of the body
constexpr double speed = 20;                  // [m/s]
constexpr double tight = 1e6, f111 = 8169.3;  // [Pa s/m]

struct Body {
  std::string name;
  FlowBody sheet;
  double width = 0, front = 0;  // of the body across the stream [m], and its area across the stream [m2]
  double rear = 0;              // its highest z [m]
};

/// Moved such that the axis is x = y = 0 and the foremost point lies where a far box has its body.
Body measured(std::string name, FlowBody sheet, Vec3 axis) {
  double low = INFINITY, high = -INFINITY, radius = 0;
  for (const Triangle& t : sheet.surface) {
    for (const Vec3& p : {t.a, t.b, t.c}) {
      low = std::min(low, p.z), high = std::max(high, p.z);
      radius = std::max(radius, std::hypot(p.x - axis.x, p.y - axis.y));
    }
  }
  const Vec3 shift = Vec3{0, 0, 0.45 * 1.5 * box * 2 * radius - low} - Vec3{axis.x, axis.y, 0};
  for (Triangle& t : sheet.surface)
    for (Vec3* p : {&t.a, &t.b, &t.c}) *p += shift;
  double front = 0;
  for (const Triangle& t : sheet.surface) front += 0.5 * std::abs(cross(t.b - t.a, t.c - t.a).z);
  return {std::move(name), std::move(sheet), 2 * radius, front, high + shift.z};
}

Body body_of(const std::string& word) {
  constexpr double density = 1.2;
  if (word == "disk") return measured(word, sheet_body(disk(1, {}), {tight, 0}), {});
  if (word == "plate") return measured(word, sheet_body(square_plate(1, {}), {tight, 0}), {});
  if (word == "cup") return measured(word, sheet_body(hemispherical_cup(1, {}), {tight, 0}), {});
  if (word == "disk-gap-band") return measured(word, sheet_body(rigid_disk_gap_band({}), {f111, 0}), {});
  constexpr std::string_view porous = "porous-disk-";
  if (word.starts_with(porous))
    return measured(word, sheet_body(disk(1, {}), {0, std::stod(word.substr(porous.size())) * density / 2}),
                    {});
  const std::size_t is = word.find('='), b = word.rfind(':'), a = word.rfind(':', b - 1);
  if (is == std::string::npos || b == std::string::npos || a == std::string::npos || a < is)
    throw Error(ExitCode::usage,
                word + " is no body: disk, plate, cup, porous-disk-K, disk-gap-band or NAME=FILE.stl:A:B");
  FlowBody sheet = sheet_body(read_stl(word.substr(is + 1, a - is - 1)),
                              {std::stod(word.substr(a + 1, b - a - 1)), std::stod(word.substr(b + 1))});
  Vec3 middle;
  double area = 0;
  for (const Triangle& t : sheet.surface) {
    const double part = norm(cross(t.b - t.a, t.c - t.a));
    middle += part / 3 * (t.a + t.b + t.c), area += part;
  }
  return measured(word.substr(0, is), std::move(sheet), middle / area);
}

FlowProblem problem_of(const Body& body, int across) {
  FlowProblem problem;
  problem.grid = far_box(body.width, box, across, 0.45 * 1.5 * box * body.width);
  problem.air.velocity = {0, 0, speed};
  problem.sides = Sides::slip;
  problem.bodies = {body.sheet};
  problem.stopping.max_iterations = 1200;
  return problem;
}

struct Result {
  double drag = 0, ledger = 0, minutes = 0;
  std::vector<double> drop;                 // by bin, over the dynamic pressure
  std::vector<std::vector<double>> behind;  // one and three widths behind, by radius, over the stream's speed
};

constexpr int bins = 18, radii = 25;
constexpr double widest = 1.25;  // of the profiles, in widths

/// The position on a canopy from the axis, 0, to the rim, 1: by radius for a flat one, else by the angle
/// about the middle of the mouth.
double place(const Body& body, Vec3 p) {
  const double mouth = 0.45 * 1.5 * box * body.width, r = std::hypot(p.x, p.y);
  if (body.rear - mouth < 0.05 * body.width) return 2 * r / body.width;
  return std::atan2(r, std::max(p.z - mouth, 0.0)) / (std::numbers::pi / 2);
}

Result result_of(const Body& body, const FlowProblem& problem, const FlowField& field) {
  const double q = 0.5 * problem.air.density * speed * speed;
  Result result;
  result.drag = field.porous_force.z / (q * body.front);
  result.ledger = field.momentum_deficit.z / field.porous_force.z - 1;
  std::vector<double> weight(bins);
  result.drop.resize(bins);
  for (const SheetLoad& load : field.sheet_loads) {
    const int bin = std::clamp(static_cast<int>(bins * place(body, load.point)), 0, bins - 1);
    result.drop[bin] += load.area * std::abs(load.drop / load.cover) / q, weight[bin] += load.area;
  }
  for (int bin = 0; bin < bins; ++bin)
    result.drop[bin] = weight[bin] > 0 ? result.drop[bin] / weight[bin] : NAN;
  for (const double distance : {1.0, 3.0}) {
    std::vector<double> profile;
    for (int r = 0; r < radii; ++r) {
      const double radius = widest * body.width * r / (radii - 1);
      constexpr int round = 24;
      double sum = 0;
      for (int n = 0; n < round; ++n) {
        const double angle = 2 * std::numbers::pi * n / round;
        sum += sample(field.grid, field.velocity,
                      {radius * std::cos(angle), radius * std::sin(angle), body.rear + distance * body.width})
                   .z;
      }
      profile.push_back(sum / round / speed);
    }
    result.behind.push_back(profile);
  }
  return result;
}

/// Of this process and of its children that have ended [min].
double processor_minutes() {
  double seconds = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage used{};
    getrusage(who, &used);
    for (const timeval& part : {used.ru_utime, used.ru_stime})
      seconds += static_cast<double>(part.tv_sec) + 1e-6 * static_cast<double>(part.tv_usec);
  }
  return seconds / 60;
}

template <class Solve>
Result timed(const Body& body, const FlowProblem& problem, const Solve& solved) {
  const double begin = processor_minutes();
  const FlowField field = solved();
  Result result = result_of(body, problem, field);
  result.minutes = processor_minutes() - begin;
  return result;
}

/// Every fiftieth iteration, on standard error.
FlowReport told(const Body& body, const FlowProblem& problem, const std::string& engine) {
  const double whole = 0.5 * problem.air.density * speed * speed * body.front;
  return [=, name = body.name, most = problem.stopping.max_iterations](const FlowProgress& now) {
    if (now.iteration % 50 == 0)
      fmt::print(stderr, "{}, {}: iteration {} of at most {}, drag on its front {:.4f}, residual {:.1e}\n",
                 name, engine, now.iteration, most, now.drag / whole, largest_residual(now));
    return true;
  };
}

Result builtin(const Body& body, int across) {
  FlowProblem problem = problem_of(body, across);
  problem.stopping.average_over = 100;
  CartesianSettings settings;
  settings.second_order = true;
  return timed(body, problem,
               [&] { return solve(*make_cartesian(settings), problem, told(body, problem, "built-in")); });
}

Result openfoam(const Body& body, int across, const std::filesystem::path& folder) {
  FlowProblem problem = problem_of(body, across / 2);
  problem.stopping.residual = 1e-4;
  problem.stopping.max_iterations = 600;
  OpenFoamSettings settings;
  settings.folder = folder;
  settings.second_order = true;
  settings.fitted_mesh = true;
  settings.cloth_levels = 2;
  return timed(body, problem,
               [&] { return solve(*make_openfoam(settings), problem, told(body, problem, "OpenFOAM")); });
}

/// Root of the mean square of the differences, where both have a value.
double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0, count = 0;
  for (std::size_t n = 0; n < a.size(); ++n)
    if (std::isfinite(a[n] + b[n])) sum += (a[n] - b[n]) * (a[n] - b[n]), ++count;
  return std::sqrt(sum / count);
}

void draw(const std::filesystem::path& folder, const Body& body, int across, const Result& ours,
          const Result& theirs) {
  Plot pressure{body.name + fmt::format(": pressure across the cloth, {} cells across", across),
                {"place on a gore, 0 axis, 1 rim", false, 0.0, 1.0},
                {"pressure inside less outside, over the dynamic pressure"},
                {}};
  std::vector<double> places;
  for (int bin = 0; bin < bins; ++bin) places.push_back((bin + 0.5) / bins);
  pressure.series = {{"built-in", places, ours.drop}, {"OpenFOAM, mesh on the cloth", places, theirs.drop}};
  write_plot(folder / fmt::format("{}-{}-pressure.svg", body.name, across), pressure);
  Plot wake{body.name + fmt::format(": wake, {} cells across", across),
            {"radius over the width"},
            {"velocity along the stream over the stream's"},
            {}};
  std::vector<double> radius;
  for (int r = 0; r < radii; ++r) radius.push_back(widest * r / (radii - 1));
  for (const int n : {0, 1}) {
    const std::string where = n == 0 ? "one width behind" : "three widths behind";
    wake.series.push_back({"built-in, " + where, radius, ours.behind[n]});
    wake.series.push_back({"OpenFOAM, " + where, radius, theirs.behind[n], true, true, true});
  }
  write_plot(folder / fmt::format("{}-{}-wake.svg", body.name, across), wake);
}

std::string percent(double share) {
  return fmt::format("{:+.1f} %", 100 * share);
}

void judge(const std::filesystem::path& folder, const Body& body, int across, bool alone) {
  const Result ours = builtin(body, across);
  if (alone) {
    print_row({body.name, fmt::format("{}", across), fmt::format("{:.3f}", ours.drag), "", "",
               percent(ours.ledger), "", "", "", fmt::format("{:.1f}", ours.minutes)});
    return;
  }
  const Result theirs = openfoam(body, across, folder / "case");
  draw(folder, body, across, ours, theirs);
  print_row({body.name, fmt::format("{}", across), fmt::format("{:.3f}", ours.drag),
             fmt::format("{:.3f}", theirs.drag), percent(ours.drag / theirs.drag - 1), percent(ours.ledger),
             percent(theirs.ledger), fmt::format("{:.3f}", apart(ours.drop, theirs.drop)),
             fmt::format("{:.3f}, {:.3f}", apart(ours.behind[0], theirs.behind[0]),
                         apart(ours.behind[1], theirs.behind[1])),
             fmt::format("{:.1f}, {:.1f}", ours.minutes, theirs.minutes)});
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr,
               "bench_judge FOLDER ACROSS [--alone] "
               "[disk|plate|cup|porous-disk-K|disk-gap-band|NAME=FILE.stl:A:B ...]\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const int across = std::atoi(argv[2]);
  std::vector<std::string> words(argv + 3, argv + argc);
  const bool alone = std::erase(words, "--alone") > 0;
  if (words.empty())
    words = {"disk", "plate", "cup", "porous-disk-0.5", "porous-disk-1", "porous-disk-2", "disk-gap-band"};
  std::filesystem::create_directories(folder);
  print_table_head(
      "Rigid bodies and inflated canopies: cross-validation with OpenFOAM on a fitted mesh", argc, argv,
      {"body", "cells across", "C_D on the frontal area, built-in", "OpenFOAM",
       "built-in compared with OpenFOAM", "force imbalance, built-in", "force imbalance, OpenFOAM",
       "pressure difference across the cloth, rms deviation over dynamic pressure",
       "speed in the wake 1 and 3 widths downstream, rms deviation over stream speed",
       "minutes on one core, built-in, OpenFOAM"});
  for (const std::string& word : words) judge(folder, body_of(word), across, alone);
}
