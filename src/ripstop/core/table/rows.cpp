#include "ripstop/core/table/rows.h"

#include <fmt/format.h>

#include <algorithm>

#include "ripstop/core/error.h"
#include "ripstop/core/table/text.h"

namespace ripstop::table {
namespace {

constexpr int most_lines_in_quotes = 8;

class Splitter {
 public:
  Splitter(std::string_view text, char separator, const std::filesystem::path& file)
      : text_(text), separator_(separator), file_(file) {}

  std::vector<Row> rows() {
    std::vector<Row> all;
    while (at_ < text_.size()) all.push_back(row());
    return all;
  }

 private:
  bool at_end_of_line() const { return at_ >= text_.size() || text_[at_] == '\n'; }
  static bool is_blank(char c) { return c == ' ' || c == '\t'; }

  /// Length of the separator here; 0: none.
  std::size_t separator_here() const {
    if (separator_ != blanks && separator_ != wide_blanks) return text_[at_] == separator_ ? 1 : 0;
    std::size_t end = at_;
    while (end < text_.size() && is_blank(text_[end])) ++end;
    const bool enough = end - at_ >= (separator_ == blanks ? 1u : 2u) || (end > at_ && text_[at_] == '\t');
    return enough ? end - at_ : 0;
  }

  /// "#VALUE!", "#N/A" at the start of a row are cells, and no comment.
  bool error_of_spreadsheet() const {
    std::size_t end = at_ + 1;
    while (end < text_.size() && ((text_[end] >= 'A' && text_[end] <= 'Z') || text_[end] == '/' ||
                                  (text_[end] >= '0' && text_[end] <= '9')))
      ++end;
    const std::string_view word = text_.substr(at_, end - at_);
    const bool marked = end < text_.size() && (text_[end] == '!' || text_[end] == '?') && word.size() > 2;
    return marked || word == "#N/A" || word == "#NV";
  }

  void skip_blanks() {
    while (!at_end_of_line() && is_blank(text_[at_]) && text_[at_] != separator_) ++at_;
  }

  Row row() {
    Row row;
    row.line = line_;
    if (separator_ == blanks || separator_ == wide_blanks)
      while (!at_end_of_line() && is_blank(text_[at_])) ++at_;
    else
      skip_blanks();
    if (!at_end_of_line() && text_[at_] == '#' && !error_of_spreadsheet()) {
      row.comment = true;
      ++at_;
      row.text = trimmed(text_.substr(at_, std::min(text_.find('\n', at_), text_.size()) - at_));
    }
    for (;;) {
      row.cells.push_back(cell(row.comment));
      if (at_end_of_line()) break;
      at_ += separator_here();
    }
    if (at_ < text_.size()) ++at_, ++line_;
    if (separator_ == blanks) join_brackets(row.cells);
    row.written = row.cells.size();
    while (!row.cells.empty() && row.cells.back().empty()) row.cells.pop_back();
    return row;
  }

  /// "Force", "(N)" -> "Force (N)"
  static void join_brackets(std::vector<std::string>& cells) {
    std::vector<std::string> joined;
    for (std::string& cell : cells) {
      const bool follows = !joined.empty() && !joined.back().empty() && !cell.empty() &&
                           std::string_view("([{").find(cell.front()) != std::string_view::npos &&
                           std::string_view(")]}").find(cell.back()) != std::string_view::npos &&
                           std::string_view(")]}").find(joined.back().back()) == std::string_view::npos;
      if (follows)
        joined.back() += " " + cell;
      else
        joined.push_back(std::move(cell));
    }
    cells = std::move(joined);
  }

  std::string cell(bool comment) {
    skip_blanks();
    const bool in_quotes = !comment && !at_end_of_line() && text_[at_] == '"';
    std::string value = in_quotes ? quoted() : "";
    const std::size_t begin = at_;
    if (separator_ == blanks || separator_ == wide_blanks)
      while (!at_end_of_line() && separator_here() == 0) ++at_;
    else
      while (!at_end_of_line() && text_[at_] != separator_) ++at_;
    const std::string_view rest = text_.substr(begin, at_ - begin);
    value = in_quotes ? trimmed(value.append(rest)) : trimmed(rest);
    if (value.size() >= 2 && value.front() == '\'' && value.back() == '\'')
      value = trimmed(std::string_view(value).substr(1, value.size() - 2));
    return value;
  }

  std::string quoted() {
    const int opened = line_;
    std::string value;
    for (++at_; at_ < text_.size() && line_ - opened <= most_lines_in_quotes; ++at_) {
      const char c = text_[at_];
      if (c == '"' && (at_ + 1 >= text_.size() || text_[at_ + 1] != '"')) {
        ++at_;
        return value;
      }
      if (c == '"') ++at_;
      if (c == '\n') ++line_;
      value += c == '\n' ? ' ' : c;
    }
    throw Error(
        ExitCode::bad_data,
        fmt::format("{}:{}: this quotation mark is not closed: add the closing one, or remove this one",
                    file_.string(), opened));
  }

  std::string_view text_;
  char separator_;
  const std::filesystem::path& file_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace

bool Row::blank() const {
  return std::all_of(cells.begin(), cells.end(), [](const std::string& cell) { return cell.empty(); });
}

std::vector<Row> split_rows(std::string_view text, char separator, const std::filesystem::path& file) {
  return Splitter(text, separator, file).rows();
}

std::string name_of_separator(char separator) {
  switch (separator) {
    case '\t':
      return "tab";
    case ';':
      return "semicolon";
    case '|':
      return "vertical bar";
    case ',':
      return "comma";
    default:
      return "blanks";
  }
}

}  // namespace ripstop::table
