#include "ripstop/case/chute_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "ripstop/core/error.h"
#include "ripstop/core/expression.h"
#include "ripstop/core/toml/read.h"

namespace ripstop::inline cases {
namespace {

using Json = nlohmann::json;
using std::numbers::pi;
using Names = std::map<std::string, double>;

/// A value of the file with its place, for messages.
struct Entry {
  const Json* json;
  std::string place;
  const std::string* file;

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ExitCode::bad_data, fmt::format("{}: {}: {}", *file, place.empty() ? "file" : place, what));
  }
  bool has(const std::string& key) const { return json->is_object() && json->contains(key); }
  Entry at(const std::string& key) const {
    if (!json->is_object()) fail("must be an object {...}");
    if (!json->contains(key)) fail(fmt::format("the key \"{}\" is missing", key));
    return {&json->at(key), place.empty() ? key : place + "." + key, file};
  }
  std::vector<Entry> items() const {
    if (!json->is_array()) fail("must be a list [...]");
    std::vector<Entry> all;
    for (std::size_t i = 0; i < json->size(); ++i)
      all.push_back({&(*json)[i], fmt::format("{}[{}]", place, i), file});
    return all;
  }
  std::vector<Entry> items(std::size_t count) const {
    std::vector<Entry> all = items();
    if (all.size() != count) fail(fmt::format("must be a list of {} values, not {}", count, all.size()));
    return all;
  }
  double number() const {
    if (!json->is_number() || !std::isfinite(json->get<double>())) fail("must be a number");
    return json->get<double>();
  }
  int count() const {
    if (!json->is_number_integer() || json->get<double>() < 0 || json->get<double>() > 500)
      fail("must be a whole number from 0 to 500");
    return json->get<int>();
  }
  std::string text() const {
    if (!json->is_string()) fail("must be a text");
    return json->get<std::string>();
  }
};

class Reader {
 public:
  Reader(const Entry& root) : root_(root) {}

  ChuteFile read() {
    known(root_,
          {"name", "gores", "diameter", "fabric", "instructions", "use_global_seam_allowance",
           "global_seam_allowance", "test_color", "input_values", "parameter_values", "chute_sections"});
    file_.name = root_.at("name").text();
    if (root_.has("instructions"))
      for (const Entry& step : root_.at("instructions").items()) file_.instructions.push_back(step.text());
    for (const char* key : {"gores", "diameter", "fabric"})
      if (root_.has(key))
        file_.not_mapped.push_back(
            fmt::format("{}: ignored, because openchute and Ripstop use the values of each section", key));
    if (root_.has("use_global_seam_allowance") && root_.at("use_global_seam_allowance").json->is_boolean() &&
        *root_.at("use_global_seam_allowance").json && root_.has("global_seam_allowance"))
      file_.not_mapped.push_back(
          fmt::format("global_seam_allowance = {} m: openchute cuts by the allowances of each section",
                      root_.at("global_seam_allowance").number()));
    read_names();
    for (const Entry& section : root_.at("chute_sections").items()) read_section(section);
    if (file_.sections.empty())
      root_.at("chute_sections").fail("there is no section with gores; the design needs at least one");
    return std::move(file_);
  }

 private:
  void known(const Entry& node, const std::set<std::string>& keys) {
    if (!node.json->is_object()) node.fail("must be an object {...}");
    for (const auto& [key, value] : node.json->items())
      if (!keys.contains(key))
        file_.not_mapped.push_back(
            fmt::format("{}{}{}: unknown key, ignored", node.place, node.place.empty() ? "" : ".", key));
  }

  double formula(const Entry& node) {
    const std::string text = node.text();
    try {
      const Evaluation result = evaluate(text, names_);
      for (const std::string& note : result.notes)
        file_.remarks.push_back(fmt::format("{} = {}: {}", node.place, quoted(text), note));
      return result.value;
    } catch (const Error& error) {
      node.fail(fmt::format("{}, {}", quoted(text), error.what()));
    }
  }

  /// The number that openchute wrote next to a formula when it last drew the section.
  void compare(const Entry& stored, double value) {
    if (!stored.json->is_number()) stored.fail("must be a number");
    const double before = stored.json->get<double>();
    if (std::abs(before - value) > 1e-6 * std::max(1.0, std::abs(value)))
      file_.remarks.push_back(
          fmt::format("{}: the file contains {:.9g}, its formula gives {:.9g}; the formula is used",
                      stored.place, before, value));
  }

