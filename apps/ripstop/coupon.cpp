// ripstop coupon: pulls a virtual coupon of a material, and compares it with its records.

#include "ripstop/run/material/coupon.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "fit_report.h"
#include "json_option.h"
#include "number_option.h"
#include "option.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/run/material/fit.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;

struct CouponArguments {
  std::string material;
  fs::path bench;
  fs::path out;
  CouponShape shape;
  double strain = 0;
  int points = 12;
  int threads = 0;
  bool json = false;
};

Fabric fabric_of(const std::string& name) {
  const Material material = fs::path(name).has_extension() ? read_material(name) : library_material(name);
  if (const auto* fabric = std::get_if<Fabric>(&material)) return *fabric;
  throw Error(ExitCode::usage,
              fmt::format("{} is a {}; give a material of kind \"fabric\"", name, kind_of(material)));
}

int finish(const Fabric& fabric, double largest_strain, bool converged) {
  std::fflush(stdout);
  for (const std::string& text : material_warnings(fabric, largest_strain))
    fmt::print(stderr, "warning: {}\n", text);
  if (!converged)
    throw Error(ExitCode::not_converged,
                "a coupon did not reach equilibrium; the last digits of its loads are uncertain");
  return 0;
}

int compare(const CouponArguments& options, const Fabric& fabric, ThreadTeam& team) {
  const Bench bench = read_bench(options.bench);
  const MaterialFit fit = fit_material(bench);
  const std::vector<CouponComparison> coupons =
      compare_coupons(fit, fabric, options.shape.cells, options.points, team);
  const std::string json = coupons_json(
      fabric, bench, fit, fmt::format("{} cells, {} points\n", options.shape.cells, options.points), coupons);
  if (!options.out.empty()) {
    for (const CouponComparison& c : coupons) write_coupon(options.out, c.name, c.coupon, c.pull);
    write_curves(options.out, fit, bench, coupons);
    write_file(options.out / "result.json", json);
  }
  if (options.json)
    fmt::print("{}", json);
  else
    print_coupons(coupons);
  double largest = 0;
  bool converged = true;
  for (const CouponComparison& c : coupons) {
    largest = std::max(largest, c.pull.largest_strain);
    converged = converged && c.pull.converged;
  }
  return finish(fabric, largest, converged);
}

void print_result(const CouponResult& r) {
  fmt::print("{}: {:.4g} mm x {:.4g} mm at {} deg, lattice spacing {:.3g} mm, {} nodes\n", r.material,
             1e3 * r.coupon.length, 1e3 * r.coupon.width, r.orientation, 1e3 * r.coupon.spacing,
             r.coupon.mesh.node_count());
  fmt::print("{:>9} {:>12} {:>9} {:>12}\n", "strain", "load N/m", "width", "corner peak");
  for (const CouponPoint& p : r.pull.points)
    fmt::print("{:>9.4f} {:>12.2f} {:>9.4f} {:>12.3f}\n", p.strain, p.load, p.waist, p.corner_peak);
  fmt::print(
      "width: at mid-length over the initial one; corner peak: stress at a clamp corner over that at "
      "mid-length\n");
}

int pull(const CouponArguments& options, const Fabric& fabric, ThreadTeam& team) {
  const CouponResult result = run_coupon(fabric, options.shape, options.strain, options.points, team);
  if (!options.out.empty()) write_coupon_result(options.out, result);
  if (options.json)
    fmt::print("{}", to_json(result));
  else
    print_result(result);
  return finish(fabric, result.pull.largest_strain, result.pull.converged);
}

int run(const CouponArguments& options) {
  const Fabric fabric = fabric_of(options.material);
  if (!options.out.empty()) make_results_folder(options.out, "coupon");
  ThreadTeam team(options.threads);
  return options.bench.empty() ? pull(options, fabric, team) : compare(options, fabric, team);
}

}  // namespace

void add_coupon(CLI::App& app, int& status) {
  auto options = std::make_shared<CouponArguments>();
  CLI::App* command = app.add_subcommand("coupon", "Compute a virtual tensile test of a fabric coupon");
  command->footer("Example: ripstop coupon f-111 --orientation 45 --strain 0.2 --out coupon-45");
  command
      ->add_option("material", options->material,
                   "Name of a material of the library, or a material file (.toml)")
      ->required();
  command->add_option("--bench", options->bench,
                      "Test campaign (TOML) to compare with; its coupons are computed");
  add_choice<int>(*command, "--orientation", options->shape.orientation, {{"0", 0}, {"45", 45}, {"90", 90}},
                  "Angle between load and warp [deg]");
  command->add_flag(
      "--bias-lattice", options->shape.bias_lattice,
      "At 45 deg: lattice along the load and yarns along its diagonals, as in a canopy cut on the bias");
  add_number(*command, "--length", options->shape.length, above(0).up_to(100),
             "Length between the clamps [m]");
  add_number(*command, "--width", options->shape.width, above(0).up_to(10), "Width of the coupon [m]");
  add_number(*command, "--cells", options->shape.cells, from(2).up_to(200), "Lattice cells across the width");
  add_number(*command, "--strain", options->strain, above(0).up_to(2), "Strain of the last point")
      ->default_str("the tested strain");
  add_number(*command, "--points", options->points, from(1).up_to(1000), "Number of points of the curve");
  add_number(*command, "--threads", options->threads, key_range("coupling.threads"),
             "Number of threads; 0: all cores");
  command->add_option("--out", options->out,
                      "Folder for result.json, the curve, a picture and a file for ParaView");
  add_json_option(*command, options->json);
  command->callback([options, &status] { status = run(*options); });
}

}  // namespace ripstop::cli
