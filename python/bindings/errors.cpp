// Error and InputError as exceptions with the text that the program prints.
#include <pybind11/stl.h>

#include <algorithm>
#include <map>
#include <regex>
#include <string>

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

/// The argument of the functions that does the same as an option of the program.
std::string argument_of(std::string option) {
  static const std::map<std::string, std::string> others = {
      {"fresh", "fresh=True"},     {"verify", "verify=True"},
      {"fly", "fly=True"},         {"pressure", "pressure_pa"},
      {"speed", "speed_m_s"},      {"height", "height_m"},
      {"mass", "payload_mass_kg"}, {"measured-load", "measured_load_n"}};
  const auto other = others.find(option);
  if (other != others.end()) return other->second;
  std::replace(option.begin(), option.end(), '-', '_');
  return option;
}

/// A message with options as arguments: "--out" is `out`. Commands such as "ripstop steady CASE --out DIR" remain.
std::string in_python(const std::string& message) {
  static const std::regex parts(R"((ripstop [a-z-]+[^;,]*)|(^|[^\w-])--([a-z][a-z-]*[a-z])( [A-Z]{2,}\b)?)");
  constexpr std::size_t longest = 10000;  // the search is recursive
  if (message.size() > longest) return message;
  std::string text;
  auto from = message.begin();
  for (std::sregex_iterator i(message.begin(), message.end(), parts), end; i != end; ++i) {
    const std::smatch& found = *i;
    text.append(from, found[0].first);
    text += found[1].matched ? found[1].str() : found[2].str() + argument_of(found[3]);
    from = found[0].second;
  }
  return text.append(from, message.end());
}

void raise(py::handle type, const Error& error, const py::list& problems) {
  py::object exception = type(in_python(message_of(error)));
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
  static const py::handle plain = make_exception(
      module, "Error", PyExc_Exception,
      "Error of Ripstop, with the message that the program prints.\n\nexit_code: exit status "
      "of the program: 2 usage or case file, 3 bad input data,\n"
      "4 not converged, or outside a limit of quality, 5 diverged, 6 external solver, 7 input/output,\n"
      "8 insufficient memory or threads.");
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
