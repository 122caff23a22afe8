// Headings, units and specimens side by side.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "ripstop/core/table/layout.h"
#include "ripstop/core/table/text.h"

namespace ripstop::table {
namespace {

using Q = Quantity;
constexpr std::size_t most_rows_to_numbers = 8;  // below a header

/// Agreement of a heading with the one that the user gave: 3 as written, 2 without its unit, 1 without the
/// text in parentheses, 0 none.
int closeness(const Heading& heading, const std::string& named) {
  const std::string wanted = words_of(named);
  if (wanted.empty()) return trimmed(named) == heading.text && !heading.text.empty() ? 3 : 0;
  if (trimmed(named) == heading.text || wanted == words_of(heading.text)) return 3;
  if (wanted == words_of(heading.name)) return 2;
  return wanted == words_of(heading.name.substr(0, heading.name.find_first_of("([{"))) ? 1 : 0;
}

/// Of a line of numbers that a wrong separator leaves whole, read thousands of times.
bool has_letters(const std::string& cell) {
  return std::any_of(cell.begin(), cell.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
  });
}

/// Of the user's choices: the column of each heading that was named.
std::map<std::size_t, const ColumnChoice*> named_columns(const std::vector<Heading>& headings, int line,
                                                         const Format& format,
                                                         const std::filesystem::path& file) {
  std::map<std::size_t, const ColumnChoice*> named;
  for (const ColumnChoice& choice : format.columns) {
    if (choice.heading.empty()) continue;
    int closest = 0;
    std::set<std::string> texts, all;
    for (const Heading& heading : headings) {
      const int close = closeness(heading, choice.heading);
      if (close > closest) texts.clear();
      closest = std::max(closest, close);
      if (close > 0 && close == closest) texts.insert(heading.text);
      if (!heading.text.empty()) all.insert('"' + heading.text + '"');
    }
    if (texts.empty())
      refuse(file, line,
             fmt::format("no column \"{}\", which is given for the {}; the headings are {}", choice.heading,
                         name_of(choice.quantity), fmt::join(all, ", ")));
    if (texts.size() > 1)
      refuse(file, line,
             fmt::format(
                 "several columns match \"{}\", which is given for the {}: \"{}\"; write one of them in full",
                 choice.heading, name_of(choice.quantity), fmt::join(texts, "\", \"")));
    for (std::size_t i = 0; i < headings.size(); ++i)
      if (headings[i].text == *texts.begin()) named[i] = &choice;
  }
  return named;
}

/// Consequence of a user's choice of a quantity: an extension in % is a strain.
std::vector<Quantity> meanings_of(Quantity quantity) {
  if (quantity == Q::extension) return {Q::extension, Q::strain};
  return {quantity};
}

struct Resolver {
  const Format& format;
  const std::filesystem::path& file;
  const std::map<std::size_t, const ColumnChoice*>& named;
  int header_line, unit_line;

  /// Meanings that stay when the user has named other columns for some quantities.
  std::vector<Quantity> left_over(const std::vector<Quantity>& meanings) const {
    std::vector<Quantity> left;
    for (const Quantity meaning : meanings) {
      const bool taken = std::any_of(named.begin(), named.end(), [&](const auto& entry) {
        const std::vector<Quantity> covered = meanings_of(entry.second->quantity);
        return std::find(covered.begin(), covered.end(), meaning) != covered.end();
      });
      if (!taken) left.push_back(meaning);
    }
    return left;
  }

  const ColumnChoice* choice_for(std::size_t index, const std::vector<Quantity>& meanings) const {
    if (const auto found = named.find(index); found != named.end()) return found->second;
    for (const ColumnChoice& choice : format.columns) {
      if (!choice.heading.empty()) continue;
      for (const Quantity covered : meanings_of(choice.quantity))
        if (std::find(meanings.begin(), meanings.end(), covered) != meanings.end()) return &choice;
    }
    return nullptr;
  }

  static bool same_unit(const Heading& heading, const std::string& a, const std::string& b) {
    const Quantity qa = meaning_in(heading, a), qb = meaning_in(heading, b);
    if (qa != qb) return false;
    if (qa == Q::other) return a == b;
    const std::optional<double> fa = unit_factor(dimension_of(qa), a), fb = unit_factor(dimension_of(qb), b);
    return fa == fb;
  }

