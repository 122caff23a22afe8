// A case in Python: read, made from text or a dictionary, its keys set as --set does.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "members.h"
#include "module.h"
#include "ripstop/core/toml/document.h"

namespace ripstop::python {
namespace {

/// Of tables and lists in each other; a dictionary that contains itself has no end.
constexpr int deepest = 32;

void require_depth(int depth) {
  if (depth > deepest)
    throw py::value_error("tables and lists of a case can be nested " + std::to_string(deepest) +
                          " levels deep at most; check that no dictionary or list contains itself");
}

std::string toml_of(py::handle value, int depth);

std::string toml_text(const std::string& text) {
  return py::module_::import("json")
      .attr("dumps")(text)
      .cast<std::string>();  // TOML's basic strings are JSON's
}

std::string toml_list(py::handle items, int depth) {
  std::string text = "[";
  for (const py::handle item : items) text += (text.size() > 1 ? ", " : "") + toml_of(item, depth);
  return text + "]";
}

std::string toml_table(const py::dict& table, int depth) {
  std::string text = "{";
  for (const auto& [key, value] : table)
    text += (text.size() > 1 ? ", " : "") + toml_text(py::str(key)) + " = " + toml_of(value, depth);
  return text + "}";
}

/// A value as a case file has it; numbers of NumPy are numbers, its arrays lists.
std::string toml_of(py::handle value, int depth) {
  require_depth(depth);
  if (py::hasattr(value, "tolist")) return toml_of(value.attr("tolist")(), depth + 1);
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::int_>(value) || py::isinstance<py::float_>(value)) return py::str(value);
  if (py::isinstance<py::str>(value)) return toml_text(value.cast<std::string>());
  if (py::isinstance<py::dict>(value)) return toml_table(py::reinterpret_borrow<py::dict>(value), depth + 1);
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) return toml_list(value, depth + 1);
  throw py::type_error("a value of a case is a number, a text, True or False, or a list of such, not " +
                       py::repr(value).cast<std::string>());
}

/// Dots within part the names of tables, as in flow.speed_m_s. None removes a key or a table.
void add_settings(const py::dict& keys, const std::string& above, std::vector<Setting>& all,
                  const char* option = "set", int depth = 0) {
  require_depth(depth);
  for (const auto& [key, value] : keys) {
    const std::string name = above + py::str(key).cast<std::string>();
    if (py::isinstance<py::dict>(value))
      add_settings(py::reinterpret_borrow<py::dict>(value), name + ".", all, option, depth + 1);
    else if (value.is_none())
      all.push_back({name, "", option, true});
    else
      all.push_back({name, toml_of(value, depth), option});
  }
}

constexpr const char* from_dictionary = "from_dict";

void parse(PyCase& made) {
  Overrides overrides;
  overrides.set = made.set;
  made.given = parse_case(made.text, made.name, overrides);
  made.given.file = made.file;
  for (auto& [key, origin] : made.given.origins)  // a dictionary is a whole case, not a change of one
    if (origin.option == from_dictionary) origin = {from_dictionary, 0, 0, ""};
  for (const std::string& text : made.given.deprecations)
    if (PyErr_WarnEx(PyExc_DeprecationWarning, text.c_str(), 1) != 0) throw py::error_already_set();
}

PyCase from_toml(const std::string& text, const std::string& name, const py::dict& set) {
  PyCase made;
  made.text = text;
  made.name = name;
  add_settings(set, "", made.set);
  parse(made);
  return made;
}

PyCase from_dict(const py::dict& tables) {
  PyCase made;
  made.name = from_dictionary;
  add_settings(tables, "", made.set, from_dictionary);
  parse(made);
  return made;
}

PyCase read(const Path& file, const py::dict& set) {
  PyCase made;
  made.text = read_text_file(file);
  made.name = file.string();
  made.file = file;
  add_settings(set, "", made.set);
  parse(made);
  return made;
}

void set_keys(PyCase& self, const py::dict& keys) {
  PyCase changed = self;
  add_settings(keys, "", changed.set);
  parse(changed);
  self = std::move(changed);
}

