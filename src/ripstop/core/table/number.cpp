#include "ripstop/core/table/number.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <vector>

#include "ripstop/core/table/text.h"

namespace ripstop::table {
namespace {

constexpr bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Of the digits of a number: decimal marks, and marks of groups.
constexpr bool is_mark(char c) {
  return c == '.' || c == ',' || c == '\'' || c == ' ';
}

bool only_digits(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return is_digit(c); });
}

/// Parts of a number; apostrophes of all kinds are '\'', blanks ' '.
struct Written {
  bool negative = false;
  std::string_view mantissa;  // digits, '.', ',', '\'', ' '
  std::string_view exponent;  // "E+02"
};

enum class Spelling { plain, unusual, not_a_number };

/// Most cells are plain and need no copy. Unusual: other blanks, apostrophes or minus signs.
Spelling spelling_of(std::string_view text) {
  bool unusual = false;
  for (const char c : text) {
    if (is_digit(c) || is_mark(c) || c == '-' || c == '+' || c == 'e' || c == 'E') continue;
    if (static_cast<unsigned char>(c) < 0x80 && c != '`' && !(c >= '\t' && c <= '\r'))
      return Spelling::not_a_number;
    unusual = true;
  }
  return unusual ? Spelling::unusual : Spelling::plain;
}

/// The number with the usual characters.
std::string respelled(std::string_view text) {
  std::string plain = folded(text);
  for (const std::string_view quote : {"\u2019", "\u02bc", "\u00b4", "`"})
    for (std::size_t at = 0; (at = plain.find(quote)) != std::string::npos;)
      plain.replace(at, quote.size(), "'");
  if (plain.starts_with("\u2212") || plain.starts_with("\u2013")) plain.replace(0, 3, "-");
  return plain;
}

/// The parts are those of `text` or of `copy`.
std::optional<Written> written(std::string_view text, std::string& copy) {
  const Spelling spelling = spelling_of(text);
  if (spelling == Spelling::not_a_number || text.empty()) return {};
  if (spelling == Spelling::unusual) copy = respelled(text);
  Written number;
  std::string_view rest = spelling == Spelling::unusual ? copy : text;
  if (rest.starts_with('-') || rest.starts_with('+')) {
    number.negative = rest.front() == '-';
    rest.remove_prefix(1);
    if (rest.starts_with(' ')) rest.remove_prefix(1);
  }
  const auto end = std::find_if(rest.begin(), rest.end(), [](char c) { return c == 'e' || c == 'E'; });
  number.mantissa = {rest.begin(), end};
  number.exponent = {end, rest.end()};
  if (!std::all_of(rest.begin(), end, [](char c) { return is_digit(c) || is_mark(c); })) return {};
  if (number.mantissa.empty() || !is_digit(number.mantissa.back()))
    if (number.mantissa.size() < 2 || !is_digit(number.mantissa[number.mantissa.size() - 2])) return {};
  if (number.mantissa.front() == ' ' || number.mantissa.front() == '\'') return {};
  if (number.exponent.empty()) return number;
  std::string_view digits = number.exponent.substr(1);
  if (digits.starts_with('-') || digits.starts_with('+')) digits.remove_prefix(1);
  const bool whole = !digits.empty() && digits.size() < 6 && only_digits(digits);
  return whole ? std::optional(number) : std::nullopt;
}

/// "1.234.567" with '.': one to three digits, the first not 0, then groups of three.
bool grouped(std::string_view digits, char mark) {
  if (digits.empty() || digits.front() == '0') return false;
  std::size_t run = 0;
  bool first = true;
  for (const char c : digits) {
    if (c != mark) {
      if (!is_digit(c)) return false;
      ++run;
      continue;
    }
    if (first ? run < 1 || run > 3 : run != 3) return false;
    first = false;
    run = 0;
  }
  return !first && run == 3;
}

/// Digits before the decimal mark, plain or in groups by one kind of mark.
bool whole_part(std::string_view text, char decimal) {
  if (only_digits(text)) return true;
  for (const char mark : {'.', ',', '\'', ' '})
    if (mark != decimal && grouped(text, mark)) return true;
  return false;
}

/// "1,016.5" with '.'; nothing about which of both marks is meant.
bool fits(std::string_view mantissa, char decimal) {
  const std::size_t at = mantissa.find(decimal);
  if (at == std::string_view::npos) return whole_part(mantissa, decimal);
  return whole_part(mantissa.substr(0, at), decimal) && only_digits(mantissa.substr(at + 1));
}

std::optional<int> integer(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !only_digits(text)) return {};
  return value;
}

std::vector<std::string_view> parts_of(std::string_view text, char mark) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(mark);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// "2026-05-03", "03.05.2026", "3/5/2026"; false: no date.
bool read_date(std::string_view text, ClockTime& time) {
  for (const char mark : {'-', '.', '/'}) {
    const std::vector<std::string_view> parts = parts_of(text, mark);
    if (parts.size() != 3) continue;
    const std::optional<int> a = integer(parts[0]), b = integer(parts[1]), c = integer(parts[2]);
    if (!a || !b || !c) return false;
    const bool year_first = parts[0].size() == 4, day_first = !year_first && mark == '.';
    if (!year_first && !day_first) {
      time.other_date = text;
      return true;
    }
    const int year = year_first ? *a : parts[2].size() == 2 ? 2000 + *c : *c, day = year_first ? *c : *a;
    if (year < 1900 || year > 2999 || *b > 12 || day > 31) return false;
    const std::chrono::year_month_day date{std::chrono::year(year),
                                           std::chrono::month(static_cast<unsigned>(*b)),
                                           std::chrono::day(static_cast<unsigned>(day))};
    if (!date.ok()) return false;
    time.has_day = true;
    time.day = static_cast<int>(std::chrono::sys_days(date).time_since_epoch().count());
    return true;
  }
  return false;
}

