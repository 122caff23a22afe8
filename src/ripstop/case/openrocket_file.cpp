#include "ripstop/case/openrocket_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <pugixml.hpp>
#include <string_view>

#include "ripstop/case/openrocket_text.h"
#include "ripstop/core/error.h"
#include "ripstop/core/quantity.h"
#include "ripstop/core/table/text.h"
#include "ripstop/core/visible.h"

namespace ripstop::inline cases {
namespace {

constexpr int deepest_component = 200;  // components inside components

using table::trimmed;

class OpenRocketReader {
 public:
  explicit OpenRocketReader(const std::filesystem::path& path)
      : path_(path), text_(openrocket_text_of(path)) {}

  OpenRocketFile run() {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(text_.data(), text_.size());
    if (!parsed) refuse(line_at(parsed.offset), fmt::format("is not valid XML: {}", parsed.description()));
    const pugi::xml_node root = document.document_element();
    const std::string kind = root.name();
    if (kind == "openrocket") {
      read_design(root);
    } else if (kind == "OpenRocketComponent") {
      read_database(root);
    } else {
      refuse(
          line_of(root),
          fmt::format("begins with <{}>, which is neither a design (<openrocket>) nor a component database "
                      "(<OpenRocketComponent>) of OpenRocket",
                      visible_line(kind)));
    }
    return std::move(file_);
  }

 private:
  int line_at(std::ptrdiff_t offset) const {
    const auto end = text_.begin() + std::clamp<std::ptrdiff_t>(offset, 0, std::ssize(text_));
    return 1 + static_cast<int>(std::count(text_.begin(), end, '\n'));
  }
  int line_of(const pugi::xml_node& node) const { return line_at(node.offset_debug()); }
  [[noreturn]] void refuse(int line, const std::string& reason) const {
    throw Error(ExitCode::bad_data, fmt::format("{}:{}: {}", path_.string(), line, reason));
  }

