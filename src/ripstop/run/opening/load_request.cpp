#include "ripstop/core/error.h"
#include "ripstop/run/opening/load.h"

namespace ripstop::inline run {

void take_speed(const Settings& resolved, const std::optional<double>& given, LoadRequest& request) {
  const std::optional<double>& known = resolved.payload().deployment_speed_m_s;
  if (!given && !known)
    throw Error(
        ExitCode::usage,
        "the speed at line stretch is missing: give --speed M/S, or payload.deployment_speed_m_s in the "
        "case, or --fastest for the largest safe speed");
  request.speed = given ? *given : *known;
  request.speed_source = given ? "given" : "payload.deployment_speed_m_s of the case";
}

}  // namespace ripstop::inline run
