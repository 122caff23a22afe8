// Checkpoints and results of runs: the seal, and below it what a seal would not find.
#include "ripstop/run/steady/checkpoint.h"

#include "reader.h"
#include "ripstop/core/hash.h"
#include "ripstop/run/opening/inflation_folder.h"
#include "ripstop/run/steady/steady.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ripstop;
  const std::string bytes = fuzz::text(data, size);
  const fuzz::InMemory file(data, size);
  fuzz::told([&] { read_sealed(file.path()); });
  fuzz::told([&] { to_bytes(steady_state_from_bytes(bytes)); });
  fuzz::told([&] { to_bytes(inflation_state_from_bytes(bytes)); });
  fuzz::told([&] { to_json(steady_result_from_json(bytes)); });
  return 0;
}
