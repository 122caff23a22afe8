// ripstop studio: the page to design a parachute in, for a browser on this computer.

#include <fmt/format.h>
#include <signal.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "commands.h"
#include "number_option.h"
#include "ripstop/core/error.h"
#include "ripstop/core/process.h"
#include "ripstop/studio/server.h"

namespace ripstop::cli {
namespace {

namespace fs = std::filesystem;

struct StudioArguments {
  fs::path folder = ".";
  int port = 0;
  bool no_browser = false;
};

/// Without a desktop there is no browser to start; the address is printed in any case.
void open_browser(const std::string& address) {
  try {
    ProcessRequest request;
    request.arguments = {"xdg-open", address};
    request.time_limit_s = 20;
    run_process(request);
  } catch (const Error&) {
    return;
  }
}

int studio(const StudioArguments& options) {
  if (!fs::is_directory(options.folder))
    throw Error(ExitCode::usage, fmt::format("{} is not a folder; create it first", options.folder.string()));
  // All threads inherit the mask, so that the signals reach sigwait() alone.
  sigset_t ends;
  sigemptyset(&ends);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ends, number);
  pthread_sigmask(SIG_BLOCK, &ends, nullptr);
  StudioServer server(options.folder, fs::read_symlink("/proc/self/exe").string(), options.port);
  std::thread serving([&] { server.serve(); });
  server.wait_until_ready();  // a stop before that would have no effect
  fmt::print("{}\n", server.address());
  fmt::print(stderr, "Ripstop Studio on {}; end it with Ctrl-C\n", fs::canonical(options.folder).string());
  std::fflush(stdout);
  std::thread browser;
  if (!options.no_browser) browser = std::thread(open_browser, server.address());
  int number = 0;
  sigwait(&ends, &number);
  server.stop();
  serving.join();
  if (browser.joinable()) browser.join();
  return 0;
}

}  // namespace

void add_studio(CLI::App& app, int& status) {
  auto options = std::make_shared<StudioArguments>();
  CLI::App* command =
      app.add_subcommand("studio", "Design a parachute, start its runs and see results in a browser");
  command->footer(
      "The page is served to this computer only, under an address with a random token. It reads and writes "
      "files of\n"
      "the folder, and writes ordinary run folders into its subfolder runs/.\n"
      "Example: ripstop studio my-parachutes --no-browser");
  command->add_option("folder", options->folder, "Folder with the case files");
  add_number(*command, "--port", options->port, from(0).up_to(65535), "Port")->default_str("a free one");
  command->add_flag("--no-browser", options->no_browser, "Only print the address");
  command->callback([options, &status] { status = studio(*options); });
}

}  // namespace ripstop::cli
