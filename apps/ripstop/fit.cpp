// ripstop fit: from the records of a tensile bench to a material file.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "fit_report.h"
#include "progress.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

struct Options {
  fs::path bench;
  fs::path out;
  int degree = 0;
  bool zero_offset = false;
  bool no_coupons = false;
  int threads = 0;
};

void print_permeability(const MaterialFit& fit) {
  if (!fit.has_permeability) return;
  const PressureDrop& law = fit.permeability.law;
  fmt::print(
      "\nair permeability: dp = a v + b v |v| with a = {:.5g} Pa s/m, b = {:.5g} Pa s2/m2, {}; {:.4g} "
      "CFM/ft2 "
      "at half an inch of water\n",
      law.linear, law.quadratic,
      fit.permeability.one_point ? "from one reading" : fmt::format("R2 {:.4f}", fit.permeability.r2),
      cfm(law));
  if (law.linear > 0 && law.quadratic > 0) {
    const ErgunCloth cloth = ergun_cloth(law);
    fmt::print("  in Ergun's law ([NFM] Eq. 16): gamma {:.4f}, thickness {:.4g} mm\n", cloth.porosity,
               1e3 * cloth.thickness);
  }
}

int run(const Options& options) {
  Bench bench = read_bench(options.bench);
  if (options.degree > 0) bench.degree = options.degree;
  if (options.zero_offset) bench.zero_offset = true;
  MaterialFit fit = fit_material(bench);
  print_directions(fit);
  print_permeability(fit);

  std::unique_ptr<CouponFit> coupons;
  if (bench.kind == BenchKind::fabric && !options.no_coupons) {
    ThreadTeam team(options.threads);
    Progress progress;
    CouponFitOptions search;
    search.find_shear = !bench.shear_fraction;
    search.find_bending = !bench.bending_fraction;
    coupons = std::make_unique<CouponFit>(
        fit_coupons(fit, bench, search, team, [&](int count, double xi, double eps, double misfit) {
          progress.show(fmt::format("coupons: {} pulled, xi {:.4f}, eps {:.4f}, misfit {:.3e}", count, xi,
                                    eps, misfit));
        }));
    progress.line(fmt::format("virtual coupons: {} tries in {}", coupons->evaluations,
                              duration_text(coupons->seconds)));
    fit.warnings.insert(fit.warnings.end(), coupons->warnings.begin(), coupons->warnings.end());
    Fabric fabric = coupons->fabric;
    fabric.warning = fmt::format("{}", fmt::join(fit.warnings, "; "));
    fit.material = fabric;
    fmt::print("\nxi {:.4f}{}, eps {:.4f}, coefficients multiplied by {:.5f}\n", fabric.shear_fraction,
               std::isfinite(coupons->shear_low)
                   ? fmt::format(" ({:.4f} .. {:.4f})", coupons->shear_low, coupons->shear_high)
                   : "",
               fabric.bending_fraction, coupons->rescale);
    print_coupons(coupons->coupons);
    for (const std::string& note : coupons->notes) fmt::print("note: {}\n", note);
  }
  for (const std::string& note : fit.notes) fmt::print("note: {}\n", note);
  for (const std::string& warning : fit.warnings) fmt::print(stderr, "warning: {}\n", warning);

  const fs::path folder = options.out.empty() ? fs::path("runs") / bench.name : options.out;
  make_folder(folder);
  const fs::path file = folder / (bench.name + ".toml");
  write_file(file, material_toml(fit, bench, fit.material, coupons.get()));
  write_file(folder / "fit.json", fit_json(fit, bench, fit.material, coupons.get()));
  write_curves(folder, fit, bench, coupons ? coupons->coupons : std::vector<CouponComparison>{});
  if (coupons)
    for (const CouponComparison& c : coupons->coupons) write_coupon(folder, c.name, c.coupon, c.pull);
  read_material(file);  // what steady will do with it
  fmt::print("\n{}: the material; beside it fit.json, curve-*.png, curve-*.csv{}\n", file.string(),
             coupons ? ", coupon-*.png, coupon-*.vtp" : "");
  return 0;
}

}  // namespace

void add_fit(CLI::App& app, int& status) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("fit", "From tensile test records to a material file");
  command->footer("Example: ripstop fit examples/fit-ripstop/bench.toml --out my-cloth");
  command->add_option("bench", options->bench, "Test campaign (TOML): records, mass, thickness")->required();
  command->add_option("--out", options->out, "Folder for the material and its plots; default: runs/<name>");
  command->add_option("--degree", options->degree, "Degree of the curves; default: the lowest with R2 > 0.95")
      ->check(CLI::Range(1, 8));
  command->add_flag("--zero-offset", options->zero_offset, "Fit through zero load at zero strain (K_0 = 0)");
  command->add_flag("--no-coupons", options->no_coupons, "Leave out xi, eps and the virtual coupons");
  command->add_option("--threads", options->threads, "Threads; 0: all")->check(CLI::Range(0, 256));
  command->callback([options, &status] { status = run(*options); });
}

}  // namespace ripstop
