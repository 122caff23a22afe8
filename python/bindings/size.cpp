// size(): which parachute lets a payload down at a wanted rate; families and other sizes of a case.
#include "ripstop/run/sizing/size.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "members.h"
#include "module.h"
#include "ripstop/core/build_info.h"
#include "ripstop/parachute/scale.h"
#include "ripstop/run/sizing/size_case.h"

namespace ripstop {
template <Of<FlownDrag> T, class Visit>
void each_member(T& f, Visit&& visit) {
  visit("drag_coefficient", f.drag_coefficient);
  visit("standard_error", f.standard_error);
  visit("half_swings", f.half_swings);
  visit("made", f.made);
}
template <Of<FamilyDrag> T, class Visit>
void each_member(T& f, Visit&& visit) {
  visit("family", f.family);
  visit("type", f.type);
  visit("drag_coefficient", f.drag_coefficient);
  visit("handbook_drag_coefficient", f.handbook);
  visit("speed_m_s", f.speed);
  visit("density_kg_m3", f.density);
  visit("made", f.made);
  visit("flown", f.flown);
}
}  // namespace ripstop

namespace ripstop::python {
namespace {

/// Listens while verify_size() flies.
class SizeListener : public SteadyObserver {
 public:
  explicit SizeListener(Listener& listener) : listener_(listener) {}
  void progress(const SteadyProgress&, const SteadyState&) override { listener_.listen(); }
  void iterated(const SteadyRun&, const SteadyState& state, const FlowField&) override {
    listener_.tell(state.iterations.back());
  }

 private:
  Listener& listener_;
};

/// Listens while it flies freely.
class SizeFlightListener : public FlightObserver {
 public:
  explicit SizeFlightListener(Listener& listener) : listener_(listener) {}
  void starting(const SteadyProgress&, const SteadyState&) override { listener_.listen(); }
  void advanced(FreeFlight&, const FreeFlightState&, const FlightHistory&, bool) override {
    listener_.listen();
  }

 private:
  Listener& listener_;
};

SizeResult size(const SizeRequest& request, bool verify, bool fly, Callback<SteadyIteration> progress) {
  if (fly && !verify) throw py::value_error("fly: the flights are runs of verify; set both");

  Listener listener(std::move(progress));
  const py::gil_scoped_release release;
  SizeResult result = run_size(request);
  if (!verify) return result;
  SizeListener observer(listener);
  SizeFlightListener in_flight(listener);
  verify_size(request, result, [&](const Settings& resolved, int) {
    if (!fly) return VerifiedDescent(run_steady(resolved, observer).result);
    const Settings flight = sized_flight(resolved, FlightSettings().duration_s);
    return VerifiedDescent(run_flight(flight, flight.coupling().threads, in_flight).result);
  });
  return result;
}

DragBasis basis_of(const std::string& word) {
  if (word == "safe") return DragBasis::safe;
  if (word == "axial") return DragBasis::axial;
  if (word == "descent") return DragBasis::descent;
  throw py::value_error("coefficient: \"" + word + "\"; allowed: safe, axial, descent");
}

PyCase case_of(const SizeResult& result) {
  PyCase made(result.given);
  made.text = result.case_text;
  made.name = "size";
  return made;
}

PyCase scaled(const PyCase& self, double factor) {
  if (!(factor > 0)) throw py::value_error("the scale factor must be above 0");
  Case given = self.given;
  scale_lengths(given.parachute, factor);
  return PyCase(checked(std::move(given)));
}

}  // namespace

void add_size(py::module_& module) {
  add_class<SizeCheck>(module, "SizeCheck", "One run of the verification of a size.");
  add_class<FlownDrag>(module, "FlownDrag", "Drag coefficient in descent, from a free flight.");
  add_class<FamilyDrag>(module, "Family", "A canopy family with the computed drag of its example.");
  py::class_<SizeResult> type =
      add_result<SizeResult>(module, "Size", "Parachute for a payload and a descent rate.");
  type.def_property_readonly("case", &case_of, "Case of the parachute.");
  type.def_property_readonly(
      "case_text", [](const SizeResult& r) { return r.case_text; }, "Case file (TOML), with comments.");
  module.def(
      "size",
      [](double payload, double rate, const std::string& family, double height, std::optional<double> density,
         std::optional<double> drag_coefficient, std::optional<double> deployment_speed,
         std::optional<std::string> line_material, double packing_density, bool verify,
         Callback<SteadyIteration> progress, const std::string& coefficient, bool fly) {
        return size({payload, rate, family, height, density, drag_coefficient, deployment_speed,
                     line_material, packing_density, basis_of(coefficient)},
                    verify, fly, std::move(progress));
      },
      py::arg("payload_mass_kg"), py::arg("descent_rate_m_s"), py::arg("family") = SizeRequest{}.family,
      py::kw_only(), py::arg("height_m") = 0.0, py::arg("density_kg_m3") = py::none(),
      py::arg("drag_coefficient") = py::none(), py::arg("deployment_speed_m_s") = py::none(),
      py::arg("line_material") = py::none(), py::arg("packing_density_kg_m3") = packed_by_hand,
      py::arg("verify") = false, py::arg("progress") = py::none(), py::arg("coefficient") = "safe",
      py::arg("fly") = false,
      "Designs a parachute for a payload [kg] and a descent rate [m/s]: ripstop size.\n\n"
      "family: one of families().\n"
      "height_m: height above sea level at which the rate is required.\n"
      "density_kg_m3: density of the air, instead of the height.\n"
      "verify: adjust the diameter with steady runs until the rate is met; with fly, with free flights.\n"
      "coefficient: \"axial\" (steady flow), \"descent\" (flown) or \"safe\", the smaller one.\n"
      "progress: as in steady().");
  module.def("families", &family_drags,
             "Returns all canopy families with the computed drag coefficients of their examples.");
  module.def(
      "data_directory", [] { return data_directory().string(); },
      "Returns the folder with the installed materials/ and examples/.");
  const auto type_of_case = py::type::of<PyCase>();
  py::setattr(type_of_case, "scaled",
              py::cpp_function(&scaled, py::name("scaled"), py::is_method(type_of_case), py::arg("factor"),
                               "Returns a case with every length of the parachute multiplied by `factor`, "
                               "rounded to 0.1 mm. Lengths of\nthe mesh do not change."));
}

}  // namespace ripstop::python
