#include "ripstop/flow/cartesian/memory.h"

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <new>

namespace ripstop::inline flow::cartesian {
namespace {

constexpr std::size_t line = 64;
constexpr std::size_t large_page = std::size_t{2} << 20;
constexpr std::size_t colours = 16;             // different starts
constexpr std::size_t colour_step = 21 * line;  // odd number of lines: the starts spread over all sets

}  // namespace

void* allocate_field(std::size_t bytes) {
  // One line before the returned memory contains the address to free.
  const bool large = bytes >= large_page / 2;
  const std::size_t align = large ? large_page : line;
  const std::size_t whole = (bytes + line + (large ? colours * colour_step : 0) + align - 1) / align * align;
  char* raw = static_cast<char*>(std::aligned_alloc(align, whole));
  if (raw == nullptr) throw std::bad_alloc();
  std::size_t offset = line;
  if (large) {
    madvise(raw, whole, MADV_HUGEPAGE);  // a wish: without large pages the sweeps are slower, not wrong
    offset += reinterpret_cast<std::uintptr_t>(raw) / large_page % colours * colour_step;
  }
  char* memory = raw + offset;
  reinterpret_cast<void**>(memory)[-1] = raw;
  return memory;
}

void free_field(void* memory) {
  if (memory != nullptr) std::free(reinterpret_cast<void**>(memory)[-1]);
}

}  // namespace ripstop::inline flow::cartesian
