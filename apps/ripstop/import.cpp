// ripstop import: a case from a design file of another program.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "number_option.h"
#include "ripstop/case/case.h"
#include "ripstop/case/chute_import.h"
#include "ripstop/core/file.h"
#include "ripstop/core/visible.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

struct ImportArguments {
  fs::path file;
  fs::path out;  // empty: the file's name with .toml, here
  bool force = false;
  ChuteImportOptions import;
};

void print_list(const char* title, const std::vector<std::string>& sentences) {
  if (sentences.empty()) return;
  fmt::print("{}\n", title);
  for (const std::string& sentence : sentences) fmt::print("  - {}\n", visible_line(sentence));
}

int run(const ImportArguments& options) {
  const fs::path out = options.out.empty() ? fs::path(options.file.stem().string() + ".toml") : options.out;
  if (fs::exists(out) && !options.force)
    throw Error(ExitCode::usage,
                fmt::format("{} exists; choose another --out, or replace it with --force", out.string()));
  const ChuteFile file = read_chute(read_file(options.file), options.file.string());
  const ChuteImport result = import_chute(file, options.import, options.file.filename().string());
  fmt::print("{} ({}): type = \"{}\"\n", visible_line(file.name), options.file.string(), result.type);
  print_list("converted", result.mapped);
  print_list("converted with a change", result.changed);
  print_list("not converted", result.not_mapped);
  print_list("assumed, not in the file", result.assumed);
  std::fflush(stdout);  // before a refusal below
  const Case given = parse_case(result.case_text, out.string());
  write_file(out, result.case_text);
  fmt::print("S0 {:.4f} m2, cloth {:.4f} m2: {}\n", nominal_area(given.parachute),
             computed_area(given.parachute), out.string());
  return 0;
}

}  // namespace

void add_import(CLI::App& app, int& status) {
  auto options = std::make_shared<ImportArguments>();
  CLI::App* command = app.add_subcommand(
      "import",
      "Convert a .chute file of openchute to a case file and list converted, changed and omitted parts");
  command->footer("Example: ripstop import examples/elliptical/elliptical.chute --out elliptical.toml");
  command->add_option("file", options->file, "Design of openchute (.chute)")->required();
  command->add_option("--out", options->out, "Case file to write (default: name of the design with .toml)");
  command->add_flag("--force", options->force, "Replace an existing case file");
  add_number(*command, "--lines", options->import.line_count, key_range("parachute.lines.count"),
             "Number of lines (default: one per gore)");
  add_number(*command, "--line-length", options->import.line_length, key_range("parachute.lines.length_m"),
             "Length of a line [m] (default: the nominal diameter)");
  add_number(*command, "--vent-diameter", options->import.vent_diameter, from(1e-4).up_to(100),
             "Diameter of the vent where gores end in a point [m] (default: 4 % of the widest diameter)");
  command->callback([options, &status] { status = run(*options); });
}

}  // namespace ripstop
