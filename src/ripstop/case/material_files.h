// Materials that a case names by a file of their own.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "ripstop/core/toml/set.h"
#include "ripstop/material/library.h"

namespace ripstop::inline cases {

/// Reads the materials that parachute and reefing name by a path ("my-cloth.toml", relative to the case file; of a
/// setting also to the working folder), or that lie in the folder `materials` next to the case file, and replaces each
/// path by the material's name. A table [materials.NAME] of the case has priority over that folder, and the folder over
/// the library. Throws InputError(usage) for a path without a file or a name that is taken, and as read_material().
std::map<std::string, Material> take_material_files(Document& document, const std::vector<Setting>& settings);

}  // namespace ripstop::inline cases
