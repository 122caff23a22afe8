// ripstop pattern: the cutting pattern of the parachute of a case.

#include "ripstop/run/sizing/pattern.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>

#include "case_options.h"
#include "commands.h"
#include "json_option.h"
#include "margins.h"
#include "number_option.h"
#include "option.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;

struct PatternArguments {
  fs::path case_file;
  fs::path out = "pattern";
  Allowances allowances;
  double packing_density = packed_by_hand;
  std::string units = "mm", paper;
  bool json = false;
};

void print_bill(const Bill& bill) {
  std::size_t part = 21, material = 8;  // of the last line and of the headings
  for (const BillRow& row : bill.rows) {
    part = std::max(part, row.part.size());
    material = std::max(material, row.material.size());
  }
  fmt::print("{:<{}} {:<{}} {:>5} {:>11} {:>11} {:>11} {:>9}\n", "part", part, "material", material, "count",
             "cut each", "finished", "cut", "mass");
  for (const BillRow& row : bill.rows) {
    const char* unit = row.is_cloth ? "m2" : "m ";
    fmt::print("{:<{}} {:<{}} {:>5} {:>8.3f} {} {:>8.3f} {} {:>8.3f} {} {:>7.1f} g\n", row.part, part,
               row.material, material, row.count, row.cut_each(), unit, row.finished, unit, row.cut, unit,
               1000 * row.mass);
  }
  fmt::print("{:<{}} {:>7.1f} g\n", "total, without thread", part + material + 44, 1000 * bill.mass);
}

/// Lengths that the bill does not show: allowances, hems, and lines on the canopy.
void print_lengths(const PatternResult& r) {
  const Allowances& extra = r.allowances;
  fmt::print("cut lengths include {:g} mm at each end of a line or riser and {:g} mm for each tape\n",
             1000 * extra.line_loop, 1000 * extra.tape_overlap);
  if (r.line_on_canopy > 0)
    fmt::print("suspension lines: {:.3f} m of each are sewn to the canopy, {:.3f} m are free\n",
               r.line_on_canopy, r.line_length);
  for (const CutLength& hem : r.hems)
    fmt::print("hem, {}: total length {:.3f} m, folded from an allowance of {:g} mm\n", hem.name, hem.length,
               1000 * extra.hem);
}

int run(const PatternArguments& options) {
  PatternFiles files;
  files.unit = options.units == "in" ? DxfUnit::inches : DxfUnit::millimetres;
  if (!options.paper.empty()) files.paper = options.paper == "letter" ? Paper::letter : Paper::a4;
  files.case_file = options.case_file.string();
  files.date = today();
  const PatternResult result =
      run_pattern(read_settings(options.case_file), options.allowances, options.packing_density);
  write_pattern(options.out, result, files);
  if (options.json) {
    fmt::print("{}", to_json(result));
    return 0;
  }
  print_bill(result.bill);
  print_lengths(result);
  fmt::print("packed volume: {}\n", packed_text(result.bill.mass, result.bill.packed_volume));
  fmt::print("S0 {:.4f} m2, cloth {:.4f} m2 finished\n", result.nominal_area, result.cloth_area);
  fmt::print("outlines: {} as DXF (in {}), SVG{}, bill.csv and result.json in {}\n",
             result.pattern.pieces.size(), files.unit == DxfUnit::inches ? "inches" : "millimetres",
             files.paper ? ", PDF on sheets of paper" : "", options.out.string());
  return 0;
}

}  // namespace

void add_pattern(CLI::App& app, int& status) {
  auto options = std::make_shared<PatternArguments>();
  CLI::App* command = app.add_subcommand(
      "pattern", "Write the cutting pattern: outlines to scale, bill of materials, packed volume");
  command->footer("Example: ripstop pattern examples/adept/case.toml --out adept-pattern");
  command->add_option("case", options->case_file, "Case file (TOML)")->required();
  command->add_option("--out", options->out, "Folder for the files");
  const auto length = [&](const char* name, double& value, const char* text) {
    add_number(*command, name, value, allowance_range, text);
  };
  length("--seam-allowance", options->allowances.seam, "Seam allowance of the cloth [m]");
  length("--hem-allowance", options->allowances.hem, "Hem allowance of the cloth [m]");
  length("--line-loop", options->allowances.line_loop, "Extra length of line at each end for its loop [m]");
  length("--tape-overlap", options->allowances.tape_overlap, "Extra length of each tape [m]");
  add_number(*command, "--packing-density", options->packing_density, packing_density_range,
             "Density of the packed parachute, 250 (loose) to 400 by hand, 600 with a press [kg/m3]");
  add_choice(*command, "--units", options->units, {"mm", "in"},
             "Unit of the DXF files; the printed table is in SI");
  add_choice(*command, "--paper", options->paper, {"a4", "letter"},
             "Also as PDF at true size on sheets of this paper, with registration marks");
  add_json_option(*command, options->json);
  command->callback([options, &status] { status = run(*options); });
}

}  // namespace ripstop::cli
