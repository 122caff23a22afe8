// report(): finished runs as one HTML file.
#include "ripstop/run/report/report.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "module.h"

namespace ripstop::python {

void add_report(py::module_& module) {
  module.def(
      "report",
      [](const std::vector<Path>& runs, const std::optional<Path>& out) {
        const py::gil_scoped_release release;
        return write_report(runs, out.value_or(Path())).string();
      },
      py::arg("runs"), py::kw_only(), py::arg("out") = py::none(),
      "Writes finished runs as one HTML file: ripstop report. Returns its path.\n\n"
      "runs: folders of finished runs of steady, inflate, fly or sweep.\n"
      "out: the file. None: report.html in the run folder; for several runs, in the current folder.");
}

}  // namespace ripstop::python
