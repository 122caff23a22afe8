#include "ripstop/core/table/layout.h"

#include <fmt/format.h>

#include <algorithm>

#include "ripstop/core/error.h"
#include "ripstop/core/table/number.h"
#include "ripstop/core/table/text.h"

namespace ripstop::table {
namespace {

constexpr std::size_t most_preamble = 60;  // rows between two specimens

bool is_text(const std::string& cell) {
  return !cell.empty() && !is_value(cell);
}

std::string marker_name(const Row& row) {
  std::string name;
  for (const std::string& cell : row.cells)
    if (!cell.empty()) name += (name.empty() ? "" : " ") + cell;
  return name;
}

/// Cells of known columns: how many are values, and how many are text.
struct Cells {
  std::size_t values = 0, texts = 0;
};
Cells cells_of(const Row& row, const Block& block) {
  Cells cells;
  for (const Column& column : block.columns) {
    const auto i = static_cast<std::size_t>(column.place - 1);
    if (i >= row.cells.size() || row.cells[i].empty()) continue;
    ++(is_value(row.cells[i]) || column.quantity == Quantity::specimen ? cells.values : cells.texts);
  }
  return cells;
}

/// Takes rows into blocks from one header to the next.
class Reader {
 public:
  Reader(const std::vector<Row>& rows, KnownHeadings& known, const std::filesystem::path& file)
      : rows_(rows), known_(known), format_(known.format()), file_(file) {}

  Layout read() {
    HeaderSearch search;
    Header header;
    if (!find_header(rows_, 0, known_, search, header) &&
        !find_header(rows_, 0, known_, search = {2, true}, header) &&
        !find_header(rows_, 0, known_, search = {1, false}, header))
      refuse_without_header();
    std::size_t from = 0;
    do {
      start(make_block(rows_, header, format_, file_, layout_.notes), from, header);
      from = take_rows(header.data);
    } while (from < rows_.size() && find_header(rows_, from, known_, search, header));
    if (std::all_of(layout_.blocks.begin(), layout_.blocks.end(),
                    [](const Block& block) { return block.columns.empty(); }) &&
        format_.wanted.empty())
      refuse_without_header();
    std::erase_if(layout_.blocks, [](const Block& block) { return block.rows.empty(); });
    leave_out_results();
    return std::move(layout_);
  }

 private:
  /// A single row below its own header, next to records of several rows, has the results of a test and no record.
  void leave_out_results() {
    constexpr std::size_t shortest_record = 3;
    const auto is_record = [](const Block& block) { return block.rows.size() >= shortest_record; };
    if (std::none_of(layout_.blocks.begin(), layout_.blocks.end(), is_record)) return;
    std::erase_if(layout_.blocks, [&](const Block& block) {
      if (block.rows.size() > 1) return false;
      layout_.notes.push_back(fmt::format(
          "the single row below the header in line {} is ignored: it is no record", block.header_line));
      return true;
    });
  }
  Block& block() { return layout_.blocks.back(); }

  void start(Block next, std::size_t from, const Header& header) {
    if (!layout_.blocks.empty() && block().rows.empty())
      next.name = block().name;  // a line before its preamble
    for (std::size_t r = from; r < header.data; ++r)
      if (is_marker(rows_[r])) next.name = marker_name(rows_[r]);
    with_specimens_ = std::any_of(next.columns.begin(), next.columns.end(),
                                  [](const Column& column) { return column.quantity == Quantity::specimen; });
    layout_.blocks.push_back(std::move(next));
  }

  /// Rows of the last block from this one on; the row to look for another header from.
  std::size_t take_rows(std::size_t first) {
    std::size_t text = rows_.size();  // the first row of text after the numbers
    bool loose = false;  // after such a row or an empty one: the preamble of another specimen may begin
    for (std::size_t r = first; r < rows_.size(); ++r) {
      const Row& row = rows_[r];
      if (row.comment) continue;
      if (row.blank()) {
        loose = true;
        continue;
      }
      if (!with_specimens_ && is_marker(row)) {
        Block next = block();
        next.rows.clear();
        next.name = marker_name(row);
        layout_.blocks.push_back(std::move(next));
        text = rows_.size();
        loose = true;
        continue;
      }
      const Cells cells = cells_of(row, block());
      if (known_.count(row) >= 2) return std::min(text, r);
      const bool numbers = cells.values > 0 && !(loose && cells.texts > 0 && header_ahead(r));
      if (!numbers) {
        if (cells.texts == 0 && cells.values == 0) continue;  // only in columns that are not used
        text = std::min(text, r);
        loose = true;
        continue;
      }
      if (text < rows_.size())
        refuse(file_, rows_[text].line,
               fmt::format("text between the numbers (\"{}\"), which continue in line {}: remove this line, "
                           "or repeat the header below it if another specimen begins",
                           marker_name(rows_[text]).substr(0, 60), row.line));
      block().rows.push_back(&row);
      loose = false;
    }
    if (text < rows_.size())
      layout_.notes.push_back(
          fmt::format("text after the numbers is ignored (from line {})", rows_[text].line));
    return rows_.size();
  }

