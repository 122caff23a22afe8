// fit(): from the records of a tensile bench to a material.
#include "ripstop/run/material/fit.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "members.h"
#include "module.h"
#include "ripstop/core/claimed_folder.h"
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
  if (out) make_results_folder(*out, "fit");
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
  add_class<FitProgress>(module, "FitProgress", "One step of the fit with virtual coupons.");
  add_class<Estimate>(
      module, "Estimate",
      "A value with its standard error and confidence interval, which are NaN for one sample.");
  add_class<DirectionFit>(module, "FittedDirection",
                          "Mean curve and fit of the records of one direction over the strain. Loads are in "
                          "[N/m], for a line in [N].");
  add_class<CouponComparison>(module, "CouponComparison",
                              "Measured curve and curve of the virtual coupon [N/m].");
  py::class_<FitResult> type(module, "Fit", "A material fitted to tensile test records.");
  add_json(type, [](const FitResult& r) -> const FitResult& { return r; });
  type.def("to_toml", &material_toml, "Returns the material file, with its provenance in comments.");
  type.def_property_readonly(
      "name", [](const FitResult& r) { return r.bench.name; }, "Name of the material.");
  type.def_property_readonly(
      "kind", [](const FitResult& r) { return kind_of(r.fit.material); }, "Kind: fabric, line or tape.");
  type.def_property_readonly(
      "directions",
      [](const py::object& self) -> py::list {
        return to_python(self.cast<const FitResult&>().fit.directions, self);
      },
      "One FittedDirection for each direction of load.");
  type.def_property_readonly(
      "coupons",
      [](const py::object& self) -> py::list {
        const FitResult& r = self.cast<const FitResult&>();
        if (!r.coupons) return py::list();
        return to_python(r.coupons->coupons, self);
      },
      "One CouponComparison for each measured direction; empty without coupons.");
  type.def_property_readonly(
      "shear_fraction", [](const FitResult& r) { return of_coupons(r, &Fabric::shear_fraction); },
      "Shear fraction xi; None without coupons.");
  type.def_property_readonly(
      "bending_fraction", [](const FitResult& r) { return of_coupons(r, &Fabric::bending_fraction); },
      "Bending fraction eps; None without coupons.");
  type.def_property_readonly(
      "notes", [](const FitResult& r) { return r.fit.notes; }, "Decisions of the fit and their reasons.");
  type.def_property_readonly(
      "warnings", [](const FitResult& r) { return r.fit.warnings; }, "Warnings about the material.");
  type.def("__repr__", [](const FitResult& r) { return "<ripstop.Fit '" + r.bench.name + "'>"; });
  module.def(
      "fit", &fit, py::arg("bench"), py::kw_only(), py::arg("coupons") = true, py::arg("degree") = 0,
      py::arg("zero_offset") = false, py::arg("columns") = "", py::arg("decimal") = "",
      py::arg("progress") = py::none(), py::arg("threads") = 0, py::arg("out") = py::none(),
      "Fits a material to tensile test records: ripstop fit.\n\nbench: file of the test campaign "
      "(TOML).\ncoupons: whether xi and eps are fitted with virtual coupons.\ndegree: degree of the curves; "
      "0: as in the campaign.\nzero_offset: whether the load at zero strain is set to 0; False: as in the "
      "campaign.\ncolumns: columns of the records that are not recognised by their headings, for example\n  "
      "\"force=Kraft [kN],extension=Weg [mm]\".\ndecimal: auto, point or comma.\nprogress: called with a "
      "FitProgress after every coupon; an exception in it stops the fit.\nthreads: number of threads; 0: all "
      "cores.\nout: folder for the material and its plots. None: no files.\n\nLoads are in [N/m] for cloth "
      "and tape, in [N] for a line.");
}

}  // namespace ripstop::python
