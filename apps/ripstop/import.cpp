// ripstop import: a case from a design file of another program.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "number_option.h"
#include "option.h"
#include "ripstop/case/case.h"
#include "ripstop/case/chute_import.h"
#include "ripstop/case/openrocket_import.h"
#include "ripstop/core/file.h"
#include "ripstop/core/visible.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;

struct ImportArguments {
  fs::path file;
  fs::path out;  // empty: the file's name with .toml, here
  bool force = false;
  std::optional<int> line_count;
  std::optional<double> line_length, vent_diameter, payload_mass;  // [m], [m], [kg]
  std::string device, diameter_is = "constructed";
};

struct Imported {
  std::string name;
  ImportedCase result;
};

void print_list(const char* title, const std::vector<std::string>& sentences) {
  if (sentences.empty()) return;
  fmt::print("{}\n", title);
  for (const std::string& sentence : sentences) fmt::print("  - {}\n", visible_line(sentence));
}

Imported from_openrocket(const ImportArguments& options) {
  const OpenRocketFile file = read_openrocket(options.file);
  const RecoveryDevice& device = choose_device(file, options.device);
  OpenRocketImportOptions import;
  import.diameter =
      options.diameter_is == "projected" ? GivenDiameter::projected : GivenDiameter::constructed;
  import.line_count = options.line_count, import.line_length = options.line_length;
  import.vent_diameter = options.vent_diameter, import.payload_mass = options.payload_mass;
  return {device.name, import_openrocket(file, device, import, options.file.filename().string())};
}

Imported from_chute(const ImportArguments& options) {
  if (!options.device.empty() || options.payload_mass || options.diameter_is != "constructed")
    throw Error(ExitCode::usage,
                "--device, --mass and --diameter-is are for files of OpenRocket (.ork, .orc) only");
  const ChuteFile file = read_chute(read_file(options.file), options.file.string());
  ChuteImportOptions import;
  import.line_count = options.line_count, import.line_length = options.line_length;
  import.vent_diameter = options.vent_diameter;
  return {file.name, import_chute(file, import, options.file.filename().string())};
}

int run(const ImportArguments& options) {
  const fs::path out = options.out.empty() ? fs::path(options.file.stem().string() + ".toml") : options.out;
  if (fs::exists(out) && fs::equivalent(out, options.file))
    throw Error(
        ExitCode::usage,
        fmt::format("{}: is the file to be imported, and its case would replace it; choose another --out",
                    out.string()));
  if (fs::exists(out) && !options.force)
    throw Error(ExitCode::usage,
                fmt::format("{} exists; choose another --out, or replace it with --force", out.string()));
  const std::string kind = options.file.extension().string();
  const bool openrocket = kind == ".ork" || kind == ".orc";
  const auto [name, result] = openrocket ? from_openrocket(options) : from_chute(options);
  fmt::print("{} ({}): type = \"{}\"\n", visible_line(name), options.file.string(), result.type);
  print_list("converted", result.mapped);
  print_list("converted with a change", result.changed);
  print_list("not converted", result.not_mapped);
  print_list("assumed, not in the file", result.assumed);
  std::fflush(stdout);  // before a refusal below
  const Case given = parse_case(result.case_text, out.string() + " (not written)");
  write_file(out, result.case_text);
  fmt::print("case file {}: S0 {:.4f} m2, cloth {:.4f} m2\n", out.string(), nominal_area(given.parachute),
             computed_area(given.parachute));
  return 0;
}

}  // namespace

void add_import(CLI::App& app, int& status) {
  auto options = std::make_shared<ImportArguments>();
  CLI::App* command = app.add_subcommand(
      "import", "Convert a design of openchute or a parachute of OpenRocket to a case file");
  command->footer(
      "The output lists the parts that were converted, changed, omitted and assumed.\n"
      "Example: ripstop import examples/elliptical/elliptical.chute --out elliptical.toml\n"
      "         ripstop import examples/openrocket/two-stage-recovery.ork --device Drogue --out drogue.toml");
  command->add_option("file", options->file, "Design of openchute (.chute) or OpenRocket (.ork, .orc)")
      ->required();
  command->add_option("--out", options->out, "Case file to write")
      ->default_str("name of the design with .toml");
  command->add_flag("--force", options->force, "Replace an existing case file");
  add_number(*command, "--lines", options->line_count, key_range("parachute.lines.count"), "Number of lines")
      ->default_str(fmt::format("that of the file; else one per gore, for a cross {}, for OpenRocket {}",
                                cross_line_count, openrocket_line_count));
  add_number(*command, "--line-length", options->line_length, key_range("parachute.lines.length_m"),
             "Length of a line [m]")
      ->default_str(
          fmt::format("that of the file; else the nominal diameter, for OpenRocket {:g} times this diameter",
                      openrocket_line_share));
  add_number(*command, "--vent-diameter", options->vent_diameter, from(1e-4).up_to(100),
             "Diameter of the vent [m]")
      ->default_str(
          fmt::format("that of the file; else {:g} % of the largest diameter, for OpenRocket {:g} %",
                      100 * chute_vent_share, 100 * openrocket_vent_share));
  command->add_option("--device", options->device, "OpenRocket: number or name of the parachute")
      ->default_str("the only one");
  add_choice(*command, "--diameter-is", options->diameter_is, {"constructed", "projected"},
             "OpenRocket: meaning of the diameter, \"constructed\" (cloth laid flat) or \"projected\" (open "
             "canopy, with C_D on its area)");
  add_number(*command, "--mass", options->payload_mass, key_range("payload.mass_kg"),
             "OpenRocket: mass of the payload, without the parachutes [kg]")
      ->default_str("that of a simulation stored in the file");
  command->callback([options, &status] { status = run(*options); });
}

}  // namespace ripstop::cli
