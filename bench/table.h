// Tables of docs/tables, as Markdown on standard output: title, command, machine and day.
#pragma once

#include <fmt/chrono.h>
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <ctime>
#include <string>
#include <thread>
#include <vector>

#include "ripstop/core/build_info.h"

namespace ripstop {

inline void print_row(const std::vector<std::string>& cells) {
  fmt::print("| {} |\n", fmt::join(cells, " | "));
  std::fflush(stdout);
}

inline void print_table_head(const std::string& title, int argc, char** argv,
                             const std::vector<std::string>& columns) {
  const std::tm now = fmt::gmtime(std::time(nullptr));
  fmt::print("# {}\n\n`{}`: {}, {} threads, {} {:%B %Y}.\n\n", title, fmt::join(argv, argv + argc, " "),
             processor(), std::thread::hardware_concurrency(), now.tm_mday, now);
  print_row(columns);
  print_row(std::vector<std::string>(columns.size(), "---"));
}

}  // namespace ripstop