/// Takes "am" or "pm" off the end; hours to add for the hour that is written.
std::optional<int> afternoon(std::string_view& text) {
  for (const std::string_view word : {"am", "a.m.", "pm", "p.m."}) {
    if (!text.ends_with(word)) continue;
    text.remove_suffix(word.size());
    while (text.ends_with(' ')) text.remove_suffix(1);
    return word.front() == 'p' ? 12 : 0;
  }
  return {};
}

/// Takes an offset from UTC, such as +02:00, off the end [s]; 0: there is none. Nothing: it is not an offset.
std::optional<int> zone_of(std::string_view& text) {
  const std::size_t at = text.find_first_of("+-");
  if (at == std::string_view::npos) return 0;
  std::string digits(text.substr(at + 1));
  if (digits.size() == 5 && digits[2] == ':') digits.erase(2, 1);
  if (digits.size() == 2) digits += "00";
  const std::string_view both = digits;
  if (both.size() != 4 || !only_digits(both)) return {};
  const int hours = integer(both.substr(0, 2)).value_or(99), minutes = integer(both.substr(2)).value_or(99);
  if (hours > 14 || minutes > 59) return {};
  const int seconds = 3600 * hours + 60 * minutes, sign = text[at] == '-' ? -1 : 1;
  text = text.substr(0, at);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return sign * seconds;
}

}  // namespace

NumberForm form_of(std::string_view text) {
  std::string copy;
  const std::optional<Written> number = written(text, copy);
  if (!number) return NumberForm::not_a_number;
  const std::string_view m = number->mantissa;
  const std::size_t point = m.rfind('.'), comma = m.rfind(',');
  constexpr std::size_t none = std::string_view::npos;
  if (point == none && comma == none) {
    if (!whole_part(m, '.')) return NumberForm::wrong_groups;
    return m.size() <= 3 && number->exponent.empty() ? NumberForm::small_integer : NumberForm::integer;
  }
  const bool as_point = fits(m, '.'), as_comma = fits(m, ',');
  if (!as_point && !as_comma) return NumberForm::wrong_groups;
  // "1.5E3": an exponent follows a decimal mark, and no group.
  if (as_point && as_comma && number->exponent.empty())
    return point != none ? NumberForm::point_or_group : NumberForm::comma_or_group;
  if (as_point && as_comma) return point != none ? NumberForm::point_decimal : NumberForm::comma_decimal;
  return as_point ? NumberForm::point_decimal : NumberForm::comma_decimal;
}

std::optional<double> number_of(std::string_view text, char decimal) {
  std::string copy;
  const std::optional<Written> number = written(text, copy);
  if (!number || !fits(number->mantissa, decimal)) return {};
  std::string plain = number->negative ? "-" : "";
  for (const char c : number->mantissa)
    if (is_digit(c) || c == decimal) plain += c == decimal ? '.' : c;
  plain += number->exponent;
  double value = 0;
  const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
  if (error != std::errc() || end != plain.data() + plain.size() || !std::isfinite(value)) return {};
  return value;
}

std::optional<ClockTime> clock_of(std::string_view text) {
  if (text.find(':') == std::string_view::npos || text.size() > 64) return {};
  const std::string plain = folded(text);
  std::string_view rest = plain;
  ClockTime time;
  if (const std::size_t at = rest.find_first_of(" t"); at != std::string_view::npos && rest.find(':') > at) {
    if (!read_date(rest.substr(0, at), time)) return {};
    rest.remove_prefix(at + 1);
  }
  while (rest.starts_with(' ')) rest.remove_prefix(1);
  if (rest.ends_with('z')) rest.remove_suffix(1);
  const std::optional<int> zone = time.has_day ? zone_of(rest) : 0;
  if (!zone) return {};
  const std::optional<int> half = afternoon(rest);
  const std::vector<std::string_view> parts = parts_of(rest, ':');
  if (parts.size() < 2 || parts.size() > 3) return {};
  time.parts = static_cast<int>(parts.size());
  std::string last(parts.back());
  const std::size_t mark = last.find_first_of(".,");
  time.has_fraction = mark != std::string::npos;
  if (time.has_fraction) last[mark] = '.';
  const std::string_view whole = std::string_view(last).substr(0, mark);
  if (whole.empty() || whole.size() > 2 || !only_digits(whole)) return {};
  double value = 0;
  const auto [end, error] = std::from_chars(last.data(), last.data() + last.size(), value);
  if (error != std::errc() || end != last.data() + last.size() || !(value < 60)) return {};
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    std::optional<int> part = integer(parts[i]);
    if (!part || parts[i].size() > 4 || (i > 0 && *part >= 60)) return {};
    if (i == 0 && half) {
      if (*part < 1 || *part > 12) return {};
      part = *part % 12 + *half;
    }
    value += *part * (parts.size() == 3 && i == 0 ? 3600 : 60);
  }
  time.seconds = value - *zone;
  return time;
}

}  // namespace ripstop::table
