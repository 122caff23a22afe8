// Ripstop's own VTK files, which a report reads back.
#include "reader.h"
#include "ripstop/output/vtk_read.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ripstop;
  const fuzz::InMemory file(data, size);
  fuzz::told([&] { read_vtk(file.path()); });
  return 0;
}
