// Recovery devices in files of OpenRocket: designs (.ork) and component databases (.orc).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ripstop::inline cases {

/// A part of a file may be absent; numbers are in SI.
struct RecoveryDevice {
  std::string name;   // of a database: manufacturer and part number
  std::string stage;  // of the rocket; empty in a database
  bool streamer = false;
  int line = 0;                            // of the XML text
  std::optional<double> diameter;          // [m]
  std::optional<double> drag_coefficient;  // on pi/4 diameter^2; absent: OpenRocket's "auto", or not given
  bool automatic = false;                  // "auto"
  std::optional<double> spill_hole;        // diameter [m]; an extension that some programs write
  std::optional<int> sides, line_count;
  std::optional<double> line_length;                  // [m]
  std::string cloth, line_material;                   // names
  std::optional<double> cloth_density, line_density;  // [kg/m2], [kg/m]
  std::optional<double> mass;                         // of the device [kg]
  std::string event;                                  // "apogee", "altitude", "ejection", ...; empty: none
  std::optional<double> altitude, delay;              // above ground [m]; after the event [s]
  std::optional<double> descent_mass;                 // of its stage at the end of a stored simulation [kg]
  std::string simulation;                             // its name
};

struct OpenRocketFile {
  std::string name;
  bool database = false;
  std::vector<RecoveryDevice> devices;
  std::vector<std::string> notes;  // on parts that were left out
};

/// A design is XML, alone, compressed by gzip, or the entry rocket.ork of a ZIP archive. No entry is written to the
/// disk, document types are skipped, and a text of more than 64 MiB is refused while it is unpacked. Throws Error(io),
/// Error(bad_data) with file, line, device, element and value.
OpenRocketFile read_openrocket(const std::filesystem::path& path);

}  // namespace ripstop::inline cases
