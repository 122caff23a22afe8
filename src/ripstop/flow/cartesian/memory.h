// Memory of the fields: large pages, since a sweep walks dozens of planes at once, and starts that differ in
// their low address bits, since fields of the same size would otherwise fall on the same cache sets.
#pragma once

#include <cstddef>
#include <vector>

namespace ripstop::inline flow::cartesian {

/// Aligned to 64 bytes, not initialised. Throws std::bad_alloc.
void* allocate_field(std::size_t bytes);
void free_field(void* memory);

template <class T>
struct FieldAllocator {
  using value_type = T;
  FieldAllocator() = default;
  template <class U>
  FieldAllocator(const FieldAllocator<U>&) {}
  T* allocate(std::size_t count) { return static_cast<T*>(allocate_field(count * sizeof(T))); }
  void deallocate(T* memory, std::size_t) { free_field(memory); }
  bool operator==(const FieldAllocator&) const { return true; }
};

template <class T>
using Array = std::vector<T, FieldAllocator<T>>;

}  // namespace ripstop::inline flow::cartesian
