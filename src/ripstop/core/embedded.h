// Files that become data of the program as they are.
#pragma once

#include <string_view>

// NOLINTBEGIN(bugprone-macro-parentheses): the macro contains a declared name
#define RIPSTOP_EMBEDDED(symbol, path)                                                                  \
  __asm__(".section .rodata\n.global " #symbol "\n" #symbol ":\n.incbin \"" path "\"\n.global " #symbol \
          "_end\n" #symbol "_end:\n.byte 0\n.previous\n");                                              \
  extern "C" const char symbol[];                                                                       \
  extern "C" const char symbol##_end[];
// NOLINTEND(bugprone-macro-parentheses)
#define RIPSTOP_EMBEDDED_TEXT(symbol) \
  std::string_view(symbol, static_cast<std::size_t>(symbol##_end - (symbol)))
