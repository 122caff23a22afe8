// The page of a run in a notebook: the report of its folder, or one of its arrays.
#pragma once

#include <filesystem>
#include <string>

#include "module.h"
#include "ripstop/core/file.h"
#include "ripstop/run/report/memory_report.h"
#include "ripstop/run/report/report.h"
#include "ripstop/run/report/report_plots.h"

namespace ripstop::python {

/// _page() of a class: the report of the run's `folder` if it has one, else that of `shown(run)`.
template <class Holder, class Shown>
void add_page(py::class_<Holder>& type, Shown shown) {
  type.def("_page", [shown](const Holder& run) -> std::string {
    const py::gil_scoped_release release;
    const Path written = run.folder / report_name;
    if (!run.folder.empty() && std::filesystem::exists(written)) return read_file(written);
    ReportRun page = shown(run);
    const std::string title = page.title;
    return report_page(report_on({std::move(page)}, title));
  });
}

}  // namespace ripstop::python
