// The material library: materials/<name>.toml, and materials written inside a case file.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "ripstop/core/toml/document.h"
#include "ripstop/material/material.h"

namespace ripstop {
class Fields;
class Findings;
}  // namespace ripstop

namespace ripstop::inline material {

/// The alternative is chosen by the key `kind` = "fabric", "line" or "tape".
using Material = std::variant<Fabric, Line, Tape>;

void describe(Fields& fields, Fabric& fabric);
void describe(Fields& fields, Line& line);
void describe(Fields& fields, Tape& tape);
/// `kind` and the keys of that kind.
void describe(Fields& fields, Material& material);

/// Reports mistakes that single ranges do not show: a law that does not rise, springs without an axial share.
/// `key` is the full name of the table, empty for a separate file.
void check_material(const Material& material, const std::string& key, Findings& findings);

/// Characters of a material's `warning`.
inline constexpr std::size_t most_warning_text = 2000;

/// The two keys of a cloth's permeability for a porosity model: of its linear and of its quadratic part.
std::pair<std::string, std::string> resistance_keys(PorosityModel model);
/// Leaves one form of the permeability, with both its numbers: where some of its keys are `given`, they replace a
/// base's in another form. Two forms are reported to `refuse`, with the key of one of them.
void settle_resistance(ClothResistance& cloth, const std::function<bool(const std::string& key)>& given,
                       const std::function<void(const std::string& key, const std::string& message)>& refuse);

/// A key that had another name in earlier versions; `now` is empty where it has become unnecessary.
struct RenamedKey {
  std::string old, now;
};
/// Gives the old keys `darcy`, `forchheimer` and `porosity_model` of a material's table their names of today.
std::vector<RenamedKey> rename_old_keys(Node& material);

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

}  // namespace ripstop::inline material
