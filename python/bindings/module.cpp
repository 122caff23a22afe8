// Python module `_ripstop`: the functions of run/ and their results. Users import the package `ripstop`.
#include "module.h"

#include "members.h"
#include "ripstop/core/build_info.h"

namespace ripstop::python {

py::str text_of(py::handle object) {
  const py::handle type = py::type::handle_of(object);
  std::string text = type.attr("__name__").cast<std::string>() + "(";
  const char* between = "";
  for (const py::handle name : type.attr("__match_args__")) {
    const py::object value = object.attr(name);
    const bool array = py::isinstance<py::array>(value), list = py::isinstance<py::list>(value);
    const std::string shown = (array || list) && py::len(value) > 3 ? (array ? "<array of " : "<list of ") +
                                                                          std::to_string(py::len(value)) + ">"
                                                                    : py::repr(value).cast<std::string>();
    text += between + name.cast<std::string>() + "=" + shown;
    between = ", ";
  }
  return text + ")";
}

py::object plain_of(const std::string& json) {
  return py::module_::import("json").attr("loads")(json);
}

/// An object without a constructor has no data, and its attributes would be those of unrelated memory.
void refuse_new(const py::module_& module) {
  for (const auto& [name, member] : module.attr("__dict__").cast<py::dict>()) {
    if (!PyType_Check(member.ptr()) || PyObject_IsSubclass(member.ptr(), PyExc_BaseException) != 0) continue;
    const auto text = name.cast<std::string>() + " objects are results of the functions of ripstop";
    const py::cpp_function refuse(
        [text](const py::args&, const py::kwargs&) -> py::object { throw py::type_error(text); });
    py::setattr(member, "__new__", py::module_::import("builtins").attr("staticmethod")(refuse));
  }
}

void Listener::listen() {
  constexpr std::chrono::milliseconds often{50};  // functions that a user calls directly
  const Clock::time_point now = Clock::now();
  if (now - last_ < often) return;
  last_ = now;
  const py::gil_scoped_acquire lock;
  check_signals();
}

void Listener::check_signals() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace ripstop::python

PYBIND11_MODULE(_ripstop, module) {
  using namespace ripstop::python;  // NOLINT: the macro makes a function of its own
  module.doc() = "Python bindings of the library. Import the package `ripstop` instead.";
  module.attr("__version__") = ripstop::version();
  const py::object own_name = module.attr("__name__");
  module.attr("__name__") = "ripstop";  // where users find the classes
  add_errors(module);
  add_case(module);
  add_check(module);
  add_mesh(module);
  add_steady(module);
  add_stability(module);
  add_inflate(module);
  add_fly(module);
  add_calibrate(module);
  add_materials(module);
  add_fit(module);
  add_pattern(module);
  add_load(module);
  add_recovery(module);
  add_size(module);  // has the load's stages
  add_flight(module);
  add_fabric(module);
  add_sweep(module);
  add_report(module);
  add_engines(module);
  refuse_new(module);
  module.attr("__name__") = own_name;
}
