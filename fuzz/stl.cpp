// A surface.
#include "ripstop/flow/stl.h"

#include "reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ripstop;
  const fuzz::InMemory file(data, size);
  fuzz::told([&] {
    if (read_stl(file.path()).empty()) std::abort();
  });
  return 0;
}
