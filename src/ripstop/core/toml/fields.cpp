#include "ripstop/core/toml/fields.h"

#include <fmt/format.h>

#include <cmath>

namespace ripstop {

bool Range::contains(double value) const {
  if (std::isnan(value)) return false;
  return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

std::string Range::text() const {
  std::string lower, upper;
  if (std::isfinite(low)) lower = fmt::format("{} {}", low_open ? "above" : "at least", low);
  if (std::isfinite(high)) upper = fmt::format("{} {}", high_open ? "below" : "at most", high);
  if (lower.empty()) return upper;
  return upper.empty() ? lower : lower + " and " + upper;
}

Field& Fields::add(std::string key, Field::Value value, Range range, std::string doc) {
  list_.push_back({std::move(key), std::move(doc), std::move(value), range, false, {}});
  return list_.back();
}

Field& Fields::number(std::string key, double& value, Range range, std::string doc) {
  return add(std::move(key), &value, range, std::move(doc));
}
Field& Fields::number(std::string key, std::optional<double>& value, Range range, std::string doc) {
  return add(std::move(key), &value, range, std::move(doc));
}
Field& Fields::integer(std::string key, int& value, Range range, std::string doc) {
  return add(std::move(key), &value, range, std::move(doc));
}
Field& Fields::integer(std::string key, std::optional<int>& value, Range range, std::string doc) {
  return add(std::move(key), &value, range, std::move(doc));
}
Field& Fields::toggle(std::string key, bool& value, std::string doc) {
  return add(std::move(key), &value, {}, std::move(doc));
}
Field& Fields::text(std::string key, std::string& value, int max_length, std::string doc) {
  return add(std::move(key), Text{&value, false, max_length}, {}, std::move(doc));
}
Field& Fields::name(std::string key, std::string& value, std::string doc) {
  return add(std::move(key), Text{&value, true, 64}, {}, std::move(doc));
}
Field& Fields::name(std::string key, std::optional<std::string>& value, std::string doc) {
  return add(std::move(key), &value, {}, std::move(doc));
}
Field& Fields::vector(std::string key, Vec3& value, Range range, std::string doc) {
  return add(std::move(key), &value, range, std::move(doc));
}
Field& Fields::vector(std::string key, std::optional<Vec3>& value, Range range, std::string doc) {
  return add(std::move(key), &value, range, std::move(doc));
}
Field& Fields::integers(std::string key, std::optional<std::array<int, 3>>& value, Range range,
                        std::string doc) {
  return add(std::move(key), &value, range, std::move(doc));
}
Field& Fields::integers(std::string key, std::array<int, 3>& value, Range range, std::string doc) {
  return add(std::move(key), &value, range, std::move(doc));
}
Field& Fields::numbers(std::string key, std::vector<double>& value, int min_count, int max_count, Range range,
                       std::string doc) {
  return add(std::move(key), NumberList{&value, min_count, max_count}, range, std::move(doc));
}
Field& Fields::base(std::string key, std::function<std::string(const std::string&)> load, std::string doc) {
  return add(std::move(key), Base{std::move(load)}, {}, std::move(doc));
}

}  // namespace ripstop
