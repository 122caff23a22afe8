#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "commands.h"
#include "ripstop/core/build_info.h"
#include "ripstop/core/error.h"

namespace ripstop {
namespace {

int run(int argc, char** argv) {
  CLI::App app{
      "Ripstop predicts how a subsonic parachute flies: its inflated shape, drag, stresses and loads."};
  app.set_version_flag("--version", version());
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::help);
  app.footer(
      "Exit codes: 0 done, 2 usage or case file, 3 bad input data, 4 not converged, 5 diverged,\n"
      "6 external solver, 7 input/output. Each command has its own --help with an example.");
  int status = 0;
  add_check(app, status);
  add_schema(app, status);
  add_steady(app, status);
  add_fabric(app, status);
  add_fit(app, status);
  add_coupon(app, status);
  add_inflate(app, status);
  add_pattern(app, status);
  add_import(app, status);
  add_flow_parity(app, status);
  add_calibrate(app, status);
  add_sweep(app, status);
  add_compare(app, status);
  add_photogrammetry(app, status);
  add_descent(app, status);
  add_report(app, status);
  add_load(app, status);
  add_size(app, status);
  add_export(app, status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : static_cast<int>(ExitCode::usage);
  } catch (const Error& error) {
    fmt::print(stderr, "ripstop: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return status;
}

}  // namespace
}  // namespace ripstop

int main(int argc, char** argv) {
  try {
    return ripstop::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ripstop: internal error: %s\n", error.what());
  } catch (...) {
    std::fputs("ripstop: internal error\n", stderr);
  }
  return 70;
}