  void define(const Entry& node, const std::string& id, double value) {
    const bool good = !id.empty() && std::isalpha(static_cast<unsigned char>(id[0])) &&
                      std::all_of(id.begin(), id.end(), [](char c) {
                        return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
                      });
    if (!good)
      node.fail(fmt::format("{} is not a valid name: use letters, digits and _, starting with a letter",
                            quoted(id)));
    if (!names_.emplace(id, value).second)
      node.fail(fmt::format("the name {} is used twice; units, pi and e are reserved", quoted(id)));
  }

  void read_names() {
    names_ = {{"m", 1},   {"mm", 0.001}, {"yd", 0.9144},         {"ft", 0.3048},   {"inch", 0.0254},
              {"rad", 1}, {"pi", pi},    {"e", std::numbers::e}, {"deg", pi / 180}};
    for (const Entry& input : root_.at("input_values").items()) {
      known(input, {"id", "description", "value", "unit", "range", "default_value"});
      const std::string id = input.at("id").text();
      const double value = input.at("value").number();  // SI whatever the unit: that is for display
      define(input.at("id"), id, value);
      file_.inputs.emplace_back(id, value);
    }
    const std::vector<Entry> parameters = root_.at("parameter_values").items();
    check_order(parameters);
    for (const Entry& parameter : parameters) {
      known(parameter, {"id", "expression", "display_unit"});
      const std::string id = parameter.at("id").text();
      const double value = formula(parameter.at("expression"));
      define(parameter.at("id"), id, value);
      file_.parameters.emplace_back(id, value);
    }
  }

