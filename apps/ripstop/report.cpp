// ripstop report: finished runs as one HTML file.

#include "ripstop/run/report/report.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <vector>

#include "commands.h"
#include "ripstop/run/used_run.h"
#include "warnings.h"

namespace ripstop::cli {
namespace {

struct ReportArguments {
  std::vector<std::filesystem::path> runs;
  std::filesystem::path out;
};

}  // namespace

void add_report(CLI::App& app, int& status) {
  auto options = std::make_shared<ReportArguments>();
  CLI::App* command = app.add_subcommand(
      "report", "Write finished runs as one HTML file: 3D shape, flow, plots, tables, comparison of runs");
  command->footer(
      "The commands steady, inflate, fly and sweep also write this file into their run folders.\n"
      "Example: ripstop report runs/stratos-iv runs/walrus --out both.html");
  command->add_option("runs", options->runs, "Folders of finished runs of steady, inflate, fly or sweep")
      ->required();
  command->add_option("--out", options->out, "File")
      ->default_str("report.html in the run folder; for several runs, in the current folder");
  command->callback([options, &status] {
    fmt::print("{}\n", write_report(options->runs, options->out).string());
    print_warnings(warnings_of_shown(options->runs));
    status = 0;
  });
}

}  // namespace ripstop::cli
