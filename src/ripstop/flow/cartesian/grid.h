// Metrics of a rectilinear grid, one axis at a time, and the padded layout of the fields on it.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

namespace ripstop::cartesian {

/// What holds a variable at one end of an axis.
enum class End { zero_gradient, fixed_value };

/// One axis of n cells. Face f is the low side of cell f; face n is the high end.
struct Axis {
  int n = 0;
  std::vector<double> edge;              // n + 1 [m]
  std::vector<double> width;             // n [m]
  std::vector<double> inverse_width;     // n [1/m]
  std::vector<double> weight_low;        // n + 1: face value = w q[f-1] + (1-w) q[f], linear interpolation
  std::vector<double> inverse_distance;  // n + 1: 1 / distance of the two values that a face parts [1/m]
  std::vector<double> slope_low;         // n: dq/dx at cell c = slope_low (q[c] - q[c-1])
  std::vector<double> slope_high;        // n:                 + slope_high (q[c+1] - q[c]), Gauss linear
};

/// Axis from its n + 1 edges, increasing. At an end with a fixed value the distance is the half cell, at one
/// with zero gradient the inverse distance is zero. Throws Error(usage) if the edges do not increase.
Axis make_axis(std::vector<double> edges, End low, End high);

/// Fields carry one layer of ghost cells; rows start on a cache line.
struct Layout {
  int nx = 0, ny = 0, nz = 0;
  int stride_y = 0;  // values from a row to the next
  int stride_z = 0;  // values from a plane to the next

  static constexpr int lead = 8;  // values before cell 0 of a row, so that cell 0 is aligned to 64 bytes

  Layout() = default;
  Layout(int nx_, int ny_, int nz_);

  std::size_t values() const { return static_cast<std::size_t>(stride_z) * (nz + 2); }
  std::ptrdiff_t at(int i, int j, int k) const {
    return lead + i + static_cast<std::ptrdiff_t>(j + 1) * stride_y +
           static_cast<std::ptrdiff_t>(k + 1) * stride_z;
  }
  /// Offset of cell (i, j) inside a single plane (rings of planes in the sweeps).
  std::ptrdiff_t in_plane(int i, int j) const {
    return lead + i + static_cast<std::ptrdiff_t>(j + 1) * stride_y;
  }
};

/// Zeroed memory aligned to 64 bytes. No bounds; the layout knows them.
template <class T>
class Array {
 public:
  Array() = default;
  explicit Array(std::size_t count) : count_(count), data_(allocate(count)) {}
  Array(const Array& other) : Array(other.count_) {
    if (count_) std::memcpy(data_.get(), other.data_.get(), count_ * sizeof(T));
  }
  Array(Array&&) noexcept = default;
  Array& operator=(Array other) noexcept {
    count_ = other.count_;
    data_.swap(other.data_);
    return *this;
  }

  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  std::size_t size() const { return count_; }
  T& operator[](std::ptrdiff_t i) { return data_.get()[i]; }
  const T& operator[](std::ptrdiff_t i) const { return data_.get()[i]; }

 private:
  struct Free {
    void operator()(T* p) const { std::free(p); }
  };
  static T* allocate(std::size_t count) {
    if (count == 0) return nullptr;
    const std::size_t bytes = (count * sizeof(T) + 63) / 64 * 64;
    void* p = std::aligned_alloc(64, bytes);
    if (!p) throw std::bad_alloc();
    std::memset(p, 0, bytes);
    return static_cast<T*>(p);
  }
  std::size_t count_ = 0;
  std::unique_ptr<T, Free> data_;
};

}  // namespace ripstop::cartesian
