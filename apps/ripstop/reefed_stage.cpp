#include "reefed_stage.h"

#include <fmt/format.h>

#include <sstream>

#include "ripstop/core/error.h"

namespace ripstop::cli {

ReefedStage parse_reefed_stage(const std::string& text) {
  std::istringstream in(text);
  ReefedStage stage;
  char colon = 0, rest = 0;
  if (!(in >> stage.share >> colon >> stage.duration) || colon != ':' || in >> rest)
    throw Error(ExitCode::usage, fmt::format("--reef {}: must be SHARE:SECONDS, for example --reef 0.1:3 for "
                                             "a tenth of the drag area during 3 s",
                                             text));
  return stage;
}

}  // namespace ripstop::cli
