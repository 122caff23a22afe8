// The material library: materials/<name>.toml, and materials written inside a case file.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "ripstop/material/material.h"

namespace ripstop {

class Fields;
class Findings;

/// The alternative is chosen by the key `kind` = "fabric", "line" or "tape".
using Material = std::variant<Fabric, Line, Tape>;

void describe(Fields& fields, Fabric& fabric);
void describe(Fields& fields, Line& line);
void describe(Fields& fields, Tape& tape);
/// `kind` and the keys of that kind.
void describe(Fields& fields, Material& material);

/// Reports what single ranges do not show: a law that does not rise, springs without an axial share.
/// `key` is the table's full name, empty for a file of its own.
void check_material(const Material& material, const std::string& key, Findings& findings);

/// Characters of a material's `warning`.
inline constexpr std::size_t most_warning_text = 2000;

std::string kind_of(const Material& material);  // "fabric", "line", "tape"
std::string name_of(const Material& material);
void set_name(Material& material, const std::string& name);

/// A file that read_material() reads back to the same material, bit by bit (but for the name: the file's).
std::string material_to_toml(const Material& material);

/// Names in the library, sorted.
std::vector<std::string> library_names();
/// Reads one material file. Throws InputError(bad_data) with every problem in it, Error(io) when unreadable.
Material read_material(const std::filesystem::path& file);
/// materials/<name>.toml. Throws Error(usage) that names the nearest material when there is no such file.
Material library_material(const std::string& name);

}  // namespace ripstop