  std::string text_of(const pugi::xml_node& parent, const char* element) const {
    return trimmed(parent.child(element).text().get());
  }
  /// The number of an element in `unit`, with the unit of its own attribute if it has one; absent: no such element.
  std::optional<double> number(const pugi::xml_node& parent, const char* element, const std::string& unit,
                               double low, double high) const {
    const pugi::xml_node node = parent.child(element);
    if (!node) return {};
    const std::string own = trimmed(node.attribute("Unit").value());
    return value_of(node, trimmed(node.text().get()), own, unit, low, high);
  }
  double value_of(const pugi::xml_node& node, const std::string& text, const std::string& own,
                  const std::string& unit, double low, double high) const {
    const auto fail = [&](const std::string& reason) {
      refuse(line_of(node), fmt::format("<{}> {}{}: {}", node.name(), visible_line(text),
                                        own.empty() ? "" : " " + visible_line(own), reason));
    };
    double plain = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), plain);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(plain))
      fail("must be a number");
    const TypedNumber read = read_typed(own.empty() ? text : text + " " + own, unit);
    if (!read.refusal.empty()) fail("must be " + read.refusal);
    if (!(read.value >= low && read.value <= high))
      fail(fmt::format("must be from {:g} to {:g}{}", low, high, unit.empty() ? "" : " " + unit));
    return read.value;
  }
  std::optional<int> count(const pugi::xml_node& parent, const char* element) const {
    const std::optional<double> value = number(parent, element, "", 0, 500);
    if (value && *value != std::floor(*value))
      refuse(line_of(parent.child(element)), fmt::format("<{}> {}: must be an integer", element, *value));
    return value ? std::optional(static_cast<int>(*value)) : std::nullopt;
  }

  void read_design(const pugi::xml_node& root) {
    const pugi::xml_node rocket = root.child("rocket");
    file_.name = text_of(rocket, "name");
    visit(rocket, "", 0);
    for (RecoveryDevice& device : file_.devices) find_descent_mass(root, device);
  }

  void visit(const pugi::xml_node& component, const std::string& stage, int depth) {
    if (depth > deepest_component) refuse(line_of(component), "has too many components inside one another");
    for (const pugi::xml_node part : component.child("subcomponents").children()) {
      const std::string kind = part.name();
      if (kind == "parachute" || kind == "streamer") {
        file_.devices.push_back(device_of(part, stage));
      } else {
        visit(part, kind == "stage" ? text_of(part, "name") : stage, depth + 1);
      }
    }
  }

  RecoveryDevice device_of(const pugi::xml_node& part, const std::string& stage) {
    RecoveryDevice d;
    d.name = text_of(part, "name"), d.stage = stage, d.line = line_of(part);
    d.streamer = std::string_view(part.name()) == "streamer";
    d.diameter = number(part, "diameter", "m", 0.005, 100);
    d.automatic = text_of(part, "cd").starts_with("auto");
    if (!d.automatic) d.drag_coefficient = number(part, "cd", "", 0.01, 20);
    d.spill_hole = number(part, "spillholediameter", "m", 0, 100);
    d.line_count = count(part, "linecount");
    d.line_length = number(part, "linelength", "m", 0, 1000);
    d.mass = number(part, "overridemass", "kg", 0, 1e6);
    read_material(part.child("material"), "surface", d.cloth, d.cloth_density);
    read_material(part.child("linematerial"), "line", d.line_material, d.line_density);
    d.event = text_of(part, "deployevent");
    d.altitude = number(part, "deployaltitude", "m", 0, 1e6);
    d.delay = number(part, "deploydelay", "s", 0, 1e5);
    const auto own = part.children("deploymentconfiguration");
    if (const auto configurations = std::distance(own.begin(), own.end()); configurations > 0)
      file_.notes.push_back(fmt::format(
          "\"{}\": the deployment settings of {} flight configuration{}; the default ones are used",
          visible_line(d.name), configurations, configurations == 1 ? "" : "s"));
    return d;
  }

  void read_material(const pugi::xml_node& node, const std::string& type, std::string& name,
                     std::optional<double>& density) {
    if (!node) return;
    name = trimmed(node.text().get());
    const pugi::xml_attribute given = node.attribute("density");
    if (!given) return;
    if (trimmed(node.attribute("type").value()) != type) {
      file_.notes.push_back(fmt::format("material \"{}\": a density that is not that of a {}",
                                        visible_line(name), type == "line" ? "line" : "cloth"));
      return;
    }
    density = value_of(node, trimmed(given.value()), "", "", 1e-6, 100);
  }

  /// Last mass of the stage in the first simulation whose data are stored.
  void find_descent_mass(const pugi::xml_node& root, RecoveryDevice& device) {
    for (const pugi::xml_node simulation : root.child("simulations").children("simulation")) {
      pugi::xml_node found;
      for (const pugi::xml_node branch : simulation.child("flightdata").children("databranch"))
        if (!found || trimmed(branch.attribute("name").value()) == device.stage) found = branch;
      const std::string mass = last_of(found, "Mass");
      double value = 0;
      const auto [end, error] = std::from_chars(mass.data(), mass.data() + mass.size(), value);
      if (error != std::errc() || !(value > 0) || !std::isfinite(value)) continue;
      device.descent_mass = value;
      device.simulation = text_of(simulation, "name");
      return;
    }
  }
  static std::string last_of(const pugi::xml_node& branch, std::string_view column) {
    const auto cell = [](std::string_view row, std::size_t index) {
      for (; index > 0 && !row.empty(); --index) {
        const auto comma = row.find(',');
        row = comma == std::string_view::npos ? std::string_view() : row.substr(comma + 1);
      }
      return trimmed(row.substr(0, row.find(',')));
    };
    const std::string types = branch.attribute("types").value();
    const auto columns = static_cast<std::size_t>(std::count(types.begin(), types.end(), ',')) + 1;
    pugi::xml_node row;
    for (const pugi::xml_node point : branch.children("datapoint")) row = point;
    for (std::size_t i = 0; i < columns; ++i)
      if (cell(types, i) == column) return cell(row.text().get(), i);
    return "";
  }

  void read_database(const pugi::xml_node& root) {
    file_.database = true;
    for (const pugi::xml_node part : root.child("Components").children()) {
      const std::string kind = part.name();
      if (kind != "Parachute" && kind != "Streamer") continue;
      RecoveryDevice d;
      d.name = trimmed(text_of(part, "Manufacturer") + " " + text_of(part, "PartNumber"));
      d.line = line_of(part), d.streamer = kind == "Streamer";
      d.diameter = number(part, "Diameter", "m", 0.005, 100);
      d.drag_coefficient = number(part, "DragCoefficient", "", 0.01, 20);
      d.sides = count(part, "Sides"), d.line_count = count(part, "LineCount");
      d.line_length = number(part, "LineLength", "m", 0, 1000);
      d.mass = number(part, "Mass", "kg", 0, 1e6);
      d.cloth = text_of(part, "Material"), d.line_material = text_of(part, "LineMaterial");
      d.cloth_density = density_of(root, d.cloth, "SURFACE", "kg/m2");
      d.line_density = density_of(root, d.line_material, "LINE", "kg/m");
      file_.devices.push_back(std::move(d));
    }
  }
  std::optional<double> density_of(const pugi::xml_node& root, const std::string& name, std::string_view type,
                                   const std::string& unit) const {
    for (const pugi::xml_node material : root.child("Materials").children("Material")) {
      if (text_of(material, "Name") != name || text_of(material, "Type") != type) continue;
      const pugi::xml_node density = material.child("Density");
      const std::string own = trimmed(material.attribute("UnitsOfMeasure").value());
      return value_of(density, trimmed(density.text().get()), own.empty() ? unit : own, unit, 1e-6, 100);
    }
    return {};
  }

  const std::filesystem::path& path_;
  std::string text_;
  OpenRocketFile file_;
};

}  // namespace

OpenRocketFile read_openrocket(const std::filesystem::path& path) {
  return OpenRocketReader(path).run();
}

}  // namespace ripstop::inline cases
