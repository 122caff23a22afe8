// The quantities that solvers name in their errors, as keys of a case.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ripstop/core/error.h"

namespace ripstop::inline cases {

/// Name of each quantity and the key that sets it.
const std::vector<std::pair<std::string, std::string>>& quantity_keys();

/// Throws std::out_of_range for a quantity without a key.
const std::string& key_of_quantity(const std::string& quantity);

/// The message of an error for people who wrote a case: each quantity of a QuantityError is replaced by its key. Throws
/// std::out_of_range for a quantity without a key.
std::string message_of(const Error& error);

}  // namespace ripstop::inline cases
