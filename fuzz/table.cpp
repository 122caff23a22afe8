// A table from a machine, in one of three formats: all of its columns, those of a tensile test, those of a drag
// measurement. The number of bytes selects the format, so that one input is one execution of the reader.
#include "ripstop/core/table/table.h"

#include <cmath>
#include <iterator>

#include "reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ripstop;
  using table::Quantity;
  const std::string bytes = fuzz::text(data, size);
  static const table::Format formats[] = {
      {},
      {{Quantity::force, Quantity::extension, Quantity::strain, Quantity::time}, {}, table::Decimal::comma},
      {{Quantity::speed, Quantity::force}, {{Quantity::force, "Load", "kN"}}, table::Decimal::automatic}};
  fuzz::told([&] {
    const table::Table read = table::parse_table(bytes, "table.csv", formats[size % std::size(formats)]);
    if (read.specimens.empty() || explanation(read).empty()) std::abort();
    for (const table::Specimen& specimen : read.specimens) {
      if (specimen.lines.empty()) std::abort();
      for (const table::Column& column : specimen.columns) {
        if (column.problem.empty() && column.values.size() != specimen.lines.size()) std::abort();
        for (const double value : column.values)
          if (std::isinf(value)) std::abort();
      }
    }
  });
  return 0;
}
