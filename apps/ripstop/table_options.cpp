#include "table_options.h"

#include <CLI/CLI.hpp>

namespace ripstop::cli {

void add_table_options(CLI::App& command, std::string& columns, std::string& decimal,
                       const std::string& example) {
  command.add_option(
      "--columns", columns,
      "Columns of the table that are not recognised by their headings, for example \"" + example + "\"");
  command.add_option("--decimal", decimal, "Decimal mark, where numbers are ambiguous (default: auto)")
      ->check(CLI::IsMember({"auto", "point", "comma"}))
      ->option_text("auto|point|comma");
}

}  // namespace ripstop::cli
