// A hostfile of MPI.
#include "reader.h"
#include "ripstop/flow/openfoam/hostfile.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ripstop;
  fuzz::told([&] { openfoam::parse_hosts(fuzz::text(data, size), "hosts"); });
  return 0;
}
