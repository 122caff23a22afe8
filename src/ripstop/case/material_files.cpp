#include "ripstop/case/material_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>

#include "ripstop/core/toml/problem.h"
#include "ripstop/core/toml/read.h"

namespace ripstop::inline cases {
namespace {

namespace fs = std::filesystem;

Node* member_of(Node* table, const std::string& key) {
  if (!table || table->type != Node::Type::table) return nullptr;
  const auto found = std::find_if(table->items.begin(), table->items.end(),
                                  [&](const Node& item) { return item.key == key; });
  return found == table->items.end() ? nullptr : &*found;
}

/// Every value that names a material, with its full key.
void each_material_name(Node& root, const std::function<void(const std::string& key, Node& name)>& visit) {
  Node* parachute = member_of(&root, "parachute");
  const auto look = [&](Node* table, const std::string& above, const char* key) {
    if (Node* name = member_of(table, key); name && name->type == Node::Type::text) visit(above + key, *name);
  };
  look(parachute, "parachute.", "canopy_material");
  for (const char* part : {"lines", "riser", "tape"})
    look(member_of(parachute, part), fmt::format("parachute.{}.", part), "material");
  Node* reefing = member_of(member_of(&root, "inflation"), "reefing");
  if (!reefing || reefing->type != Node::Type::array) return;
  for (std::size_t i = 0; i < reefing->items.size(); ++i)
    look(&reefing->items[i], fmt::format("inflation.reefing[{}].", i), "material");
}

class MaterialFiles {
 public:
  MaterialFiles(Document& document, const std::vector<Setting>& settings)
      : document_(document), settings_(settings), folder_(fs::path(document.name).parent_path()) {
    std::error_code error;
    case_is_file_ = fs::is_regular_file(document.name, error);
  }

  std::map<std::string, Material> take() {
    each_material_name(document_.root, [&](const std::string& key, Node& name) {
      if (name.text.ends_with(".toml"))
        take_path(key, name);
      else if (case_is_file_ && is_name(name.text) && !in_case(name.text))
        take_neighbour(name.text);
    });
    return std::move(taken_);
  }

 private:
  bool in_case(const std::string& name) const {
    const Node* own = document_.root.find("materials");
    return own && own->find(name);
  }

  void take_neighbour(const std::string& name) {
    const fs::path file = folder_ / "materials" / (name + ".toml");
    if (!taken_.contains(name) && fs::exists(file)) taken_.emplace(name, read_material(file));
  }

  void take_path(const std::string& key, Node& value) {
    const auto setting =
        std::find_if(settings_.rbegin(), settings_.rend(), [&](const Setting& s) { return s.key == key; });
    const bool typed = setting != settings_.rend();
    const Origin origin = typed ? Origin{"", 0, 0, setting->option}
                                : Origin{document_.name, value.place.line, value.place.column, ""};
    const auto refuse = [&](const std::string& message) {
      throw InputError(ExitCode::usage,
                       std::vector<Problem>{Problem{origin, key, ripstop::quoted(value.text), "", message}});
    };
    fs::path file = folder_ / value.text;
    if (typed && !fs::exists(file)) file = value.text;
    if (!fs::exists(file))
      refuse(
          fmt::format("file {} not found; give the path of a material file relative to the case file, or the "
                      "name of a material without \".toml\"",
                      quoted((folder_ / value.text).string())));
    const std::string name = file.stem().string();
    if (!is_name(name))
      refuse("the file name is not a valid name of a material: use letters, digits, '.', '_' and '-' only");
    file = fs::weakly_canonical(file);
    const auto earlier = files_.find(name);
    const bool neighbour = earlier == files_.end() && taken_.contains(name);
    if (in_case(name) || neighbour || (earlier != files_.end() && earlier->second != file))
      refuse(fmt::format("there are two materials {}; rename one of them", quoted(name)));
    if (earlier == files_.end()) taken_.emplace(name, read_material(file));
    files_.emplace(name, file);
    value.text = name;
  }

  Document& document_;
  const std::vector<Setting>& settings_;
  fs::path folder_;
  bool case_is_file_ = false;
  std::map<std::string, Material> taken_;
  std::map<std::string, fs::path> files_;  // named by their paths
};

}  // namespace

std::map<std::string, Material> take_material_files(Document& document,
                                                    const std::vector<Setting>& settings) {
  return MaterialFiles(document, settings).take();
}

}  // namespace ripstop::inline cases
