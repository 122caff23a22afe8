// How row kernels are compiled: once for each x86-64 level, chosen when the program is loaded.
#pragma once

// The loader's choice runs before a sanitizer is ready, so sanitizer builds get the plain version only.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define RIPSTOP_ROW_KERNEL __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define RIPSTOP_ROW_KERNEL
#endif
// The equations of one cell, a lambda: [&](int i) RIPSTOP_CELL { ... }
#define RIPSTOP_CELL __attribute__((always_inline))

namespace ripstop::inline flow::cartesian {

// Always inlined, so that they are compiled for the level of the kernel that calls them. Ternaries, because
// std::max takes references and keeps loops from being vectorised.
[[gnu::always_inline]] inline double positive(double a) {
  return a > 0 ? a : 0;
}
[[gnu::always_inline]] inline double smaller(double a, double b) {
  return a < b ? a : b;
}
[[gnu::always_inline]] inline double larger(double a, double b) {
  return a > b ? a : b;
}

}  // namespace ripstop::inline flow::cartesian