  /// Whether these rows lead to another header.
  bool header_ahead(std::size_t r) {
    const std::size_t end = std::min(rows_.size(), r + most_preamble);
    for (; r < end; ++r)
      if (!rows_[r].comment && known_.count(rows_[r]) >= 2) return true;
    return false;
  }

  [[noreturn]] void refuse_without_header() {
    const Row *last_text = nullptr, *header = nullptr;
    for (const Row& row : rows_) {
      if (row.blank() || row.comment) continue;
      const auto values = std::count_if(row.cells.begin(), row.cells.end(), is_value);
      if (values == 0) {
        if (known_.count(row) >= 2) header = &row;
        last_text = &row;
        continue;
      }
      if (values < 2 && row.cells.size() > 1) continue;
      const std::string what =
          last_text ? fmt::format("the line above them has \"{}\"", marker_name(*last_text).substr(0, 80))
                    : "no line is above them";
      refuse(file_, row.line,
             fmt::format("numbers without a heading of a known quantity above them ({}): write a header such "
                         "as \"force [N]\", or give the columns (known quantities: {})",
                         what, quantity_names()));
    }
    const std::string needed =
        "; a table needs a header such as \"time [s],force [N]\", and rows of numbers below it";
    if (header) refuse(file_, header->line, "a header, but no measurements below it" + needed);
    if (last_text)
      refuse(file_, last_text->line,
             "no measurements: the file has text, but no header with numbers below it" + needed);
    refuse(file_, 0, "empty: no header, no measurements" + needed);
  }

  const std::vector<Row>& rows_;
  KnownHeadings& known_;
  const Format& format_;
  const std::filesystem::path& file_;
  Layout layout_;
  bool with_specimens_ = false;
};

}  // namespace

void refuse(const std::filesystem::path& file, int line, const std::string& reason) {
  throw Error(ExitCode::bad_data, line > 0 ? fmt::format("{}:{}: {}", file.string(), line, reason)
                                           : fmt::format("{}: {}", file.string(), reason));
}

bool is_value(const std::string& cell) {
  if (cell.empty() || cell.size() > 64) return false;
  const char first = cell.front();
  const bool possible = (first >= '0' && first <= '9') ||
                        std::string_view("+-.,").find(first) != std::string_view::npos ||
                        static_cast<unsigned char>(first) >= 0x80;
  return possible && (form_of(cell) != NumberForm::not_a_number || clock_of(cell));
}

bool is_marker(const Row& row) {
  constexpr const char* others[] = {"test", "run", "versuch", "essai", "prova", "ensayo", "proef"};
  if (row.cells.empty() || !is_text(row.cells.front()) || row.cells.front().size() > 80) return false;
  std::size_t filled = 0;
  for (const std::string& cell : row.cells) filled += !cell.empty();
  const std::string name = words_of(row.cells.front());
  const std::string first = name.substr(0, name.find_first_of(" 0123456789"));
  const std::vector<Quantity> meanings = read_heading(row.cells.front()).meanings;
  const bool only_specimen = std::all_of(meanings.begin(), meanings.end(),
                                         [](Quantity meaning) { return meaning == Quantity::specimen; });
  const bool known = read_heading(first).meanings == std::vector{Quantity::specimen} ||
                     std::find(std::begin(others), std::end(others), first) != std::end(others);
  const bool numbered = filled == 2 || name.find_first_of("0123456789") != std::string::npos ||
                        name.find(' ') != std::string::npos;
  return known && only_specimen && filled <= 2 && numbered && std::count(name.begin(), name.end(), ' ') <= 2;
}

Layout find_layout(const std::vector<Row>& rows, KnownHeadings& known, const std::filesystem::path& file) {
  return Reader(rows, known, file).read();
}

}  // namespace ripstop::table
