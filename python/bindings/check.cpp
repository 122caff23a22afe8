// check(): everything about a case that can be said without a solver.
#include "ripstop/run/sizing/check.h"

#include "members.h"
#include "module.h"

namespace ripstop::python {
namespace {

CheckResult check(PyCase given) {
  const py::gil_scoped_release release;
  return run_check(given.settings());
}

}  // namespace

void add_check(py::module_& module) {
  add_class<PartMasses>(module, "PartMasses", "Masses of the parts of a parachute [kg].");
  py::class_<CheckResult> type(module, "Check",
                               "Properties of a case that need no solver: areas, masses, mesh, time step.");
  add_members(type, [](const CheckResult& r) -> const CaseSummary& { return r.summary; });
  add_json(type, [](const CheckResult& r) -> const CheckResult& { return r; });
  type.def_property_readonly(
      "sources", [](const CheckResult& r) -> py::list { return plain_of(to_json(r))["sources"]; },
      "Origin of every key with a computed default: key, value, unit, given, from.");
  type.def_property_readonly(
      "warnings", [](const CheckResult& r) { return r.warnings; }, "Warnings about the case.");
  module.def("check", &check, py::arg("case"),
             "Checks a case without running a solver: ripstop check. Areas in [m2], masses in [kg],\nstable "
             "time step in [s].");
}

}  // namespace ripstop::python
