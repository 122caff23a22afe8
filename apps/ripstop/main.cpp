#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

#include "commands.h"
#include "option.h"
#include "ripstop/case/quantity_keys.h"
#include "ripstop/core/build_info.h"
#include "ripstop/core/error.h"
#include "ripstop/core/reasons.h"
#include "ripstop/core/visible.h"
#include "stopping.h"

namespace ripstop::cli {
namespace {

int failed(ExitCode code, const std::string& message) {
  std::fprintf(stderr, "ripstop: %s\n", visible(message).c_str());
  return static_cast<int>(code);
}

int parse(CLI::App& app, int argc, char** argv, const int& status) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& done) {  // --help, --version
    const std::string message = unknown_command(app, argc, argv);
    return message.empty() ? app.exit(done) : failed(ExitCode::usage, message);
  } catch (const CLI::ParseError& error) {
    return failed(ExitCode::usage, usage_message(app, error, argc, argv));
  } catch (const Error& error) {
    return failed(error.code(), message_of(error));
  } catch (const std::bad_alloc&) {
    return failed(ExitCode::resources, "not enough memory: use fewer nodes, cells or simultaneous runs");
  } catch (const std::filesystem::filesystem_error& error) {
    return failed(ExitCode::io, file_reason(error));
  } catch (const std::system_error& error) {  // of output
    return failed(ExitCode::io, error.what());
  }
  return status;
}

/// A result that nobody got is no success.
int written(int status) {
  errno = 0;
  const bool fine = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (fine || status != 0) return status;
  return failed(ExitCode::io, fmt::format("cannot write to standard output{}{}", errno ? ": " : "",
                                          errno ? std::strerror(errno) : ""));
}

int run(int argc, char** argv) {
  say_when_stopped();
  CLI::App app{
      "Ripstop predicts the inflated shape, drag, stresses and opening loads of subsonic parachutes."};
  app.set_version_flag("--version", version());
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 2 usage or case file, 3 bad input data, 4 not converged, or outside\n"
      "a limit of quality, 5 diverged, 6 external solver, 7 input/output, 8 not enough memory or\n"
      "threads, 70 internal error, 128 + N ended by signal N.\n"
      "Each command has its own --help with an example.\n"
      "[NFM] and other sources: docs/references.bib.");
  int status = 0;
  app.formatter(help_format());
  app.option_defaults()->always_capture_default();
  add_studio(app, status);
  add_size(app, status);
  add_import(app, status);
  add_check(app, status);
  add_fabric(app, status);
  add_steady(app, status);
  add_inflate(app, status);
  add_fly(app, status);
  add_stability(app, status);
  add_sweep(app, status);
  add_load(app, status);
  add_recovery(app, status);
  add_descent(app, status);
  add_pattern(app, status);
  add_export(app, status);
  add_report(app, status);
  add_compare(app, status);
  add_compare_flight(app, status);
  add_photogrammetry(app, status);
  add_materials(app, status);
  add_fit(app, status);
  add_coupon(app, status);
  add_calibrate(app, status);
  add_flow_parity(app, status);
  add_schema(app, status);
  show_defaults(app);
  return written(parse(app, argc, argv, status));
}

}  // namespace
}  // namespace ripstop::cli

int main(int argc, char** argv) {
  try {
    return ripstop::cli::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ripstop: internal error: %s; please report it with the command and the case\n",
                 error.what());
  } catch (...) {
    std::fputs("ripstop: internal error\n", stderr);
  }
  return 70;
}
