// Binary STL: a surface as triangles in single precision, for CAD and meshing programs.
#pragma once

#include <filesystem>
#include <vector>

#include "ripstop/flow/flow.h"

namespace ripstop::inline flow {

/// Normals follow the right-hand rule (a, b, c); a triangle without area gets (0, 0, 0). Throws
/// Error(bad_data) for a corner that is not finite or beyond single precision, Error(io).
void write_stl(const std::filesystem::path& path, const std::vector<Triangle>& surface);

/// The triangles of a binary or text STL; its normals are not read, since the corners determine them. Throws
/// Error(bad_data) for a length that does not match the count, a corner that is not finite, an incomplete triangle,
/// Error(io).
std::vector<Triangle> read_stl(const std::filesystem::path& path);

}  // namespace ripstop::inline flow
