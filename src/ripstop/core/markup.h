// Text inside XML and HTML.
#pragma once

#include <string>

namespace ripstop {

/// For text or a quoted attribute: no part of the result is read as an element, and characters that neither
/// format allows (control characters) are removed.
std::string escaped_markup(const std::string& text);

}  // namespace ripstop
