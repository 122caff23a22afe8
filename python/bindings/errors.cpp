// Error and InputError as exceptions with the text that the program prints.
#include <pybind11/stl.h>

#include "members.h"
#include "module.h"
#include "ripstop/case/quantity_keys.h"
#include "ripstop/core/error.h"
#include "ripstop/run/sizing/check.h"

namespace ripstop::python {
namespace {

py::handle make_exception(py::module_& module, const char* name, py::handle base, const char* doc) {
  const std::string full = std::string("ripstop.") + name;
  PyObject* type = PyErr_NewExceptionWithDoc(full.c_str(), doc, base.ptr(), nullptr);
  if (!type) throw py::error_already_set();
  module.add_object(name, type);
  return type;
}

void raise(py::handle type, const Error& error, const py::list& problems) {
  py::object exception = type(message_of(error));
  exception.attr("exit_code") = static_cast<int>(error.code());
  if (!problems.empty()) exception.attr("problems") = problems;
  PyErr_SetObject(type.ptr(), exception.ptr());
}

}  // namespace

void add_errors(py::module_& module) {
  add_class<Problem>(module, "Problem",
                     "One mistake in an input: its place, key, value and the allowed values.")
      .def("__str__", [](const Problem& problem) { return to_text(problem); });
  // The module is never unloaded, nor are its types.
  static const py::handle plain =
      make_exception(module, "Error", PyExc_Exception,
                     "Error of Ripstop, with the message that the program prints.\n\nexit_code: exit status "
                     "of the program: 2 usage or case file, 3 bad input data,\n"
                     "4 not converged, 5 diverged, 6 external solver, 7 input/output,\n"
                     "8 not enough memory or threads.");
  static const py::handle input = make_exception(
      module, "InputError", plain,
      "All mistakes in an input file or a setting, one per line.\n\nproblems: list of Problem.");
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const InputError& error) {
      py::list problems;
      for (const Problem& problem : error.problems()) problems.append(py::cast(problem));
      raise(input, error, problems);
    } catch (const Error& error) {
      raise(plain, error, py::list());
    }
  });
}

}  // namespace ripstop::python
