// The air in one plane, as a strip of pictures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/flow/flow.h"

namespace ripstop::inline output {

/// A field with ny = 1, and the text below it.
struct FlowShot {
  std::string caption;  // "t = 1.24 s"
  const FlowField* field = nullptr;
};

/// Draws the speed in the part of the plane with the finest cells, three shots in a row in one range of
/// colours, the stream from left to right. PNG or SVG by the ending of `path`. Throws Error(bad_data)
/// without a shot or for a field that is no plane, Error(usage) for another ending, Error(io).
void write_flow_picture(const std::filesystem::path& path, const std::string& title,
                        const std::vector<FlowShot>& shots);

}  // namespace ripstop::inline output
