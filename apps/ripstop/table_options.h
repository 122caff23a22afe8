// --columns and --decimal of the commands that read tables.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace ripstop::cli {

void add_table_options(CLI::App& command, std::string& columns, std::string& decimal,
                       const std::string& example);

}  // namespace ripstop::cli
