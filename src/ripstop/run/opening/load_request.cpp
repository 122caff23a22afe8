#include "ripstop/case/payload.h"
#include "ripstop/core/error.h"
#include "ripstop/run/opening/load.h"

namespace ripstop::inline run {

void take_speed(const Settings& resolved, const std::optional<double>& given, LoadRequest& request) {
  const auto known = deployment_speed(resolved.payload(), given);
  if (!known)
    throw Error(
        ExitCode::usage,
        "the speed at line stretch is missing: give --speed M/S, or payload.deployment_speed_m_s in the "
        "case, or --fastest for the largest safe speed");
  request.speed = known->speed, request.speed_source = known->from;
}

}  // namespace ripstop::inline run
