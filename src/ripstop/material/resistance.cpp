// The keys of a cloth's permeability: their meaning, and their deprecated names.
#include <fmt/format.h>

#include <algorithm>

#include "ripstop/core/toml/problem.h"
#include "ripstop/core/toml/read.h"
#include "ripstop/material/library.h"

namespace ripstop::inline material {
namespace {

constexpr const char *linear_key = "pressure_drop_linear_pa_s_m",
                     *quadratic_key = "pressure_drop_quadratic_pa_s2_m2", *darcy_key = "darcy_1_m2",
                     *forchheimer_key = "forchheimer_1_m";

/// One way to give the permeability: its keys and the members behind them.
struct PermeabilityForm {
  using Key = std::pair<std::string, std::optional<double>*>;
  std::vector<Key> keys;

  bool present() const {
    return std::any_of(keys.begin(), keys.end(), [](const Key& key) { return key.second->has_value(); });
  }
};

std::vector<PermeabilityForm> forms_of(ClothResistance& cloth) {
  using Key = PermeabilityForm::Key;
  const Key a{linear_key, &cloth.pressure_drop_linear_pa_s_m},
      b{quadratic_key, &cloth.pressure_drop_quadratic_pa_s2_m2},
      cfm{"permeability_cfm", &cloth.permeability_cfm}, d{darcy_key, &cloth.darcy_1_m2},
      f{forchheimer_key, &cloth.forchheimer_1_m};
  std::vector<PermeabilityForm> forms(3);
  forms[0].keys = {a, b}, forms[1].keys = {cfm}, forms[2].keys = {d, f};
  return forms;
}

Node* member_of(Node& table, const std::string& key) {
  const auto found =
      std::find_if(table.items.begin(), table.items.end(), [&](const Node& node) { return node.key == key; });
  return found == table.items.end() ? nullptr : &*found;
}

/// Of the library's cloth that the table starts from; of no cloth where there is none.
ClothResistance base_of(Node& material) {
  const Node* base = member_of(material, "base");
  const std::vector<std::string> names = library_names();
  if (!base || std::find(names.begin(), names.end(), base->text) == names.end()) return {};
  const Material found = library_material(base->text);
  const Fabric* fabric = std::get_if<Fabric>(&found);
  return fabric ? fabric->resistance : ClothResistance{};
}

}  // namespace

PorosityModel model_of(const ClothResistance& cloth) {
  return cloth.darcy_1_m2 || cloth.forchheimer_1_m ? PorosityModel::paper : PorosityModel::sheet;
}

PressureDrop as_sheet(const ClothResistance& cloth) {
  if (cloth.permeability_cfm) return law_of_cfm(*cloth.permeability_cfm);
  if (model_of(cloth) == PorosityModel::paper)
    return {cloth.darcy_1_m2.value_or(0), cloth.forchheimer_1_m.value_or(0)};
  return {cloth.pressure_drop_linear_pa_s_m.value_or(0), cloth.pressure_drop_quadratic_pa_s2_m2.value_or(0)};
}

PorousCellLaw as_cells(const ClothResistance& cloth) {
  const PressureDrop typed = as_sheet(cloth);
  return {typed.linear, typed.quadratic};
}

std::pair<std::string, std::string> resistance_keys(PorosityModel model) {
  if (model == PorosityModel::paper) return {darcy_key, forchheimer_key};
  return {linear_key, quadratic_key};
}

void settle_resistance(
    ClothResistance& cloth, const std::function<bool(const std::string& key)>& given,
    const std::function<void(const std::string& key, const std::string& message)>& refuse) {
  std::vector<PermeabilityForm> forms = forms_of(cloth);
  const auto is_given = [&](const PermeabilityForm& form) {
    return std::any_of(form.keys.begin(), form.keys.end(),
                       [&](const auto& key) { return key.second->has_value() && given(key.first); });
  };
  if (std::any_of(forms.begin(), forms.end(), is_given))  // given keys replace those of the base
    for (const PermeabilityForm& form : forms)
      if (!is_given(form))
        for (const auto& [key, value] : form.keys) value->reset();
  std::erase_if(forms, [](const PermeabilityForm& form) { return !form.present(); });
  if (forms.size() > 1) {
    const std::string& first = forms[0].keys.front().first;
    return refuse(forms[1].keys.front().first,
                  fmt::format("the permeability is given twice; remove this key or {}", first));
  }
  const PorosityModel model = model_of(cloth);
  const PressureDrop law = as_sheet(cloth);
  if (model == PorosityModel::paper)
    cloth = {{}, {}, {}, law.linear, law.quadratic};
  else
    cloth = {law.linear, law.quadratic, {}, {}, {}};
}

std::vector<RenamedKey> rename_old_keys(Node& material) {
  std::vector<RenamedKey> renamed;
  Node *a = member_of(material, "darcy"), *b = member_of(material, "forchheimer"),
       *word = member_of(material, "porosity_model");
  if (word && word->text != "sheet" && word->text != "paper") word = nullptr;  // reported as an unknown key
  if (!a && !b && !word) return renamed;
  const ClothResistance base = base_of(material);
  const PorosityModel own = model_of(base);
  const PorosityModel model =
      word ? (word->text == "paper" ? PorosityModel::paper : PorosityModel::sheet) : own;
  const auto [new_a, new_b] = resistance_keys(model);
  const auto rename = [&](Node* node, const std::string& name) {
    if (!node || member_of(material, name)) return;
    renamed.push_back({node->key, name});
    node->key = name;
  };
  rename(a, new_a);
  rename(b, new_b);
  if (!word) return renamed;
  const Place place = word->place;
  renamed.push_back({"porosity_model", ""});
  std::erase_if(material.items, [](const Node& node) { return node.key == "porosity_model"; });
  if (model == own || !member_of(material, "base")) return renamed;
  const PressureDrop typed = as_sheet(base);  // the base's numbers are taken for the other model
  for (const auto& [name, value] : {std::pair{new_a, typed.linear}, std::pair{new_b, typed.quadratic}}) {
    if (member_of(material, name)) continue;
    Node node;
    node.type = Node::Type::number, node.key = name, node.number = value, node.place = node.key_place = place;
    material.items.push_back(node);
  }
  return renamed;
}

}  // namespace ripstop::inline material
