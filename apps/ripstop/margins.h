// What a result says of its payload and its margins, as lines of its summary.
#pragma once

#include <optional>
#include <string>

#include "ripstop/run/steady/steady.h"

namespace ripstop {

void print_payload(const SteadyResult& result);
void print_margins(const std::optional<Margins>& margins);
/// ", riser: margin of safety -0.85, ALLOWABLE LOAD EXCEEDED"; empty where no strength is known.
std::string weakest_text(const std::optional<Margins>& margins);

}  // namespace ripstop
