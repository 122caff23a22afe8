// Sorted positions along an axis, such as its edges, that are searched from a table instead of by halving.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

namespace ripstop::inline flow::cartesian {

class Places {
 public:
  /// `sorted` has two different positions at least.
  explicit Places(std::vector<double> sorted) : all_(std::move(sorted)) {
    const int buckets = buckets_for_each * static_cast<int>(all_.size());
    per_length_ = buckets / (all_.back() - all_.front());
    first_.reserve(buckets);
    int place = 0;
    for (int b = 0; b < buckets; ++b) {
      while (all_[place] < all_.front() + b / per_length_) ++place;
      first_.push_back(std::max(place - 1, 0));  // one less, for rounding of bucket()
    }
  }

  double operator[](std::size_t n) const { return all_[n]; }
  /// How many are below x: std::lower_bound.
  int below(double x) const {
    int n = first_[bucket(x)];
    while (n < size() && all_[n] < x) ++n;
    return n;
  }
  /// How many are not above x: std::upper_bound.
  int up_to(double x) const {
    int n = first_[bucket(x)];
    while (n < size() && all_[n] <= x) ++n;
    return n;
  }

 private:
  static constexpr int buckets_for_each = 4;
  int size() const { return static_cast<int>(all_.size()); }
  int bucket(double x) const {
    const double b = (x - all_.front()) * per_length_;
    return b > 0 ? static_cast<int>(std::min(b, static_cast<double>(first_.size() - 1))) : 0;
  }

  std::vector<double> all_;
  std::vector<int> first_;  // of each of the equal parts of the range; no place of a part lies before it
  double per_length_ = 0;   // parts over length
};

}  // namespace ripstop::inline flow::cartesian
