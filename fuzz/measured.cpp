// A table that the program has written itself.
#include "reader.h"
#include "ripstop/output/csv.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ripstop;
  const fuzz::InMemory file(data, size);
  fuzz::told([&] {
    const CsvTable table = read_csv(file.path());
    for (const std::string& name : table.columns)
      if (table.column(name).size() != table.rows.size()) std::abort();
  });
  return 0;
}
