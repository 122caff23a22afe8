// Sizes read off a camera image.
#include "reader.h"
#include "ripstop/calibration/photogrammetry.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ripstop;
  const fuzz::InMemory file(data, size);
  fuzz::told([&] { read_image(file.path()); });
  return 0;
}
