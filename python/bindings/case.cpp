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
    throw py::value_error("a case has tables and lists within each other " + std::to_string(deepest) +
                          " deep at most; does a dictionary or list contain itself?");
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

void parse(PyCase& made) {
  Overrides overrides;
  overrides.set = made.set;
  made.given = parse_case(made.text, made.name, overrides);
  made.given.file = made.file;
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
  made.name = "from_dict";
  add_settings(tables, "", made.set, "from_dict");
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
      "What a case file says: a parachute, its materials, the air and how to compute.\n\n"
      "Keys are those of the case file (docs/guide/case-file.md); units are in their names.\n"
      "A case is whole at any time: what is wrong with it raises InputError.");
  type.def_static("read", &read, py::arg("file"), py::kw_only(), py::arg("set") = py::dict(),
                  "Reads a case file (TOML). set: keys to put in place of the file's, as --set does:\n"
                  "{\"flow.speed_m_s\": 20}; None removes a key or a table. Raises InputError with every "
                  "mistake, Error where it cannot be read.");
  type.def_static("from_toml", &from_toml, py::arg("text"), py::arg("name") = "case", py::kw_only(),
                  py::arg("set") = py::dict(), "The same from text; name stands for the file in messages.");
  type.def_static(
      "from_dict", &from_dict, py::arg("tables"),
      "A case made in code: {\"flow\": {\"speed_m_s\": 20}, ...}; keys may be full names with dots.");
  type.def(
      "set",
      [](PyCase& self, const std::string& key, const py::object& value) {
        py::dict one;
        one[py::str(key)] = value;
        set_keys(self, one);
      },
      py::arg("key"), py::arg("value"),
      "Sets one key, as --set does. Raises InputError, and leaves the case as it was, for what is wrong.");
  type.def("update", &set_keys, py::arg("keys"), "Sets several keys at once: {\"flow.speed_m_s\": 20, ...}.");
  type.def("get", &value_of, py::arg("key"),
           "The value of a key, or of a table of keys, with every default filled in. Raises KeyError.");
  type.def(
      "to_toml", [](const PyCase& self) { return case_toml(self.settings()); },
      "The case with every default and material written out: what ripstop check --resolved prints.");
  type.def(
      "asdict", [](const PyCase& self) -> py::dict { return plain_of(case_json(self.settings())); },
      "The same as plain dictionaries.");
  type.def(
      "copy", [](const PyCase& self) { return self; }, "A case that can be changed by itself.");
  type.def("__copy__", [](const PyCase& self) { return self; });
  type.def(
      "__deepcopy__", [](const PyCase& self, const py::object&) { return self; }, py::arg("memo"));
  type.def_property_readonly(
      "title", [](const PyCase& self) { return self.given.title; }, "The case's title.");
  type.def_property_readonly(
      "file", [](const PyCase& self) { return self.file.string(); },
      "The file that it was read from; empty: none.");
  type.def("__repr__", [](const PyCase& self) {
    return "<ripstop.Case " + py::repr(py::str(self.given.title)).cast<std::string>() + ">";
  });
  type.def(py::pickle(
      [](const PyCase& self) {
        py::list set;
        for (const Setting& s : self.set) set.append(py::make_tuple(s.key, s.value, s.option));
        return py::make_tuple(self.text, self.name, self.file.string(), set);
      },
      [](const py::tuple& state) {
        PyCase made;
        made.text = state[0].cast<std::string>();
        made.name = state[1].cast<std::string>();
        made.file = state[2].cast<std::string>();
        for (const py::handle item : state[3].cast<py::list>()) {
          const auto part = item.cast<std::tuple<std::string, std::string, std::string>>();
          made.set.push_back(
              {std::get<0>(part), std::get<1>(part), std::get<2>(part), std::get<1>(part).empty()});
        }
        parse(made);
        return made;
      }));
  module.def("read_case", &read, py::arg("file"), py::kw_only(), py::arg("set") = py::dict(),
             "Case.read(): reads a case file (TOML), with keys set in place of the file's.");
}

}  // namespace ripstop::python
