// fabric(): the cloth of a case under a given pressure, without a flow.
#include "ripstop/run/sizing/fabric.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "members.h"
#include "module.h"
#include "notebook.h"
#include "ripstop/core/claimed_folder.h"
#include "runs.h"

namespace ripstop::python {
namespace {

struct PyFabric {
  PyCase made;
  FabricSolution solution;
  std::vector<Cell> cells;
  Path folder;  // without a report
};

std::unique_ptr<PyFabric> fabric(const PyCase& given, std::optional<double> pressure,
                                 const std::optional<Path>& out, const OptionalMesh& mesh) {
  Listener listener(py::none{});
  const std::shared_ptr<const CanopyMesh> own = own_mesh(mesh, false);
  const py::gil_scoped_release release;
  if (out) make_results_folder(*out, "fabric");
  auto made = std::make_unique<PyFabric>();
  made->made = given;
  made->solution = run_fabric(
      given.settings(), pressure, [&](const RelaxProgress&) { listener.listen(); }, own.get());
  made->cells = cells_of(made->solution.mesh);
  if (out) write_fabric(*out, made->solution);
  return made;
}

const PyFabric& fabric_of(const py::object& self) {
  return self.cast<const PyFabric&>();
}

}  // namespace

void add_fabric(py::module_& module) {
  py::class_<PyFabric> type(module, "Fabric",
                            "Result of a uniform pressure: the values of result.json, and arrays.");
  const auto result = [](const PyFabric& f) -> const FabricResult& { return f.solution.result; };
  add_members(type, result);
  add_json(type, result);
  add_page(type, [](const PyFabric& f) {
    ReportRun shown = memory_report("fabric", to_json(f.solution.result), f.made.settings());
    shown.shape = shape_of(fabric_canopy(f.solution), fabric_lines(f.solution));
    shown.shape.part_names = f.solution.mesh.parts;
    return shown;
  });
  type.def_property_readonly(
      "shape", [](const py::object& self) { return view_of(fabric_of(self).solution.shape, self); },
      "Position of every node of the parachute: x, y, z; z is downstream [m]");
  type.def_property_readonly(
      "cells", [](const py::object& self) { return view_of_cells(fabric_of(self).cells, self); },
      "Nodes at the four corners of every cloth cell; the first is -1 for a missing cell.");
  type.def_property_readonly(
      "stress", [](const py::object& self) { return table_of(fabric_of(self).solution.stress, self); },
      "Stress of every cloth cell: columns in [N/m], max_strain without unit.");
  module.def("fabric", &fabric, py::arg("case"), py::kw_only(), py::arg("pressure_pa") = py::none(),
             py::arg("out") = py::none(), py::arg("mesh") = py::none(),
             "Computes the shape under a uniform pressure, without a flow: ripstop fabric.\n\n"
             "pressure_pa: uniform pressure difference [Pa]. None: the dynamic pressure of the case.\n"
             "out: a folder for result.json, a picture and files for ParaView. None: nothing is written.\n"
             "mesh: a Mesh in place of the canopy of the case.\n\n"
             "A result that is not converged is also returned: check `converged`.");
}

}  // namespace ripstop::python
