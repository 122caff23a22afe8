// The head of OpenFOAM's files, and lists in its binary format.
#pragma once

#include <string>
#include <vector>

namespace ripstop::inline flow::openfoam {

/// The head of a file; `format`: "ascii" or "binary".
std::string foam_header(const std::string& kind, const std::string& object, const std::string& format,
                        const std::string& note = {});
/// "N(bytes)": labels, or values of `components` numbers.
std::string binary_list(const std::vector<int>& labels);
std::string binary_list(const std::vector<double>& numbers, int components);

}  // namespace ripstop::inline flow::openfoam
