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
  add_class<PartMasses>(module, "PartMasses", "Masses of a parachute's parts [kg].");
  py::class_<CheckResult> type(module, "Check",
                               "What a case amounts to without a solver: areas, masses, mesh, time step.");
  add_members(type, [](const CheckResult& r) -> const CaseSummary& { return r.summary; });
  add_json(type, [](const CheckResult& r) -> const CheckResult& { return r; });
  type.def_property_readonly(
      "sources", [](const CheckResult& r) -> py::list { return plain_of(to_json(r))["sources"]; },
      "Of every key whose value follows from others where it is not given: key, value, unit, given,\n"
      "from.");
  type.def_property_readonly(
      "warnings", [](const CheckResult& r) { return r.warnings; },
      "What is not wrong with the case but should be known.");
  module.def("check", &check, py::arg("case"),
             "Everything about a case that can be said without a solver: what ripstop check tells.\n"
             "Areas in [m2], masses in [kg], the stable time step in [s].");
}

}  // namespace ripstop::python
