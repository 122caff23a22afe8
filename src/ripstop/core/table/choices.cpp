// --columns and --decimal.
#include <fmt/format.h>

#include <algorithm>

#include "ripstop/core/error.h"
#include "ripstop/core/table/table.h"
#include "ripstop/core/table/text.h"

namespace ripstop::table {
namespace {

/// Where "force=" and the like begin: only these part the text, since headings may have commas.
std::vector<std::size_t> beginnings(const std::string& text) {
  std::vector<std::size_t> found;
  for (std::size_t at = text.find('='); at != std::string::npos; at = text.find('=', at + 1)) {
    std::size_t from = at == 0 ? std::string::npos : text.rfind(',', at - 1);
    from = from == std::string::npos ? 0 : from + 1;
    if (!found.empty() && from <= found.back()) continue;
    if (found.empty() ? from == 0 : quantity_named(trimmed(text.substr(from, at - from))).has_value())
      found.push_back(from);
  }
  return found;
}

[[noreturn]] void refuse_choice(const std::string& part) {
  throw Error(
      ExitCode::usage,
      fmt::format("\"{}\" is not a column: write QUANTITY=HEADING or QUANTITY=HEADING [UNIT], separated by "
                  "commas, for example \"force=Kraft [kN],extension=Weg [mm]\"; quantities: {}",
                  part, quantity_names()));
}

}  // namespace

std::vector<ColumnChoice> parse_columns(const std::string& text) {
  std::vector<ColumnChoice> choices;
  if (trimmed(text).empty()) return choices;
  std::vector<std::size_t> begins = beginnings(text);
  if (begins.empty()) refuse_choice(text);
  begins.push_back(text.size() + 1);
  for (std::size_t i = 0; i + 1 < begins.size(); ++i) {
    const std::string part = text.substr(begins[i], begins[i + 1] - 1 - begins[i]);
    const std::size_t equals = part.find('=');
    const std::optional<Quantity> quantity = quantity_named(trimmed(part.substr(0, equals)));
    ColumnChoice choice{quantity.value_or(Quantity::other), trimmed(part.substr(equals + 1)), ""};
    if (!quantity || choice.heading.empty()) refuse_choice(part);
    const std::size_t open = choice.heading.rfind('[');
    if (choice.heading.back() == ']' && open != std::string::npos) {
      choice.unit = trimmed(choice.heading.substr(open + 1, choice.heading.size() - open - 2));
      choice.heading = trimmed(choice.heading.substr(0, open));
    }
    if (choice.heading.empty()) refuse_choice(part);
    choices.push_back(choice);
  }
  return choices;
}

Decimal parse_decimal(const std::string& text) {
  if (text.empty() || text == "auto") return Decimal::automatic;
  if (text == "point") return Decimal::point;
  if (text == "comma") return Decimal::comma;
  throw Error(ExitCode::usage, fmt::format("the decimal mark \"{}\" must be point, comma or auto", text));
}

}  // namespace ripstop::table
