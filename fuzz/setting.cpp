// KEY=VALUE of the command line over an example: "--set", lines of settings.
#include <sstream>

#include "reader.h"
#include "ripstop/case/case.h"
#include "ripstop/core/build_info.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ripstop;
  static const std::string example = read_text_file(data_directory() / "examples/flat-circular/case.toml");
  fuzz::told([&] {
    Overrides overrides;
    std::istringstream lines(fuzz::text(data, size));
    for (std::string line; std::getline(lines, line) && overrides.set.size() < 8;) {
      split_values(line);
      overrides.set.push_back(parse_setting(line, "--set"));
    }
    parse_case(example, "case.toml", overrides);
  });
  return 0;
}
