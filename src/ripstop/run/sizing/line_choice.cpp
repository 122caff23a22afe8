#include "ripstop/run/sizing/line_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>
#include <variant>

#include "ripstop/core/error.h"
#include "ripstop/material/library.h"
#include "ripstop/run/margins.h"

namespace ripstop::inline run {

double used_of(const Case& given, double opening_load, const Line& line, LineMember member) {
  const std::string_view name = member == LineMember::line ? "line" : "riser";
  for (const Margin& m :
       load_margins(given.parachute, given.margins, canopy_fabric(given), nullptr, opening_load, line, line)
           .members)
    if (m.member == name) return m.used.value_or(0);
  return 0;
}

std::vector<Line> library_lines(const std::optional<std::string>& name) {
  std::vector<Line> lines;
  std::vector<std::string> names;
  for (const std::string& each : library_names()) {
    const Material material = library_material(each);
    const Line* line = std::get_if<Line>(&material);
    if (!line) continue;
    names.push_back(each);
    if (!name || each == *name) lines.push_back(*line);
  }
  if (name && lines.empty())
    throw Error(ExitCode::usage, fmt::format("--line-material {}: the library has no such line; it has {}",
                                             *name, fmt::join(names, ", ")));
  return lines;
}

const Line& line_for(const Case& given, double opening_load, const std::vector<Line>& lines,
                     LineMember member, double least) {
  const Line *best = nullptr, *strongest = nullptr;
  double least_used = 0;
  for (const Line& line : lines) {
    const double used = used_of(given, opening_load, line, member);
    if (lines.size() > 1 && used == 0) continue;
    if (!strongest || used < least_used) strongest = &line, least_used = used;
    if (used > 1 || line.linear_density_kg_m < least) continue;
    if (!best || line.linear_density_kg_m < best->linear_density_kg_m) best = &line;
  }
  if (!best && !strongest) throw Error(ExitCode::bad_data, "the library has no line of known strength");
  return best ? *best : *strongest;
}

}  // namespace ripstop::inline run
