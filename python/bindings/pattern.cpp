// pattern(): cutting pattern, with outlines as arrays.
#include "ripstop/run/sizing/pattern.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "members.h"
#include "module.h"

namespace ripstop::python {
namespace {

py::array view_of_outline(const std::vector<Point2>& outline, py::handle owner) {
  static_assert(sizeof(Point2) == 2 * sizeof(double));
  const double* data = outline.empty() ? nullptr : &outline.front().x;
  return view_of(data, {static_cast<py::ssize_t>(outline.size()), 2}, owner);
}

PatternResult pattern(const PyCase& given, const Allowances& allowances, double packing_density,
                      const std::optional<Path>& out, const PatternFiles& files) {
  const py::gil_scoped_release release;
  PatternResult result = run_pattern(given.settings(), allowances, packing_density);
  if (out) write_pattern(*out, result, files);
  return result;
}

void add_piece(py::module_& module) {
  py::class_<Piece> type(module, "Piece", "A flat piece of cloth, finished size.");
  type.def_property_readonly(
      "name", [](const Piece& p) { return p.name; }, "Name of the piece.");
  type.def_property_readonly(
      "count", [](const Piece& p) { return p.count; }, "Number of equal pieces.");
  type.def_property_readonly(
      "grain_deg", [](const Piece& p) { return p.grain; }, "Angle of the warp, from y towards x [deg]");
  type.def_property_readonly(
      "outline",
      [](const py::object& self) { return view_of_outline(self.cast<const Piece&>().outline, self); },
      "Corners x, y, counterclockwise; y points towards the vent [m]");
  type.def_property_readonly(
      "hems",
      [](const Piece& p) {
        py::list hems;
        for (const Edge edge : p.edges) hems.append(edge == Edge::hem);
        return hems;
      },
      "Whether the edge from each corner to the next is a hem; otherwise it is a seam.");
  type.def("__repr__", [](const Piece& p) {
    return "<ripstop.Piece '" + p.name + "', " + std::to_string(p.count) + " of them>";
  });
}

}  // namespace

void add_pattern(py::module_& module) {
  add_class<BillRow>(module, "BillRow",
                     "A row of the bill of materials; sizes are in [m2] for cloth, else in [m].");
  add_class<CutLength>(module, "CutLength", "Pieces of tape or line, finished.");
  add_piece(module);
  py::class_<PatternResult> type =
      add_result<PatternResult>(module, "Pattern", "Cutting pattern of a parachute.");
  type.def_property_readonly(
      "pieces",
      [](const py::object& self) {
        py::list pieces;
        for (const Piece& piece : self.cast<const PatternResult&>().pattern.pieces)
          pieces.append(py::cast(&piece, py::return_value_policy::reference_internal, self));
        return pieces;
      },
      "One Piece for each outline.");
  type.def_property_readonly(
      "tapes",
      [](const py::object& self) -> py::list {
        return to_python(self.cast<const PatternResult&>().pattern.tapes, self);
      },
      "One CutLength for each tape.");
  module.def(
      "pattern",
      [](PyCase given, double seam, double hem, double line_loop, double tape_overlap, double packing_density,
         const std::optional<Path>& out, const std::string& units, const std::string& paper) {
        if (units != "mm" && units != "in") throw py::value_error("units is \"mm\" or \"in\"");
        if (!paper.empty() && paper != "a4" && paper != "letter")
          throw py::value_error("paper is \"a4\", \"letter\" or \"\", for no PDF");
        PatternFiles files;
        files.unit = units == "in" ? DxfUnit::inches : DxfUnit::millimetres;
        if (!paper.empty()) files.paper = paper == "letter" ? Paper::letter : Paper::a4;
        files.case_file = given.file.string();
        files.date = today();
        return pattern(given, {seam, hem, line_loop, tape_overlap}, packing_density, out, files);
      },
      py::arg("case"), py::kw_only(), py::arg("seam_allowance_m") = Allowances{}.seam,
      py::arg("hem_allowance_m") = Allowances{}.hem, py::arg("line_loop_m") = Allowances{}.line_loop,
      py::arg("tape_overlap_m") = Allowances{}.tape_overlap,
      py::arg("packing_density_kg_m3") = packed_by_hand, py::arg("out") = py::none(), py::arg("units") = "mm",
      py::arg("paper") = "",
      "Makes the cutting pattern and the bill of materials: ripstop pattern. Lengths are in [m], areas in "
      "[m2],\n"
      "masses in [kg].\n\n"
      "out: folder for the drawings and the bill. None: no files.\n"
      "units: unit of the DXF files, \"mm\" or \"in\".\n"
      "paper: also write PDF files on sheets of this paper, \"a4\" or \"letter\"; empty: no PDF.");
}

}  // namespace ripstop::python
