// Mesh: a canopy that is put together in Python, for fabric() and steady().
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "module.h"
#include "ripstop/core/error.h"
#include "ripstop/parachute/build.h"
#include "runs.h"

namespace ripstop::python {

std::shared_ptr<const CanopyMesh> own_mesh(const OptionalMesh& given, bool in_folder) {
  if (!given) return nullptr;
  if (in_folder)
    throw Error(ExitCode::usage,
                "mesh: a run folder has no mesh of your own and could not be resumed; leave out `out`");
  return std::make_shared<const CanopyMesh>(given->get().own.mesh());
}

void refuse_own_mesh(const PySteady& run) {
  if (run.own_mesh)
    throw Error(ExitCode::usage,
                "the run has a mesh of your own, whose mass and sizes are not those of its case; name a run "
                "without `mesh`");
}

namespace {

using Points = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Numbers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

std::vector<Vec3> points_of(const Points& given, py::ssize_t dimensions, const char* shape) {
  if (given.ndim() != dimensions || given.shape(dimensions - 1) != 3)
    throw py::value_error(std::string("points are an array ") + shape);
  const auto* first = reinterpret_cast<const Vec3*>(given.data());
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return {first, first + given.size() / 3};
}

/// One node, or an array of any shape.
std::vector<int> nodes_of(const py::object& given) {
  const auto any = py::array::ensure(given);
  if (!any) PyErr_Clear();
  if (!any || (any.dtype().kind() != 'i' && any.dtype().kind() != 'u'))  // a fraction would be cut off
    throw py::type_error("nodes are whole numbers, or arrays of them");
  const auto numbers = Numbers::ensure(any);
  if (!numbers) throw py::error_already_set();
  std::vector<int> nodes;
  for (py::ssize_t i = 0; i < numbers.size(); ++i) {
    const std::int64_t node = numbers.data()[i];
    if (node < 0 || node > std::numeric_limits<int>::max())
      throw py::value_error("there is no node " + std::to_string(node));
    nodes.push_back(static_cast<int>(node));
  }
  return nodes;
}

/// first, first + 1, ... in the shape.
py::array numbered(int first, std::vector<py::ssize_t> shape) {
  Numbers numbers(std::move(shape));
  std::iota(numbers.mutable_data(), numbers.mutable_data() + numbers.size(), std::int64_t{first});
  return numbers;
}

py::array add_cloth(PyMesh& self, const std::string& name, const Points& points,
                    const std::optional<Points>& flat, bool closed) {
  ClothLattice lattice;
  lattice.points = points_of(points, 3, "(rows, columns, 3)");
  lattice.rows = static_cast<int>(points.shape(0));
  lattice.columns = static_cast<int>(points.shape(1));
  lattice.closed = closed;
  if (flat) {
    lattice.flat = points_of(*flat, 3, "(rows, columns, 3), also as cut");
    if (flat->shape(0) != points.shape(0) || flat->shape(1) != points.shape(1) + (closed ? 1 : 0))
      throw py::value_error("`flat` has as many rows and columns as `points`, and one column more if closed");
  }
  return numbered(self.own.add_cloth(name, lattice), {points.shape(0), points.shape(1)});
}

using Lengths = std::optional<std::vector<double>>;

void add_methods(py::class_<PyMesh>& type) {
  type.def(
      "add_cloth", &add_cloth, py::arg("name"), py::arg("points"), py::kw_only(),
      py::arg("flat") = py::none(), py::arg("closed") = false,
      "Adds a lattice of canopy cloth and returns its node numbers, (rows, columns).\n\npoints: positions "
      "at the start, (rows, columns, 3) [m]. Warp runs from row to row. The outward normal is\n  (direction "
      "to the next column) x (direction to the next row); a positive pressure acts on the inner side.\nflat: "
      "points of the flat pattern of the cloth as cut, (rows, columns, 3) [m]; with `closed` one more "
      "column.\n  None: the cloth is unstretched at the start.\nclosed: whether the first column follows the "
      "last one.");
  type.def(
      "add_nodes",
      [](PyMesh& self, const Points& points) {
        const int first = self.own.add_nodes(points_of(points, 2, "(n, 3)"));
        return numbered(first, {points.shape(0)});
      },
      py::arg("points"), "Adds single nodes at (n, 3) [m] and returns their numbers, (n,).");
  type.def(
      "add_line",
      [](PyMesh& self, const py::object& nodes, const Lengths& lengths) {
        self.own.add_line(nodes_of(nodes), lengths.value_or(std::vector<double>()));
      },
      py::arg("nodes"), py::arg("lengths_m") = py::none(),
      "Adds a suspension line of the line material through nodes.\n\nlengths_m: unstretched "
      "length between each two nodes. None: distance at the start.");
  type.def(
      "add_tape",
      [](PyMesh& self, const py::object& nodes, const Lengths& lengths) {
        self.own.add_tape(nodes_of(nodes), lengths.value_or(std::vector<double>()));
      },
      py::arg("nodes"), py::arg("lengths_m") = py::none(),
      "Adds tape of the case along nodes, as add_line() does.");
  type.def(
      "tie",
      [](PyMesh& self, int node, const py::object& masters, const Lengths& weights) {
        self.own.tie(node, nodes_of(masters), weights.value_or(std::vector<double>()));
      },
      py::arg("node"), py::arg("masters"), py::arg("weights") = py::none(),
      "Lets a node follow other nodes, for a seam: its position is the weighted mean of theirs.\n\n"
      "weights: None: equal weights.");
  type.def(
      "fix", [](PyMesh& self, const py::object& nodes) { self.own.fix(nodes_of(nodes)); }, py::arg("nodes"),
      "Fixes nodes at their positions. At least one is needed.");
  type.def(
      "set_skirt", [](PyMesh& self, const py::object& nodes) { self.own.set_skirt(nodes_of(nodes)); },
      py::arg("nodes"), "Names the nodes around the mouth in order, for the skirt diameter and the length.");
}

}  // namespace

void add_mesh(py::module_& module) {
  py::class_<PyMesh> type(
      module, "Mesh",
      "A canopy of your own for fabric() and steady(), in place of that of the case: nodes, cloth, lines, "
      "tape.\n\nIt is made of the materials of a case. z is downstream; the plane z = 0 lies at "
      "flow.canopy_position_m.");
  type.def_static(
      "empty", [](const PyCase& given) { return PyMesh{OwnMesh(given.settings().materials())}; },
      py::arg("case"), "Returns a mesh without cloth, of the materials of the case.");
  type.def_static(
      "of",
      [](const PyCase& given) {
        const Settings resolved = given.settings();
        return PyMesh{OwnMesh(build_mesh(resolved.parachute(), resolved.materials()), resolved.materials())};
      },
      py::arg("case"), "Returns the mesh of the case.");
  add_methods(type);
  type.def_property_readonly(
      "nodes",
      [](const PyMesh& self) {
        const std::vector<Vec3> start = self.own.mesh().start;
        py::array_t<double> copy({static_cast<py::ssize_t>(start.size()), py::ssize_t{3}});
        std::copy(&start.front().x, &start.front().x + 3 * start.size(), copy.mutable_data());
        return copy;
      },
      "Position of every node at the start, (n, 3) [m]; raises Error for an incomplete mesh.");
  type.def_property_readonly(
      "mass_kg",
      [](const PyMesh& self) {
        const std::vector<double> mass = self.own.mesh().mass;
        return py::array_t<double>(static_cast<py::ssize_t>(mass.size()), mass.data());
      },
      "Mass of every node, (n,) [kg]; raises Error for an incomplete mesh.");
  type.def_property_readonly(
      "cloth_area_m2", [](const PyMesh& self) { return cloth_area(self.own.mesh()); },
      "Area of the finished cloth, without allowances [m2].");
}

}  // namespace ripstop::python