  /// A column; `other` if its heading names no wanted quantity.
  Column resolve(std::size_t index, Heading heading, const std::string& unit_below) const {
    Column column;
    column.heading = heading.text;
    column.place = static_cast<int>(index) + 1;
    const bool by_name = named.contains(index);
    heading.meanings = by_name ? meanings_of(named.at(index)->quantity) : left_over(heading.meanings);
    if (heading.meanings.empty()) return column;
    const ColumnChoice* choice = choice_for(index, heading.meanings);
    const std::string given = choice ? choice->unit : "";
    std::string unit = given;
    int line = header_line;
    const auto take = [&](const std::string& other, int at, const char* who) {
      if (other.empty()) return;
      if (unit.empty()) {
        unit = other;
        line = at;
      } else if (column.problem.empty() && !same_unit(heading, unit, other)) {
        column.problem =
            message(at, fmt::format("mixed units: {} has \"{}\" for the column \"{}\", and {} \"{}\"; "
                                    "correct one of them",
                                    who, other, heading.text,
                                    unit == given ? "the user's choice" : "the header", unit));
      }
    };
    take(heading.unit, header_line, "the header");
    take(heading.other_unit, header_line, "the header");
    take(unit_below, unit_line, "the row of units");
    if (unit.empty() && !heading.odd.empty() && read_heading(heading.odd).meanings.empty())
      unit = heading.odd;
    column.quantity = meaning_in(heading, unit);
    column.unit = unit;
    if (column.quantity == Q::other) settle(column, heading, line, by_name);
    if (!wanted(column.quantity)) column.quantity = Q::other;
    if (column.quantity != Q::other && column.quantity != Q::specimen && column.problem.empty())
      if (const std::optional<Unit> known = find_unit(dimension_of(column.quantity), unit))
        column.unit = known->name;
    return column;
  }

  /// The unit fits no meaning, or there is none.
  void settle(Column& column, const Heading& heading, int line, bool by_name) const {
    const auto has = [&](Quantity quantity) {
      return std::find(heading.meanings.begin(), heading.meanings.end(), quantity) != heading.meanings.end();
    };
    const Quantity first = heading.meanings.front();
    if (column.unit.empty() && (has(Q::time) || has(Q::specimen))) {
      column.quantity = has(Q::time) ? Q::time : Q::specimen;
      if (column.quantity == Q::time) column.unit = "s";
      return;
    }
    if (!by_name && (heading.weak || is_foreign_unit(column.unit) || first == Q::specimen)) return;
    column.quantity = first;
    if (!column.problem.empty()) return;
    const std::string known = known_units(dimension_of(first));
    if (column.unit.empty())
      column.problem =
          message(line, fmt::format("no unit for the column \"{}\" ({}): write it in the heading, for "
                                    "example \"{} [{}]\", or give it with the name of the column (known: {})",
                                    heading.text, name_of(first), name_of(first),
                                    known.substr(0, known.find(',')), known));
    else
      column.problem =
          message(line, fmt::format("\"{}\" in the heading \"{}\" is not a unit for {}; known: {}",
                                    column.unit, heading.text, name_of(first), known));
  }

  std::string message(int line, const std::string& reason) const {
    return fmt::format("{}:{}: {}", file.string(), line, reason);
  }

  bool wanted(Quantity quantity) const {
    return format.wanted.empty() || quantity == Q::specimen ||
           std::find(format.wanted.begin(), format.wanted.end(), quantity) != format.wanted.end();
  }
};

/// A row of units below the header: a known unit below a known heading, and mostly units.
bool is_unit_row(const Row& row, const std::vector<Heading>& headings) {
  std::size_t units = 0, others = 0;
  bool below_known = false;
  for (std::size_t i = 0; i < std::min(row.cells.size(), headings.size()); ++i) {
    if (row.cells[i].empty()) continue;
    const std::string unit = bare_unit(row.cells[i]);
    const bool known = is_unit(unit) || clock_form(unit) != ClockForm::none;
    ++(known ? units : others);
    below_known = below_known || (known && !headings[i].meanings.empty());
  }
  return below_known && units >= others;
}

/// The heading without numbers, and its unit: "Force 1 (N)" and "Force 2 (N)" are alike.
std::string without_numbers(const Column& column) {
  std::string key;
  for (const char c : words_of(column.heading))
    if (c < '0' || c > '9') key += c;
  std::erase(key, ' ');
  return key + '\n' + column.unit + '\n' + name_of(column.quantity);
}

/// Specimens side by side: at least two headings repeat, all of them equally often.
void set_side_by_side(Block& block, const Row* above) {
  std::map<std::string, std::vector<std::size_t>> alike;
  for (std::size_t i = 0; i < block.columns.size(); ++i)
    alike[without_numbers(block.columns[i])].push_back(i);
  block.specimen_of.assign(block.columns.size(), -1);
  std::size_t specimens = 1, repeated = 0;
  std::set<Quantity> quantities;
  for (const auto& [key, columns] : alike) specimens = std::max(specimens, columns.size());
  for (const auto& [key, columns] : alike) {
    if (columns.size() != 1 && columns.size() != specimens) return;
    if (columns.size() != specimens) continue;
    ++repeated;
    quantities.insert(block.columns[columns.front()].quantity);
  }
  if (specimens < 2 || repeated < 2 || quantities.size() < 2) return;
  std::vector<std::size_t> first_place(specimens, block.width);
  for (const auto& [key, columns] : alike)
    for (std::size_t k = 0; columns.size() == specimens && k < specimens; ++k) {
      block.specimen_of[columns[k]] = static_cast<int>(k);
      first_place[k] =
          std::min(first_place[k], static_cast<std::size_t>(block.columns[columns[k]].place - 1));
    }
  for (std::size_t k = 0; k < specimens; ++k) {
    block.side_names.push_back(std::to_string(k + 1));
    if (above && first_place[k] < above->cells.size() && !above->cells[first_place[k]].empty())
      block.side_names.back() = above->cells[first_place[k]];
  }
}

}  // namespace

