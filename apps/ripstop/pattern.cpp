// ripstop pattern: what to cut for the parachute of a case.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "ripstop/case/assemble.h"
#include "ripstop/core/file.h"
#include "ripstop/output/pattern_files.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

struct Options {
  fs::path case_file;
  fs::path out = "pattern";
  Allowances allowances;
  double packing_density = 400;
};

void print_bill(const Bill& bill) {
  fmt::print("{:<24} {:<16} {:>5} {:>14} {:>14} {:>10}\n", "part", "material", "count", "finished", "cut",
             "mass");
  for (const BillRow& row : bill.rows) {
    const char* unit = row.is_cloth ? "m2" : "m ";
    fmt::print("{:<24} {:<16} {:>5} {:>11.3f} {} {:>11.3f} {} {:>8.1f} g\n", row.part, row.material,
               row.count, row.finished, unit, row.cut, unit, 1000 * row.mass);
  }
  fmt::print("{:<24} {:>73.1f} g\n", "all, without thread", 1000 * bill.mass);
}

int run(const Options& options) {
  const Case value = read_case(options.case_file);
  const CutPattern pattern = cut_pattern(value.parachute);
  const Bill bill =
      bill_of(pattern, value.parachute, part_materials(value), options.allowances, options.packing_density);
  print_bill(bill);
  fmt::print("packed at {:.0f} kg/m3: {:.3f} l\n", options.packing_density, 1000 * bill.packed_volume);
  fmt::print("S0 {:.4f} m2, cloth {:.4f} m2 finished\n", nominal_area(value.parachute),
             computed_area(value.parachute));
  make_folder(options.out);
  for (const Piece& piece : pattern.pieces) {
    std::string name = piece.name;
    std::replace(name.begin(), name.end(), ' ', '-');
    write_pattern_dxf(options.out / (name + ".dxf"), piece, options.allowances);
    write_pattern_svg(options.out / (name + ".svg"), piece, options.allowances);
  }
  write_bill_csv(options.out / "bill.csv", bill);
  fmt::print("{} pieces as DXF and SVG (1 unit = 1 mm) and bill.csv in {}\n", pattern.pieces.size(),
             options.out.string());
  return 0;
}

}  // namespace

void add_pattern(CLI::App& app, int& status) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "pattern",
      "What to cut: outlines to scale, lengths of tape and line, bill of materials, packed volume");
  command->footer("Example: ripstop pattern examples/adept/case.toml --out adept-pattern");
  command->add_option("case", options->case_file, "Case file (TOML)")->required();
  command->add_option("--out", options->out, "Folder for the files")->capture_default_str();
  const auto length = [&](const char* name, double& value, const char* text) {
    command->add_option(name, value, text)->check(CLI::Range(0.0, 1.0))->capture_default_str();
  };
  length("--seam-allowance", options->allowances.seam, "Cloth beyond a seam [m]");
  length("--hem-allowance", options->allowances.hem, "Cloth beyond a free edge [m]");
  length("--line-loop", options->allowances.line_loop, "Line beyond either end, for its loop [m]");
  length("--tape-overlap", options->allowances.tape_overlap, "Tape beyond its finished length [m]");
  command
      ->add_option("--packing-density", options->packing_density,
                   "[kg/m3]: about 400 packed by hand, 600 under a press")
      ->check(CLI::Range(50.0, 1500.0))
      ->capture_default_str();
  command->callback([options, &status] { status = run(*options); });
}

}  // namespace ripstop
