// Text inside XML and HTML.
#pragma once

#include <string>

namespace ripstop {

/// As text or inside a quoted attribute: nothing in it is taken for an element, and what neither format may hold
/// (control characters) is left out.
std::string escaped_markup(const std::string& text);

}  // namespace ripstop
