// A file of the material library.
#include "reader.h"
#include "ripstop/material/library.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ripstop;
  const fuzz::InMemory file(data, size);
  fuzz::told([&] { material_to_toml(read_material(file.path())); });
  return 0;
}
