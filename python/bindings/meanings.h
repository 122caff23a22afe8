// Meanings of the attributes of results: their docstrings.
#pragma once

#include <string>

namespace ripstop::python {

/// With its unit. `type`: the class in Python; `name`: the attribute.
std::string meaning_of(const std::string& type, const std::string& name);

}  // namespace ripstop::python
