// stability(): coefficients over the angle of attack.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "members.h"
#include "module.h"
#include "ripstop/core/file.h"
#include "ripstop/run/stability/stability_folder.h"

namespace ripstop::python {
namespace {

/// Calls Python for every angle that has ended, and looks for signals meanwhile.
class StabilityListener : public StabilityObserver {
 public:
  explicit StabilityListener(Listener& listener) : listener_(listener), axis_(listener) {}
  SteadyObserver& axis() override { return axis_; }
  void progress(std::size_t, const std::string&, double) override { listener_.listen(); }
  void ended(std::size_t, const StabilityRow& row, bool) override { listener_.tell(row); }

 private:
  class Axis : public SteadyObserver {
   public:
    explicit Axis(Listener& listener) : listener_(listener) {}
    void progress(const SteadyProgress&, const SteadyState&) override { listener_.listen(); }

   private:
    Listener& listener_;
  };
  Listener& listener_;
  Axis axis_;
};

StabilityResult stability(const PyCase& given, const std::vector<double>& angles, StabilitySettings settings,
                          const std::optional<Path>& out, Callback<StabilityRow> progress) {
  Listener listener(std::move(progress));
  StabilityListener observer(listener);
  const py::gil_scoped_release release;
  if (out) {
    settings.run.folder = *out;
    return run_stability(given.given, angles, settings, observer);
  }
  const TemporaryFolder folder("stability");
  settings.run.folder = folder.path / "curve";
  settings.run.report = false;
  return run_stability(given.given, angles, settings, observer);
}

}  // namespace

void add_stability(py::module_& module) {
  add_class<StabilityBody>(module, "StabilityBody", "Mean loads on a rigid body at one angle of attack.");
  add_class<StabilityRow>(module, "StabilityAngle",
                          "Coefficients at one angle of attack, with their standard errors.");
  add_class<Trim>(module, "Trim", "Angle of attack at which the moment about the confluence is zero.");
  add_result<StabilityResult>(module, "Stability", "Coefficients over the angle of attack, and trim angles.");
  module.def(
      "stability",
      [](const PyCase& given, const std::vector<double>& angles, int cells_across, bool equilibrium,
         bool cold, const std::optional<Path>& steady, Callback<StabilityRow> progress, int threads,
         const std::optional<Path>& out, bool fresh) {
        StabilitySettings settings;
        settings.run = {{}, fresh, false, true};
        settings.threads = threads, settings.across = cells_across;
        settings.equilibrium = equilibrium, settings.warm = !cold;
        if (steady) settings.steady = *steady;
        return stability(given, angles, settings, out, std::move(progress));
      },
      py::arg("case"), py::arg("angles_deg"), py::kw_only(), py::arg("cells_across") = 16,
      py::arg("equilibrium") = false, py::arg("cold") = false, py::arg("steady") = py::none(),
      py::arg("progress") = py::none(), py::arg("threads") = 0, py::arg("out") = py::none(),
      py::arg("fresh") = false,
      "Computes force and moment coefficients over the angle of attack, and trim angles: ripstop "
      "stability.\n\n"
      "angles_deg: angles of attack, in increasing order.\n"
      "cells_across: cells of the flow over the projected diameter.\n"
      "equilibrium: the canopy deforms under the mean load of each angle; False: it keeps its shape on the\n"
      "  axis.\n"
      "cold: start the flow of each angle from the uniform stream, not from that of the previous angle.\n"
      "steady: folder of a finished steady run that provides the shape. None: this run is computed first.\n"
      "progress: called with a StabilityAngle after every angle; an exception in it stops the run.\n"
      "threads: number of threads; 0: coupling.threads of the case.\n"
      "out: folder; finished angles are read from it. None: no files.\n"
      "fresh: replace the angles in the folder.");
}

}  // namespace ripstop::python
