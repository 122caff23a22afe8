// fit(): from the records of a tensile bench to a material.
#include "ripstop/run/material/fit.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "members.h"
#include "module.h"
#include "ripstop/core/table/table.h"

namespace ripstop {

/// A step of the search for xi and eps.
struct FitProgress {
  int pulls = 0;
  double shear_fraction = 0, bending_fraction = 0, misfit = 0;
};
template <Of<FitProgress> T, class Visit>
void each_member(T& p, Visit&& visit) {
  visit("pulls", p.pulls);
  visit("shear_fraction", p.shear_fraction);
  visit("bending_fraction", p.bending_fraction);
  visit("misfit", p.misfit);
}
template <Of<Estimate> T, class Visit>
void each_member(T& e, Visit&& visit) {
  visit("value", e.value);
  visit("standard_error", e.standard_error);
  visit("low", e.low);
  visit("high", e.high);
}
template <Of<DirectionFit> T, class Visit>
void each_member(T& d, Visit&& visit) {
  visit("name", d.name);
  visit("orientation_deg", d.orientation);
  visit("degree", d.fit.degree);
  visit("r2", d.fit.r2);
  visit("r2_all_points", d.fit.r2_all);
  visit("tested_strain", d.fit.tested_strain);
  visit("offset", d.fit.offset);
  visit("coefficients", d.fit.k);
  visit("strain", d.curve.strain);
  visit("load", d.curve.load);
  visit("spread", d.curve.spread);
  visit("fit", d.fit.fit);
  visit("band_low", d.fit.band_low);
  visit("band_high", d.fit.band_high);
}
template <Of<CouponComparison> T, class Visit>
void each_member(T& c, Visit&& visit) {
  visit("name", c.name);
  visit("r2", c.r2);
  visit("strain", c.strain);
  visit("measured", c.measured);
  visit("simulated", c.simulated);
}

}  // namespace ripstop

namespace ripstop::python {
namespace {

FitResult fit(const Path& file, bool coupons, int degree, bool zero_offset, const std::string& columns,
              const std::string& decimal, Callback<FitProgress> progress, int threads,
              const std::optional<Path>& out) {
  Listener listener(std::move(progress));
  const py::gil_scoped_release release;
  Bench bench = read_bench(file);
  if (degree > 0) bench.degree = degree;
  if (zero_offset) bench.zero_offset = true;
  if (!columns.empty()) bench.columns = columns;
  if (!decimal.empty()) bench.decimal = table::parse_decimal(decimal);
  table::parse_columns(bench.columns);  // a wrong one ends here, before any record is read
  ThreadTeam team(threads);
  FitResult result = run_fit(bench, coupons, team, [&](int pulls, double xi, double eps, double misfit) {
    listener.tell(FitProgress{pulls, xi, eps, misfit});
  });
  if (out) write_fit(*out, result);
  return result;
}

std::optional<double> of_coupons(const FitResult& r, double Fabric::*member) {
  if (!r.coupons) return {};
  return r.coupons->fabric.*member;
}

}  // namespace

void add_fit(py::module_& module) {
  add_class<FitProgress>(module, "FitProgress", "A step of the search by virtual coupons.");
  add_class<Estimate>(module, "Estimate",
                      "A number with its standard error and confidence interval; NaN: one sample has none.");
  add_class<DirectionFit>(
      module, "FittedDirection",
      "The records of one direction: mean curve and fit over the strain; loads in [N/m], of a line in [N].");
  add_class<CouponComparison>(module, "CouponComparison",
                              "A measured curve beside the coupon pulled in the computer [N/m].");
  py::class_<FitResult> type(module, "Fit", "A material from the records of a tensile bench.");
  add_json(type, [](const FitResult& r) -> const FitResult& { return r; });
  type.def("to_toml", &material_toml, "The material's file, with its provenance in comments.");
  type.def_property_readonly(
      "name", [](const FitResult& r) { return r.bench.name; }, "The material's name.");
  type.def_property_readonly(
      "kind", [](const FitResult& r) { return kind_of(r.fit.material); }, "fabric, line or tape.");
  type.def_property_readonly(
      "directions",
      [](const py::object& self) -> py::list {
        return to_python(self.cast<const FitResult&>().fit.directions, self);
      },
      "A FittedDirection for each direction of pull.");
  type.def_property_readonly(
      "coupons",
      [](const py::object& self) -> py::list {
        const FitResult& r = self.cast<const FitResult&>();
        if (!r.coupons) return py::list();
        return to_python(r.coupons->coupons, self);
      },
      "A CouponComparison for each measured direction; empty without coupons.");
  type.def_property_readonly(
      "shear_fraction", [](const FitResult& r) { return of_coupons(r, &Fabric::shear_fraction); },
      "xi; None without coupons.");
  type.def_property_readonly(
      "bending_fraction", [](const FitResult& r) { return of_coupons(r, &Fabric::bending_fraction); },
      "eps; None without coupons.");
  type.def_property_readonly(
      "notes", [](const FitResult& r) { return r.fit.notes; }, "What was decided and why.");
  type.def_property_readonly(
      "warnings", [](const FitResult& r) { return r.fit.warnings; }, "What is doubtful about the material.");
  type.def("__repr__", [](const FitResult& r) { return "<ripstop.Fit '" + r.bench.name + "'>"; });
  module.def("fit", &fit, py::arg("bench"), py::kw_only(), py::arg("coupons") = true, py::arg("degree") = 0,
             py::arg("zero_offset") = false, py::arg("columns") = "", py::arg("decimal") = "",
             py::arg("progress") = py::none(), py::arg("threads") = 0, py::arg("out") = py::none(),
             "From tensile test records to a material: ripstop fit.\n\n"
             "bench: the campaign's file (TOML).\n"
             "coupons: find xi and eps by virtual coupons.\n"
             "degree: of the curves; 0: as the campaign says. zero_offset: no load without strain, whatever "
             "it says.\n"
             "columns: columns of the records that are not found by their headings, as in\n"
             "  \"force=Kraft [kN],extension=Weg [mm]\". decimal: auto, point or comma.\n"
             "progress: called with a FitProgress after every coupon; what it raises ends the search.\n"
             "threads: 0: all. out: a folder for the material and its plots. None: nothing is written.\n\n"
             "Loads in [N/m] of cloth and tape, in [N] of a line.");
}

}  // namespace ripstop::python