KnownHeadings::KnownHeadings(const Format& format) : format_(format) {
  for (const ColumnChoice& choice : format.columns)
    if (!choice.heading.empty()) named_.push_back(words_of(choice.heading));
}

bool KnownHeadings::read(const std::string& cell) const {
  const std::string words = words_of(cell);
  const bool may_be_named = std::any_of(named_.begin(), named_.end(), [&](std::string_view named) {
    return named.empty() || words.find(named.substr(0, named.find(' '))) != std::string::npos;
  });
  if (!may_be_named && !may_have_meaning(words)) return false;
  const Heading heading = read_heading(cell);
  for (const Quantity meaning : heading.meanings)
    if (meaning != Q::specimen) return true;
  return std::any_of(format_.columns.begin(), format_.columns.end(), [&](const ColumnChoice& choice) {
    return !choice.heading.empty() && closeness(heading, choice.heading) > 0;
  });
}

bool KnownHeadings::contains(const std::string& cell) {
  constexpr std::size_t most_cells = 10000;
  if (named_.empty() && !has_letters(cell)) return false;
  if (const auto found = cells_.find(cell); found != cells_.end()) return found->second;
  const bool known = read(cell);
  if (cells_.size() < most_cells) cells_.emplace(cell, known);
  return known;
}

std::vector<std::size_t> KnownHeadings::places(const Row& row) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < row.cells.size(); ++i)
    if (!row.cells[i].empty() && contains(row.cells[i])) places.push_back(i);
  return places;
}

std::size_t KnownHeadings::count(const Row& row) {
  const bool values = std::any_of(row.cells.begin(), row.cells.end(), is_value);
  return values ? 0 : places(row).size();
}

bool find_header(const std::vector<Row>& rows, std::size_t from, KnownHeadings& known,
                 const HeaderSearch& search, Header& found) {
  std::vector<std::size_t> places;
  std::size_t below = 0;
  for (std::size_t r = from; r < rows.size(); ++r) {
    const Row& row = rows[r];
    if ((row.comment && !search.comments) || row.blank()) continue;
    if (const std::size_t count = known.count(row); count >= search.fewest) {
      places = known.places(row);
      below = 0;
      found = {r, 0, count, false};
      continue;
    }
    if (places.empty() || row.comment) continue;
    const bool values = std::any_of(places.begin(), places.end(), [&](std::size_t i) {
      return i < row.cells.size() && is_value(row.cells[i]);
    });
    if (values) {
      found.data = r;
      found.consistent = row.cells.size() <= rows[found.header].written && row.written > places.back();
      return true;
    }
    if (++below > most_rows_to_numbers) places.clear();
  }
  return false;
}

Block make_block(const std::vector<Row>& rows, const Header& header, const Format& format,
                 const std::filesystem::path& file, std::vector<std::string>& notes) {
  const Row& row = rows[header.header];
  std::vector<Heading> headings;
  for (const std::string& cell : row.cells) headings.push_back(read_heading(cell));
  const Row* units = nullptr;
  for (std::size_t r = header.header + 1; r < header.data; ++r) {
    if (rows[r].blank() || rows[r].comment) continue;
    if (!units && is_unit_row(rows[r], headings))
      units = &rows[r];
    else if (!is_marker(rows[r]))
      notes.push_back(fmt::format("line {} between the header and the numbers is ignored", rows[r].line));
  }
  Block block;
  block.header_line = row.line;
  block.width = row.written;
  const std::map<std::size_t, const ColumnChoice*> named = named_columns(headings, row.line, format, file);
  const Resolver resolver{format, file, named, row.line, units ? units->line : row.line};
  for (std::size_t i = 0; i < headings.size(); ++i) {
    const bool below = units && i < units->cells.size();
    Column column = resolver.resolve(i, headings[i], below ? bare_unit(units->cells[i]) : "");
    if (column.quantity != Q::other) block.columns.push_back(std::move(column));
  }
  const Row* above = nullptr;
  for (std::size_t r = header.header; r-- > 0 && !above;)
    if (!rows[r].blank()) above = &rows[r];
  set_side_by_side(block, above);
  return block;
}

}  // namespace ripstop::table
