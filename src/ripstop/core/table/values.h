// From the cells of a block to numbers in SI.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/core/table/layout.h"

namespace ripstop::table {

/// '.' or ',': by the user's word, or by cells that leave no choice; 0: no cell shows it. Throws Error(bad_data) where
/// cells contradict one another.
char decimal_mark(const std::vector<Block>& blocks, const Format& format, const std::filesystem::path& file);

/// A row has a cell for each known column, and none beyond the header. Throws Error(bad_data).
void check_rows(const Block& block, const std::filesystem::path& file);

/// Fills `column.values`, one for each row, or states in `column.problem` why this is impossible. `decimal`
/// as above.
void read_values(const Block& block, Column& column, char decimal, Decimal stated,
                 const std::filesystem::path& file);

}  // namespace ripstop::table
