// Text of users in scripts that a shell reads.
#pragma once

#include <string>
#include <string_view>

namespace ripstop {

/// `text` as one word of a POSIX shell, whatever is in it: nothing of it is expanded or run. Throws Error(usage)
/// for a NUL byte, which no argument of a program can have.
std::string shell_quoted(std::string_view text);

/// Letters, digits and . - _ + of `text`, everything else as one '-', at most 80: a name that needs no quotes.
std::string plain_name(std::string_view text);

}  // namespace ripstop
