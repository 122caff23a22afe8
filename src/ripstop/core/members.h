// One list of the members of a struct, used by all code that shows, writes or reads them:
// tables, result.json, checkpoints, the line on a terminal.
//
//     template <Of<HistoryRow> T, class Visit>
//     void each_member(T& row, Visit&& visit) {
//       visit("time_s", row.time);
//     }
//
// The name ends with the unit and must not change, because files are read by it. Further arguments of a member state
// where else it is shown, or how.
#pragma once

#include <concepts>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace ripstop {

/// `Struct` itself or a constant one: one list serves writing and reading.
template <class T, class Struct>
concept Of = std::same_as<std::remove_const_t<T>, Struct>;

/// Accepts any member: tests whether there is a list. A lambda in a concept is not supported by clang 14.
struct AnyMember {
  template <class... Any>
  void operator()(const char*, Any&&...) const {}
};

/// A struct with a list.
template <class T>
concept Listed = requires(T& value) {
  each_member(value, AnyMember{});
};

/// Also a column of the table that has a row a result.
struct InTable {};
inline constexpr InTable in_table;

/// An optional that is written as null where it is absent; others are left out.
struct OrNull {};
inline constexpr OrNull or_null;

/// Also in the line on a terminal.
struct Shown {
  const char* heading;  // "upper|lower" of two lines
  int width;            // without the blank before it
  const char* format;   // of one number; empty: minutes and seconds
  double factor = 1;    // of the number
};

/// An absent number is not-a-number.
inline double as_number(double value) {
  return value;
}
inline double as_number(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

/// A member that can be a column of a table.
template <class Member>
concept NumberMember = requires(const Member& member) {
  as_number(member);
};

/// The numbers of a list as the columns of a table, without its other members.
template <Listed T>
std::vector<std::string> columns_of() {
  std::vector<std::string> names;
  T value;
  each_member(value, [&]<class Member>(const char* name, const Member&, auto&&...) {
    if constexpr (NumberMember<Member>) names.emplace_back(name);
  });
  return names;
}
template <Listed T>
std::vector<double> row_of(const T& value) {
  std::vector<double> row;
  each_member(value, [&]<class Member>(const char*, const Member& member, auto&&...) {
    if constexpr (NumberMember<Member>) row.push_back(as_number(member));
  });
  return row;
}
/// `row` as long as columns_of<T>().
template <Listed T>
T from_row(const std::vector<double>& row) {
  T value;
  std::size_t i = 0;
  each_member(value, [&](const char*, auto& member, auto&&...) {
    member = static_cast<std::remove_reference_t<decltype(member)>>(row.at(i++));
  });
  return value;
}

}  // namespace ripstop
