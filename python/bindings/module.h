// The parts of the module `_ripstop`, each in its own file, and their common functions.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "ripstop/case/settings.h"

namespace ripstop::python {

namespace py = pybind11;

void add_errors(py::module_& module);
void add_case(py::module_& module);
void add_check(py::module_& module);
void add_steady(py::module_& module);
void add_stability(py::module_& module);
void add_inflate(py::module_& module);
void add_fly(py::module_& module);
void add_calibrate(py::module_& module);
void add_materials(py::module_& module);
void add_fit(py::module_& module);
void add_pattern(py::module_& module);
void add_size(py::module_& module);
void add_load(py::module_& module);
void add_recovery(py::module_& module);
void add_flight(py::module_& module);
/// Before the functions that take one.
void add_mesh(py::module_& module);
void add_fabric(py::module_& module);
void add_sweep(py::module_& module);
void add_report(py::module_& module);
void add_engines(py::module_& module);
/// Lets __new__ of every class raise TypeError.
void refuse_new(const py::module_& module);

/// A case with the text that it was read from, so that any key can be set anew as --set does.
struct PyCase {
  Case given;
  std::string text, name;      // TOML, and the name of the file in messages
  std::filesystem::path file;  // empty: not from a file
  std::vector<Setting> set;

  PyCase() = default;
  /// Of a case that the library made.
  explicit PyCase(const Case& made);

  Settings settings() const { return resolve(given); }
};

/// A value of Python as a setting of a key. Throws TypeError.
Setting setting_of(const std::string& key, pybind11::handle value);

using Path = std::filesystem::path;

inline bool is_callback(PyObject* object) {
  return object == Py_None || PyCallable_Check(object) != 0;
}
/// None, or a function that is called with a copy of every `Progress`.
template <class Progress>
class Callback : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(Callback, py::object, is_callback)
};

/// While the library computes on this thread without the interpreter's lock: Ctrl-C, and calls of Python.
class Listener {
 public:
  /// `callback`: a Callback. Made and destroyed under the lock.
  explicit Listener(py::object callback) : callback_(std::move(callback)) {}
  /// Checks for signals at intervals; throws the exceptions of their handlers, such as KeyboardInterrupt.
  void listen();
  /// Calls back with a copy of `progress`; throws the exceptions of the callback.
  template <class Progress>
  void tell(const Progress& progress) {
    const py::gil_scoped_acquire lock;
    if (!callback_.is_none()) callback_(py::cast(progress, py::return_value_policy::copy));
    check_signals();
  }

 private:
  void check_signals();
  using Clock = std::chrono::steady_clock;
  py::object callback_;
  Clock::time_point last_ = Clock::now();
};

}  // namespace ripstop::python

/// In signatures and stubs.
template <class Progress>
struct pybind11::detail::handle_type_name<ripstop::python::Callback<Progress>> {
  static constexpr auto name =
      const_name("Optional[Callable[[") + make_caster<Progress>::name + const_name("], Any]]");
};
