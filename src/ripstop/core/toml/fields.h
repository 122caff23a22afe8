// One description for each TOML table; reading, checking, schema, resolved output and reference follow it.
//
// A table's struct comes with `void describe(Fields&, T&)`, which names every key once, bound to its member:
//
//     void describe(Fields& fields, Riser& riser) {
//       fields.number("length_m", riser.length_m, from(0).up_to(100), "fixed point to confluence");
//     }
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "ripstop/core/vec3.h"

namespace ripstop {

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;   // low itself is not allowed
  bool high_open = false;  // high itself is not allowed

  Range up_to(double limit) const { return {low, limit, low_open, false}; }
  Range below(double limit) const { return {low, limit, low_open, true}; }
  bool contains(double value) const;  // false for NaN
  std::string text() const;           // "above 0 and at most 200"
};
inline Range from(double low) {
  return {low, std::numeric_limits<double>::infinity(), false, false};
}
inline Range above(double low) {
  return {low, std::numeric_limits<double>::infinity(), true, false};
}

class Fields;

/// T of an optional<T>, else the type itself.
template <class T>
struct Held {
  using type = T;
};
template <class T>
struct Held<std::optional<T>> {
  using type = T;
};

/// One word of a list; get() and set() go through the position in `words`.
struct Choice {
  std::vector<std::string> words;
  std::function<std::optional<std::size_t>()> get;  // nothing: not given
  std::function<void(std::size_t)> set;
};

/// Text without control characters; a name has letters, digits, '.', '_', '-' only.
struct Text {
  std::string* value;
  bool is_name;
  int max_length;  // in characters
};

struct NumberList {
  std::vector<double>* value;
  int min_count, max_count;
};

/// A table inside the table.
struct Subtable {
  std::function<Fields()> fields;  // makes an optional table that is not there
  std::function<bool()> is_there = [] { return true; };
};

/// [[name]]: any number of equal tables.
struct Rows {
  std::function<std::size_t()> count;
  std::function<void(std::size_t)> resize;
  std::function<Fields(std::size_t)> row;
};

/// [name.<free>]: tables under names that the user chooses.
struct NamedTables {
  std::function<std::vector<std::string>()> names;
  std::function<Fields(const std::string&)> entry;  // made when it is not there yet
  std::function<void(const std::string&)> erase;
};

/// A key whose word decides which further keys its table has.
struct Kind {
  std::vector<std::string> words;
  std::function<std::size_t()> get;
  std::function<Fields(std::size_t)> select;  // switches when needed and returns the further keys
};

/// A key that names something to start from; load() fills the struct, or says why not. It comes before the
/// Kind of its table, and makes every other key optional.
struct Base {
  std::function<std::string(const std::string&)> load;
};

struct Field {
  using Value = std::variant<double*, int*, bool*, Vec3*, std::array<int, 3>*, std::optional<double>*,
                             std::optional<int>*, std::optional<Vec3>*, std::optional<std::array<int, 3>>*,
                             std::optional<std::string>*,  // a name
                             NumberList, Text, Choice, Subtable, Rows, NamedTables, Kind, Base>;
  std::string key;
  std::string doc;  // one sentence for the reference, unit and source included
  Value value;
  Range range;
  bool is_required = false;
  std::string if_absent;  // what is taken when an optional value is not given

  Field& required() { return is_required = true, *this; }
  Field& absent(std::string text) { return if_absent = std::move(text), *this; }
};

