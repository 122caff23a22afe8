// From a recovery device of OpenRocket to a case of Ripstop.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ripstop/case/imported_case.h"
#include "ripstop/case/openrocket_file.h"

namespace ripstop::inline cases {

/// The diameter that a file gives: of the cloth laid flat, as OpenRocket defines it, or of the open canopy, as
/// makers often state it together with a drag coefficient on the projected area.
enum class GivenDiameter { constructed, projected };

/// Assumed where the file has none: lines over the nominal diameter, vent over it, and number of lines.
constexpr double openrocket_line_share = 1.15, openrocket_vent_share = 0.1;
constexpr int openrocket_line_count = 8;

/// Data that the file does not contain.
struct OpenRocketImportOptions {
  GivenDiameter diameter = GivenDiameter::constructed;
  std::optional<int> line_count;        // absent: the file's, or openrocket_line_count
  std::optional<double> line_length;    // [m]; absent: the file's, or by openrocket_line_share
  std::optional<double> vent_diameter;  // [m]; absent: the file's spill hole, or by openrocket_vent_share
  std::optional<double> payload_mass;   // [kg]; absent: that of a stored simulation without its parachutes
};

/// The device that `wanted` names: its number in the list, counted from 1, or its name. Empty: the only parachute of
/// the file. Throws Error(usage) with the list of devices where there is a choice or none fits.
const RecoveryDevice& choose_device(const OpenRocketFile& file, std::string_view wanted);

/// A flat circular canopy whose drag area is that of the device. `source` names the file in the case. Throws
/// Error(bad_data) for a streamer and for a device without a diameter.
ImportedCase import_openrocket(const OpenRocketFile& file, const RecoveryDevice& device,
                               const OpenRocketImportOptions& options, const std::string& source);

}  // namespace ripstop::inline cases
