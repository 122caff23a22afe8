// ripstop fit: from the records of a tensile bench to a material file.

#include "ripstop/run/material/fit.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "fit_report.h"
#include "json_option.h"
#include "number_option.h"
#include "progress.h"
#include "ripstop/core/claimed_folder.h"
#include "table_options.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;

struct FitArguments {
  fs::path bench;
  fs::path out;
  int degree = 0;
  std::string columns, decimal;
  bool zero_offset = false;
  bool no_coupons = false;
  bool json = false;
  int threads = 0;
};

void print_directions(const MaterialFit& fit, double confidence) {
  for (const DirectionFit& d : fit.directions) {
    fmt::print(
        "\n{}: {} samples, up to strain {:.4g}, R2 {:.4f} of the mean ({:.4f} of all points), degree {}\n",
        d.name, d.samples.size(), d.fit.tested_strain, d.fit.r2, d.fit.r2_all, d.fit.degree);
    for (const CleanRecord& sample : d.samples) {
      fmt::print("  {}: fails at strain {:.4g} with {:.5g} {}\n", sample.name, sample.failure_strain,
                 sample.failure_load, load_unit(d));
      for (const std::string& text : sample.trimmed) fmt::print("    {}\n", text);
    }
    fmt::print("  K_0 {}\n", interval_text(d.fit.offset, load_unit(d), confidence));
    for (std::size_t k = 0; k < d.fit.k.size(); ++k)
      fmt::print("  K_{} {}{}\n", k + 1, interval_text(d.fit.k[k], load_unit(d), confidence),
                 k == 0 && d.fit.k[k].standard_error > 0 && std::isfinite(d.fit.k[k].standard_error)
                     ? "; the interval includes the error of a degree that is too low"
                     : "");
  }
}

void print_permeability(const MaterialFit& fit) {
  if (!fit.has_permeability) return;
  const PressureDrop& law = fit.permeability.law;
  fmt::print(
      "\nair permeability: dp = a v + b v |v| with a = {:.5g} Pa s/m, b = {:.5g} Pa s2/m2, {}; {:.4g} "
      "CFM/ft2 at half an inch of water\n",
      law.linear, law.quadratic,
      fit.permeability.one_point ? "from one reading" : fmt::format("R2 {:.4f}", fit.permeability.r2),
      cfm(law));
  if (law.linear > 0 && law.quadratic > 0) {
    const ErgunCloth cloth = ergun_cloth(law);
    fmt::print("  in Ergun's law ([NFM] Eq. 16): gamma {:.4f}, thickness {:.4g} mm\n", cloth.porosity,
               1e3 * cloth.thickness);
  }
}

void print_fit(const FitResult& result) {
  const auto& [bench, fit, coupons] = result;
  for (const std::string& line : fit.understood) fmt::print("{}\n", line);
  print_directions(fit, bench.confidence);
  print_permeability(fit);
  if (coupons) {
    fmt::print("\nxi {:.4f}{}, eps {:.4f}; coefficients multiplied by {:.5f} for the clamps\n",
               coupons->fabric.shear_fraction,
               std::isfinite(coupons->shear_low)
                   ? fmt::format(" ({:.0f} % interval {:.4f} to {:.4f})", 100 * bench.confidence,
                                 coupons->shear_low, coupons->shear_high)
                   : "",
               coupons->fabric.bending_fraction, coupons->rescale);
    print_coupons(coupons->coupons);
    for (const std::string& note : coupons->notes) fmt::print("note: {}\n", note);
  }
  for (const std::string& note : fit.notes) fmt::print("note: {}\n", note);
}

int run(const FitArguments& options) {
  Bench bench = read_bench(options.bench);
  if (options.degree > 0) bench.degree = options.degree;
  if (options.zero_offset) bench.zero_offset = true;
  if (!options.columns.empty()) bench.columns = options.columns;
  if (!options.decimal.empty()) bench.decimal = table::parse_decimal(options.decimal);
  table::parse_columns(bench.columns);  // a wrong one ends here, before any record is read
  const fs::path folder = options.out.empty() ? fs::path("runs") / bench.name : options.out;
  make_results_folder(folder, "fit");
  ThreadTeam team(options.threads);
  Progress progress;
  const FitResult result =
      run_fit(bench, !options.no_coupons, team, [&](int count, double xi, double eps, double misfit) {
        progress.show(fmt::format("coupons: {} computed, xi {:.4f}, eps {:.4f}, misfit {:.3e}", count, xi,
                                  eps, misfit));
      });
  if (result.coupons)
    progress.line(fmt::format("virtual coupons: {} evaluations in {}", result.coupons->evaluations,
                              duration_text(result.coupons->seconds)));
  const fs::path file = write_fit(folder, result);
  if (options.json) {
    fmt::print("{}", to_json(result));
  } else {
    print_fit(result);
    fmt::print("\n{}: the material; the same folder contains result.json, curve-*.png, curve-*.csv{}\n",
               file.string(), result.coupons ? ", coupon-*.png, coupon-*.vtp" : "");
  }
  std::fflush(stdout);
  for (const std::string& warning : result.fit.warnings) fmt::print(stderr, "warning: {}\n", warning);
  return 0;
}

}  // namespace

void add_fit(CLI::App& app, int& status) {
  auto options = std::make_shared<FitArguments>();
  CLI::App* command = app.add_subcommand("fit", "Fit a material file to tensile test records");
  command->footer("Example: ripstop fit examples/fit-ripstop/bench.toml --out my-cloth");
  command->add_option("bench", options->bench, "Test campaign (TOML): records, mass per area, thickness")
      ->required();
  command->add_option("--out", options->out, "Folder for the material and its plots")
      ->default_str("runs/<name>");
  add_number(*command, "--degree", options->degree, from(1).up_to(8), "Degree of the curves")
      ->default_str("degree_rule of the campaign");
  add_table_options(*command, options->columns, options->decimal, "force=Kraft [kN],extension=Weg [mm]");
  command->get_option("--decimal")->default_str("decimal of the campaign");
  command->add_flag("--zero-offset", options->zero_offset,
                    "Zero load at zero strain (K_0 = 0), also if the campaign has zero_offset = false");
  command->add_flag("--no-coupons", options->no_coupons,
                    "Do not fit shear fraction xi and bending fraction eps with virtual coupons");
  add_json_option(*command, options->json);
  add_number(*command, "--threads", options->threads, key_range("coupling.threads"),
             "Number of threads; 0: all cores");
  command->callback([options, &status] { status = run(*options); });
}

}  // namespace ripstop::cli