class Fields {
 public:
  Field& number(std::string key, double& value, Range range, std::string doc);
  Field& number(std::string key, std::optional<double>& value, Range range, std::string doc);
  Field& integer(std::string key, int& value, Range range, std::string doc);
  Field& integer(std::string key, std::optional<int>& value, Range range, std::string doc);
  Field& toggle(std::string key, bool& value, std::string doc);
  Field& text(std::string key, std::string& value, int max_length, std::string doc);
  /// Safe as part of a file name.
  Field& name(std::string key, std::string& value, std::string doc);
  Field& name(std::string key, std::optional<std::string>& value, std::string doc);
  Field& vector(std::string key, Vec3& value, Range range, std::string doc);
  Field& vector(std::string key, std::optional<Vec3>& value, Range range, std::string doc);
  Field& integers(std::string key, std::array<int, 3>& value, Range range, std::string doc);
  Field& integers(std::string key, std::optional<std::array<int, 3>>& value, Range range, std::string doc);
  Field& numbers(std::string key, std::vector<double>& value, int min_count, int max_count, Range range,
                 std::string doc);

  /// `value` is of an enum or an optional one.
  template <class T>
  Field& choice(std::string key, T& value, std::vector<std::pair<std::string, typename Held<T>::type>> words,
                std::string doc) {
    Choice choice;
    std::vector<typename Held<T>::type> values;
    for (auto& [word, meaning] : words) choice.words.push_back(word), values.push_back(meaning);
    choice.get = [&value, values]() -> std::optional<std::size_t> {
      const auto found = std::find(values.begin(), values.end(), value);
      if (found == values.end()) return std::nullopt;
      return static_cast<std::size_t>(found - values.begin());
    };
    choice.set = [&value, values](std::size_t i) { value = values.at(i); };
    return add(std::move(key), std::move(choice), {}, std::move(doc));
  }

  template <class T>
  Field& table(std::string key, T& value, std::string doc) {
    return add(std::move(key), Subtable{[&value] { return described(value); }}, {}, std::move(doc));
  }

  /// A table that may be absent; an empty one is there.
  template <class T>
  Field& table(std::string key, std::optional<T>& value, std::string doc) {
    return add(std::move(key),
               Subtable{[&value] { return described(value ? *value : value.emplace()); },
                        [&value] { return value.has_value(); }},
               {}, std::move(doc));
  }

  template <class T>
  Field& rows(std::string key, std::vector<T>& value, std::string doc) {
    return add(std::move(key),
               Rows{[&value] { return value.size(); }, [&value](std::size_t n) { value.resize(n); },
                    [&value](std::size_t i) { return described(value.at(i)); }},
               {}, std::move(doc));
  }

  template <class Map>
  Field& named_tables(std::string key, Map& value, std::string doc) {
    const auto names = [&value] {
      std::vector<std::string> keys;
      for (const auto& entry : value) keys.push_back(entry.first);
      return keys;
    };
    return add(std::move(key),
               NamedTables{names, [&value](const std::string& name) { return described(value[name]); },
                           [&value](const std::string& name) { value.erase(name); }},
               {}, std::move(doc));
  }

  Field& kind(std::string key, Kind kind, std::string doc) {
    return add(std::move(key), std::move(kind), {}, std::move(doc)).required();
  }
  /// `words` in the order of the alternatives.
  template <class... Ts>
  Field& kind(std::string key, std::variant<Ts...>& value, std::vector<std::string> words, std::string doc) {
    Kind choice;
    choice.words = std::move(words);
    choice.get = [&value] { return value.index(); };
    choice.select = [&value](std::size_t wanted) {
      std::size_t i = 0;
      ((i++ == wanted && value.index() != wanted ? void(value.template emplace<Ts>()) : void()), ...);
      return std::visit([](auto& chosen) { return described(chosen); }, value);
    };
    return kind(std::move(key), std::move(choice), std::move(doc));
  }

  Field& base(std::string key, std::function<std::string(const std::string&)> load, std::string doc);

  const std::vector<Field>& list() const& { return list_; }
  std::vector<Field> list() && { return std::move(list_); }  // so that `for (... : f().list())` is safe

 private:
  template <class T>
  static Fields described(T& value) {
    Fields fields;
    describe(fields, value);
    return fields;
  }
  Field& add(std::string key, Field::Value value, Range range, std::string doc);

  std::vector<Field> list_;
};

}  // namespace ripstop
