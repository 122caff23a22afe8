// A test campaign.
#include "ripstop/material/bench.h"

#include "reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ripstop;
  const fuzz::InMemory file(data, size);
  fuzz::told([&] { read_bench(file.path()); });
  return 0;
}