  /// Formulas may refer only to parameters above them.
  void check_order(const std::vector<Entry>& parameters) {
    std::map<std::string, std::size_t> index;
    std::vector<std::vector<std::string>> uses;
    for (const Entry& parameter : parameters) {
      index.emplace(parameter.at("id").text(), uses.size());
      try {
        uses.push_back(names_in(parameter.at("expression").text()));
      } catch (const Error& error) {
        const Entry expression = parameter.at("expression");
        expression.fail(fmt::format("{}, {}", quoted(expression.text()), error.what()));
      }
    }
    std::vector<std::string> path;
    std::set<std::string> visited;
    const std::function<bool(const std::string&, const std::string&)> leads_to =
        [&](const std::string& from, const std::string& goal) {
          if (!index.contains(from) || !visited.insert(from).second) return false;
          path.push_back(from);
          for (const std::string& name : uses[index.at(from)])
            if (name == goal || leads_to(name, goal)) return true;
          path.pop_back();
          return false;
        };
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const std::string id = parameters[i].at("id").text();
      for (const std::string& name : uses[i]) {
        if (!index.contains(name) || index.at(name) < i || names_.contains(name)) continue;
        const Entry expression = parameters[i].at("expression");
        path = {id}, visited.clear();
        if (name == id) expression.fail(fmt::format("\"{}\" refers to itself", id));
        if (leads_to(name, id))
          expression.fail(
              fmt::format("circular reference of formulas: {} -> {}", fmt::join(path, " -> "), id));
        expression.fail(
            fmt::format("\"{}\" is defined only below, in parameter_values[{}]; openchute evaluates from the "
                        "top: move it up",
                        name, index.at(name)));
      }
    }
  }

  void read_section(const Entry& node) {
    known(node, {"section_type", "gores", "fabric", "seam_allowance", "corner_cutout", "colors",
                 "modifier_first", "modifier_last", "cuts", "fullness"});
    ChuteSection section;
    section.place = node.place;
    section.gores = node.at("gores").count();
    if (section.gores == 0) {  // how openchute draws a slot or a vent
      file_.not_mapped.push_back(
          fmt::format("{}: 0 gores: no cloth is cut; the section represents an opening", node.place));
      return;
    }
    const Entry type = node.at("section_type");
    known(type, {"Circular", "Polygonal"});
    if (type.has("Circular")) {
      section.circular = true;
      const Entry line = type.at("Circular");
      known(line, {"line", "expressions"});
      section.points = line_points(line);
    } else if (type.has("Polygonal")) {
      known(type.at("Polygonal"), {"objects"});
      for (const Entry& object : type.at("Polygonal").at("objects").items()) add_object(object, section);
    } else {
      type.fail("must be \"Circular\" or \"Polygonal\"");
    }
    finish(node, section);
    const Entry fabric = node.at("fabric").at("selected_fabric");
    section.fabric = fabric.at("name").text();
    section.areal_density = 1e-3 * fabric.at("area_density_gsm").number();
    if (!(section.areal_density > 0)) fabric.at("area_density_gsm").fail("must be above 0");
    const std::vector<Entry> allowance = node.at("seam_allowance").items(4);
    for (int i = 0; i < 4; ++i) section.seam_allowance[i] = allowance[i].number();
    read_extras(node, section);
    file_.sections.push_back(std::move(section));
  }

  void read_extras(const Entry& node, ChuteSection& section) {
    if (node.has("fullness")) {
      const std::vector<Entry> fullness = node.at("fullness").items(2);
      const double first = fullness[0].number(), last = fullness[1].number();
      if (first < 0) fullness[0].fail("fullness must be at least 0");
      if (last < 0) fullness[1].fail("fullness must be at least 0");
      if (section.circular && (first > 0 || last > 0)) {
        file_.not_mapped.push_back(node.place +
                                   ".fullness: openchute does not apply it to a circular section either");
      } else {
        section.first_fullness = first, section.last_fullness = last;
      }
    }
    for (const char* key : {"modifier_first", "modifier_last"}) {
      if (!node.has(key) || *node.at(key).json == "Nothing") continue;
      file_.not_mapped.push_back(fmt::format(
          "{}.{} = {}: not supported, because gores are symmetric and have straight edges; ignored",
          node.place, key, node.at(key).json->dump()));
    }
    if (node.has("cuts") && !node.at("cuts").items().empty())
      file_.not_mapped.push_back(
          fmt::format("{}.cuts: {} cut(s) across the gore: not supported; the gore is one piece", node.place,
                      node.at("cuts").items().size()));
    if (node.has("corner_cutout") && *node.at("corner_cutout").json == true)
      file_.not_mapped.push_back(node.place +
                                 ".corner_cutout: ripstop pattern mitres the corners of the allowances");
  }

  std::vector<MeridianPoint> line_points(const Entry& node) {
    const std::vector<Entry> formulas = node.at("expressions").items(4);
    double value[4];
    for (int i = 0; i < 4; ++i) value[i] = formula(formulas[i]);
    for (int i = 0; i < 4; ++i) {
      const Entry line = node.at("line");
      compare(line.at(i < 2 ? "begin" : "end").items(2)[i % 2], value[i]);
    }
    return {{value[0], value[1]}, {value[2], value[3]}};
  }

  // Angles in radians; the ellipse turned counterclockwise about its centre. As openchute has it: the start
  // angle, and a stop angle beyond a full turn, count modulo a full turn.
  std::vector<MeridianPoint> arc_points(const Entry& node) {
    known(node, {"ellipse", "start_angle", "stop_angle", "rotation", "radius_x", "radius_y", "center"});
    const Entry stored = node.at("ellipse");
    std::map<std::string, double> value;
    for (const char* key : {"start_angle", "stop_angle", "rotation", "radius_x", "radius_y"}) {
      value[key] = formula(node.at(key));
      compare(stored.at(key), value[key]);
    }
    const std::vector<Entry> center = node.at("center").items(2);
    const double x = formula(center[0]), y = formula(center[1]);
    compare(stored.at("center").items(2)[0], x);
    compare(stored.at("center").items(2)[1], y);
    const double start = std::fmod(value["start_angle"], 2 * pi);
    const double stop =
        value["stop_angle"] > 2 * pi ? std::fmod(value["stop_angle"], 2 * pi) : value["stop_angle"];
    if (start == stop) node.fail("the arc has no length: its two angles are equal");
    const double step = pi / 128;  // a chord is shorter than its arc by 2.5e-5
    const int pieces = std::max(4, static_cast<int>(std::ceil(std::abs(stop - start) / step)));
    const double c = std::cos(value["rotation"]), s = std::sin(value["rotation"]);
    std::vector<MeridianPoint> points;
    for (int i = 0; i <= pieces; ++i) {
      const double angle = start + (stop - start) * i / pieces;
      const double u = value["radius_x"] * std::cos(angle), v = value["radius_y"] * std::sin(angle);
      points.push_back({c * u - s * v + x, s * u + c * v + y});
    }
    return points;
  }

  std::vector<MeridianPoint> list_points(const Entry& node) {
    known(node, {"geo", "point_list", "scale_x", "scale_y", "offset", "scale_x_f", "scale_y_f", "offset_f"});
    const double scale_x = formula(node.at("scale_x")), scale_y = formula(node.at("scale_y"));
    const std::vector<Entry> offset = node.at("offset").items(2);
    const double dx = formula(offset[0]), dy = formula(offset[1]);
    std::vector<MeridianPoint> points;
    const std::string text = node.at("point_list").text();
    std::size_t begin = 0;
    for (int line = 1; begin <= text.size(); ++line) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      const std::string row = text.substr(begin, end - begin);
      begin = end + 1;
      if (row.find_first_not_of(" \t\r") == std::string::npos) continue;
      const std::size_t comma = row.find(',');
      try {
        if (comma == std::string::npos) throw Error(ExitCode::bad_data, "");
        points.push_back({scale_x * evaluate(row.substr(0, comma), {}).value + dx,
                          scale_y * evaluate(row.substr(comma + 1), {}).value + dy});
      } catch (const Error&) {
        node.at("point_list").fail(fmt::format("line {}: {} is not a point x,y", line, quoted(row)));
      }
    }
    return points;
  }

  void add_object(const Entry& node, ChuteSection& section) {
    known(node, {"Line", "EllipseArc", "PointList"});
    std::vector<MeridianPoint> points;
    if (node.has("Line")) {
      known(node.at("Line"), {"line", "expressions"});
      points = line_points(node.at("Line"));
    } else if (node.has("EllipseArc")) {
      points = arc_points(node.at("EllipseArc"));
    } else if (node.has("PointList")) {
      points = list_points(node.at("PointList"));
    } else {
      node.fail("must be \"Line\", \"EllipseArc\" or \"PointList\"");
    }
    if (!section.points.empty() && !points.empty()) {
      const MeridianPoint a = section.points.back(), b = points.front();
      if (std::hypot(a.r - b.r, a.y - b.y) > 1e-6)
        file_.remarks.push_back(
            fmt::format("{}: starts {:.3g} m from the end of the previous object; joined by a straight line, "
                        "as in openchute",
                        node.place, std::hypot(a.r - b.r, a.y - b.y)));
    }
    section.points.insert(section.points.end(), points.begin(), points.end());
  }

  /// Without points that repeat, which also end an arc on the axis a hair to its left.
  static void finish(const Entry& node, ChuteSection& section) {
    std::vector<MeridianPoint> kept;
    for (MeridianPoint p : section.points) {
      if (std::abs(p.r) < 1e-9) p.r = 0;
      if (p.r < 0)
        node.fail(fmt::format("the meridian crosses the axis: r = {:.6g} m at height {:.6g} m", p.r, p.y));
      if (std::abs(p.r) > 100 || std::abs(p.y) > 1000)
        node.fail(fmt::format(
            "the meridian reaches r = {:.6g} m, height {:.6g} m; the radius must be at most 100 m", p.r,
            p.y));
      if (kept.empty() || std::hypot(p.r - kept.back().r, p.y - kept.back().y) > 1e-7) kept.push_back(p);
    }
    if (kept.size() < 2) node.fail("the section has no length");
    section.points = std::move(kept);
  }

  Entry root_;
  ChuteFile file_;
  Names names_;
};