py::object value_of(const PyCase& self, const std::string& key) {
  py::object value = plain_of(case_json(self.settings()));
  std::size_t at = 0;
  do {
    const std::size_t end = std::min(key.find('.', at), key.size());
    value = value[py::str(key.substr(at, end - at))];
    at = end + 1;
  } while (at <= key.size());
  return value;
}

}  // namespace

Setting setting_of(const std::string& key, py::handle value) {
  return {key, toml_of(value, 0), key};
}

PyCase::PyCase(const Case& made)
    : given(made), text(case_toml(resolve(made))), name(made.file.string()), file(made.file) {}

void add_case(py::module_& module) {
  py::class_<PyCase> type(
      module, "Case",
      "Content of a case file: parachute, materials, air and settings of the computation.\n\nKeys are those "
      "of the case file (docs/guide/case-file.md); their names contain units.\nA case is valid at any time: "
      "an invalid change raises InputError.");
  type.def_static("read", &read, py::arg("file"), py::kw_only(), py::arg("set") = py::dict(),
                  "Reads a case file (TOML). set: keys that replace those of the file, as --set "
                  "does:\n{\"flow.speed_m_s\": 20}; None removes a key or a table. Raises InputError with "
                  "all mistakes, or Error if the file cannot be read.");
  type.def_static("from_toml", &from_toml, py::arg("text"), py::arg("name") = "case", py::kw_only(),
                  py::arg("set") = py::dict(),
                  "Reads a case from text. Messages use `name` as the file name.");
  type.def_static("from_dict", &from_dict, py::arg("tables"),
                  "Makes a case from dictionaries: {\"flow\": {\"speed_m_s\": 20}, ...}. Keys can be full "
                  "names with dots.");
  type.def(
      "set",
      [](PyCase& self, const std::string& key, const py::object& value) {
        py::dict one;
        one[py::str(key)] = value;
        set_keys(self, one);
      },
      py::arg("key"), py::arg("value"),
      "Sets one key, as --set does. An invalid value raises InputError and does not change the case.");
  type.def("update", &set_keys, py::arg("keys"), "Sets several keys at once: {\"flow.speed_m_s\": 20, ...}.");
  type.def("get", &value_of, py::arg("key"),
           "Returns the value of a key or a table, with all defaults filled in. Raises KeyError.");
  type.def(
      "to_toml", [](const PyCase& self) { return case_toml(self.settings()); },
      "Returns the case with all defaults and materials filled in, as printed by ripstop check --resolved.");
  type.def(
      "asdict", [](const PyCase& self) -> py::dict { return plain_of(case_json(self.settings())); },
      "Returns the content as plain dictionaries.");
  type.def(
      "copy", [](const PyCase& self) { return self; }, "Returns an independent copy.");
  type.def("__copy__", [](const PyCase& self) { return self; });
  type.def(
      "__deepcopy__", [](const PyCase& self, const py::object&) { return self; }, py::arg("memo"));
  type.def_property_readonly(
      "title", [](const PyCase& self) { return self.given.title; }, "Title of the case.");
  type.def_property_readonly(
      "file", [](const PyCase& self) { return self.file.string(); },
      "File from which the case was read; empty: none.");
  type.def("__repr__", [](const PyCase& self) {
    return "<ripstop.Case " + py::repr(py::str(self.given.title)).cast<std::string>() + ">";
  });
  // For pickle, which would otherwise call __new__.
  type.def("__reduce__", [](const py::object& self) {
    const auto& given = self.cast<const PyCase&>();
    py::list set;
    for (const Setting& s : given.set) set.append(py::make_tuple(s.key, s.value, s.option));
    return py::make_tuple(py::module_::import("ripstop").attr("_restored_case"),
                          py::make_tuple(given.text, given.name, given.file.string(), set));
  });
  type.def_static("_restored", [](const std::string& text, const std::string& name, const std::string& file,
                                  const std::vector<std::tuple<std::string, std::string, std::string>>& set) {
    PyCase made;
    made.text = text;
    made.name = name;
    made.file = file;
    for (const auto& [key, value, option] : set) made.set.push_back({key, value, option, value.empty()});
    parse(made);
    return made;
  });
  module.def("read_case", &read, py::arg("file"), py::kw_only(), py::arg("set") = py::dict(),
             "Reads a case file (TOML), as Case.read() does. Keys in `set` replace those of the file.");
}

}  // namespace ripstop::python
