// ripstop schema: the keys of a case file, for editors and for people.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "commands.h"
#include "ripstop/case/case.h"

namespace ripstop::cli {

void add_schema(CLI::App& app, int& status) {
  auto reference = std::make_shared<bool>(false);
  CLI::App* command =
      app.add_subcommand("schema", "Print the JSON Schema of a case file, for editors and checks");
  command->footer("Example: ripstop schema > ripstop-case.schema.json");
  command->add_flag("--reference", *reference, "Print all keys as tables in Markdown instead");
  command->callback([reference, &status] {
    fmt::print("{}", *reference ? case_reference() : case_schema());
    status = 0;
  });
}

}  // namespace ripstop::cli
