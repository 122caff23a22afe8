// A tensile record, from its bytes to a clean curve.
#include "reader.h"
#include "ripstop/material/clean.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ripstop;
  for (const bool line : {true, false})
    fuzz::told([&] {
      const TensileRecord record = parse_record(fuzz::text(data, size), "record.csv", {0.2, 0.05, 0});
      const CleanRecord clean = clean_record(record, line ? LoadKind::whole : LoadKind::per_width);
      if (clean.strain.size() != clean.load.size() || !(clean.failure_strain > 0)) std::abort();
    });
  return 0;
}