/// JSON whose objects have every key once: of two, a reader takes the one and another program the other.
Json parsed(std::string_view text, const std::string& file) {
  constexpr int deepest = 64;
  std::vector<std::set<std::string>> keys;
  const auto look = [&](int depth, Json::parse_event_t event, Json& value) {
    if (depth > deepest)
      throw Error(ExitCode::bad_data,
                  fmt::format("{}: nested more than {} deep; is this a .chute file?", file, deepest));
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second)
      throw Error(ExitCode::bad_data, fmt::format("{}: the key {} occurs twice in one object", file,
                                                  quoted(value.get<std::string>())));
    return true;
  };
  return Json::parse(text, look);
}

}  // namespace

ChuteFile read_chute(std::string_view text, const std::string& file) {
  if (text.size() > 16'000'000)
    throw Error(ExitCode::bad_data, fmt::format("{}: larger than 16 MB; is this a .chute file?", file));
  Json json;
  try {
    json = parsed(text, file);
  } catch (const Json::exception& error) {
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    if (!file.ends_with(".chute") && (begin == std::string_view::npos || text[begin] != '{'))
      throw Error(
          ExitCode::bad_data,
          fmt::format("{}: is not an openchute design (.chute, JSON) nor an OpenRocket file (.ork, .orc)",
                      file));
    throw Error(ExitCode::bad_data, fmt::format("{}: not JSON: {}", file, error.what()));
  }
  return Reader({&json, "", &file}).read();
}

}  // namespace ripstop::inline cases
