// Reads a parsed table into described structs and collects everything that is wrong with it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ripstop/core/toml/document.h"
#include "ripstop/core/toml/fields.h"
#include "ripstop/core/toml/problem.h"

namespace ripstop {

/// Fills the structs behind `fields` and notes the origin of every key that could be read. Reports unknown keys,
/// wrong types, NaN and infinity, words that are not in a list, and missing keys. check_values() checks further
/// requirements of values of the right type.
void read_table(const Fields& fields, const Document& document, Origins& origins,
                std::vector<Problem>& problems);

/// Reports every value outside its range, text that may not be, and lists of a wrong length, wherever the
/// values came from; a key that already has a problem is not looked at again.
void check_values(const Fields& fields, const Origins& origins, std::vector<Problem>& problems);

/// Both: `describe` is called again after reading, since the lists and rows of a struct then have their elements.
void read_and_check(const std::function<void(Fields&)>& describe, const Document& document, Origins& origins,
                    std::vector<Problem>& problems);

/// True for letters, digits, '.', '_', '-' that begin with a letter or digit, at most 64.
bool is_name(const std::string& text);

/// The text in double quotes, cut to a readable length, with control characters made visible.
std::string quoted(const std::string& text);

}  // namespace ripstop
