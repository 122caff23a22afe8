#include "table_options.h"

#include <CLI/CLI.hpp>

#include "option.h"

namespace ripstop::cli {

void add_table_options(CLI::App& command, std::string& columns, std::string& decimal,
                       const std::string& example) {
  command.add_option(
      "--columns", columns,
      "Columns of the table that are not recognised by their headings, for example \"" + example + "\"");
  add_choice(command, "--decimal", decimal, {"auto", "point", "comma"},
             "Decimal mark, where numbers are ambiguous");
}

}  // namespace ripstop::cli
