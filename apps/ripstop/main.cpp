#include <CLI/CLI.hpp>

#include "ripstop/core/build_info.h"

int main(int argc, char** argv) {
  CLI::App app{"Ripstop predicts how a subsonic parachute flies."};
  app.set_version_flag("--version", ripstop::version());
  CLI11_PARSE(app, argc, argv);
  return 0;
}
