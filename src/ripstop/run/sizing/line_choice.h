// The lines of the library that carry an opening load: for `ripstop size`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/case.h"

namespace ripstop::inline run {

/// A member that is made of a line.
enum class LineMember { line, riser };

/// Safety factor times load over allowable load of `member` of the case under an opening load [N], if it is made of `line`;
/// 0: its strength is not known.
double used_of(const Case& given, double opening_load, const Line& line, LineMember member);

/// All lines of the library, or the one that is named. Throws Error(usage) if there is no such line.
std::vector<Line> library_lines(const std::optional<std::string>& name);

/// The lightest of `lines` that carries the opening load as `member`, no lighter than `least` [kg/m]; the strongest if none
/// does. A single line is the only choice. Throws Error(bad_data) if no strength is known.
const Line& line_for(const Case& given, double opening_load, const std::vector<Line>& lines,
                     LineMember member, double least);

}  // namespace ripstop::inline run
