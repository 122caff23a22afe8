// A case file. A valid one survives being written and read, and what it takes of the machine can be said.
#include "reader.h"
#include "ripstop/case/cost.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ripstop;
  fuzz::told([&] {
    const Case given = parse_case(fuzz::text(data, size), "case.toml");
    const std::string written = case_toml(resolve(given));
    if (case_toml(resolve(parse_case(written, "written.toml"))) != written) std::abort();
    if (!(cost_of(resolve(given)).memory > 0)) std::abort();
  });
  return 0;
}
