// Warnings on standard error.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ripstop::cli {

/// A line each on standard error; on a terminal the word "warning" is red.
void print_warnings(const std::vector<std::string>& warnings);

/// The warnings of a result, and a last line with the reasons where it is not usable. Returns the exit status:
/// ExitCode::not_converged where it is not usable.
int print_result_warnings(const std::optional<std::vector<std::string>>& warnings,
                          const std::optional<bool>& usable);

/// Reports deprecated keys of a case on standard error.
void print_deprecations(const std::vector<std::string>& deprecations);

}  // namespace ripstop::cli
