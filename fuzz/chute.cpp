// A design of openchute, on to the case that is made of it.
#include "reader.h"
#include "ripstop/case/case.h"
#include "ripstop/case/chute_import.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ripstop;
  fuzz::told([&] {
    const ImportedCase result = import_chute(read_chute(fuzz::text(data, size), "x.chute"), {}, "x.chute");
    parse_case(result.case_text, "x.toml");
  });
  return 0;
}
