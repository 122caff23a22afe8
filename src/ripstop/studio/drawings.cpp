// The drawings of the canopy families in the guide, with the keys of their parameters.
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "ripstop/core/build_info.h"
#include "ripstop/core/embedded.h"
#include "ripstop/core/file.h"
#include "ripstop/studio/case_edit.h"
#include "ripstop/studio/server.h"

// RIPSTOP_STUDIO_DRAWINGS is set where this file is compiled.
#define RIPSTOP_STUDIO_DRAWING(symbol, type) RIPSTOP_EMBEDDED(symbol, RIPSTOP_STUDIO_DRAWINGS "/" type ".svg")

RIPSTOP_STUDIO_DRAWING(ripstop_drawing_annular, "annular")
RIPSTOP_STUDIO_DRAWING(ripstop_drawing_conical, "conical")
RIPSTOP_STUDIO_DRAWING(ripstop_drawing_cross, "cross")
RIPSTOP_STUDIO_DRAWING(ripstop_drawing_disk_gap_band, "disk-gap-band")
RIPSTOP_STUDIO_DRAWING(ripstop_drawing_extended_skirt, "extended-skirt")
RIPSTOP_STUDIO_DRAWING(ripstop_drawing_flat_circular, "flat-circular")
RIPSTOP_STUDIO_DRAWING(ripstop_drawing_polygon, "polygon")
RIPSTOP_STUDIO_DRAWING(ripstop_drawing_profile, "profile")
RIPSTOP_STUDIO_DRAWING(ripstop_drawing_ringsail, "ringsail")
RIPSTOP_STUDIO_DRAWING(ripstop_drawing_ringslot, "ringslot")
RIPSTOP_STUDIO_DRAWING(ripstop_drawing_spherical, "spherical")

namespace ripstop::inline studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::array<std::pair<const char*, std::string_view>, 11> drawings() {
  return {{{"annular", RIPSTOP_EMBEDDED_TEXT(ripstop_drawing_annular)},
           {"conical", RIPSTOP_EMBEDDED_TEXT(ripstop_drawing_conical)},
           {"cross", RIPSTOP_EMBEDDED_TEXT(ripstop_drawing_cross)},
           {"disk-gap-band", RIPSTOP_EMBEDDED_TEXT(ripstop_drawing_disk_gap_band)},
           {"extended-skirt", RIPSTOP_EMBEDDED_TEXT(ripstop_drawing_extended_skirt)},
           {"flat-circular", RIPSTOP_EMBEDDED_TEXT(ripstop_drawing_flat_circular)},
           {"polygon", RIPSTOP_EMBEDDED_TEXT(ripstop_drawing_polygon)},
           {"profile", RIPSTOP_EMBEDDED_TEXT(ripstop_drawing_profile)},
           {"ringsail", RIPSTOP_EMBEDDED_TEXT(ripstop_drawing_ringsail)},
           {"ringslot", RIPSTOP_EMBEDDED_TEXT(ripstop_drawing_ringslot)},
           {"spherical", RIPSTOP_EMBEDDED_TEXT(ripstop_drawing_spherical)}}};
}

}  // namespace

std::string studio_drawings() {
  Json types = Json::object(), families = Json::object();
  for (const auto& [type, text] : drawings()) types[type] = text;
  for (const fs::directory_entry& entry : fs::directory_iterator(data_directory() / "examples")) {
    if (!fs::exists(entry.path() / "case.toml")) continue;
    const auto values = written_values(read_file(entry.path() / "case.toml"));
    if (const auto type = values.find("parachute.type"); type != values.end())
      families[entry.path().filename().string()] = Json::parse(type->second, nullptr, false);
  }
  return Json{{"types", types}, {"families", families}}.dump();
}

}  // namespace ripstop::inline studio
