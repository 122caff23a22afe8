// ripstop report: finished runs as one HTML file.

#include "ripstop/run/report/report.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <vector>

#include "commands.h"

namespace ripstop {
namespace {

struct ReportArguments {
  std::vector<std::filesystem::path> runs;
  std::filesystem::path out;
};

}  // namespace

void add_report(CLI::App& app, int& status) {
  auto options = std::make_shared<ReportArguments>();
  CLI::App* command = app.add_subcommand(
      "report", "Finished runs as one HTML file: shape in 3D, flow, plots, tables, several runs compared");
  command->footer(
      "steady, inflate and sweep write it into their folder themselves.\n"
      "Example: ripstop report runs/stratos-iv runs/walrus --out both.html");
  command->add_option("runs", options->runs, "Folders of finished runs of steady, inflate or sweep")
      ->required();
  command->add_option("--out", options->out,
                      "File (default: report.html in the run's folder; of several runs, here)");
  command->callback([options, &status] {
    fmt::print("{}\n", write_report(options->runs, options->out).string());
    status = 0;
  });
}

}  // namespace ripstop
