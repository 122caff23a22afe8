// add_engine(): a flow engine whose pressures come from a Python function.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "members.h"
#include "module.h"
#include "ripstop/core/error.h"
#include "ripstop/flow/engines.h"

namespace ripstop::python {
namespace {

/// The pressures depend on the surface alone, so that a flow has no other state.
class PythonFlow : public Flow {
 public:
  PythonFlow(FlowProblem problem, std::string word, const py::object& solve)
      : problem_(std::move(problem)), word_(std::move(word)), solve_(solve) {
    for (std::size_t b = 0; b < problem_.bodies.size(); ++b) place(b, problem_.bodies[b].surface);
  }

  void place(std::size_t body, const std::vector<Triangle>& surface, const SheetMotion& = {}) override {
    problem_.bodies[body].surface = surface;
  }

  FlowAdvance advance(int, double, const FlowReport& report) override {
    loads_.clear();
    force_ = {};
    for (std::size_t b = 0; b < problem_.bodies.size(); ++b) add_loads(b);
    touched_ = true;
    FlowAdvance done;
    done.last.iteration = 1;
    done.last.drag = dot(force_, problem_.air.direction());
    done.converged = true;
    done.stopped = report && !report(done.last);
    return done;
  }

  FlowField field() const override {
    FlowField field;
    field.grid = problem_.grid;
    field.pressure.assign(problem_.grid.cells(), 0.0);
    field.velocity.assign(problem_.grid.cells(), problem_.air.velocity);
    field.porous_force = force_;
    field.bodies = body_loads_;
    field.sheet_loads = loads_;
    const double unknown = std::nan("");
    field.momentum_deficit = {unknown, unknown, unknown};
    field.last.iteration = 1;
    field.last.drag = dot(force_, problem_.air.direction());
    field.converged = touched_;
    return field;
  }

  bool untouched() const override { return !touched_; }
  void start_afresh() override { touched_ = false; }
  void save(const std::filesystem::path&) const override {}
  void restore(const std::filesystem::path&) override { touched_ = true; }

 private:
  /// One load for each triangle, at its centre.
  void add_loads(std::size_t body) {
    const FlowBody& sheet = problem_.bodies[body];
    const std::vector<double> drops = pressures(sheet);
    body_loads_.resize(problem_.bodies.size());
    body_loads_[body] = {};
    for (std::size_t i = 0; i < drops.size(); ++i) {
      const Triangle& t = sheet.surface[i];
      const Vec3 area = 0.5 * cross(t.b - t.a, t.c - t.a);
      const double size = norm(area);
      if (!(size > 0)) continue;
      SheetLoad load;
      load.body = static_cast<int>(body);
      load.triangle = static_cast<int>(i);
      load.point = (t.a + t.b + t.c) / 3;
      load.outward = area / size;
      load.drop = drops[i];
      load.force = drops[i] * area;
      load.area = size;
      force_ += load.force;
      body_loads_[body].force += load.force;
      body_loads_[body].moment += cross(load.point - sheet.moment_about, load.force);
      loads_.push_back(load);
    }
  }

  /// Calls Python. Throws Error(bad_data) for an answer that is not one finite number for each triangle.
  std::vector<double> pressures(const FlowBody& sheet) const {
    static_assert(sizeof(Triangle) == 9 * sizeof(double));
    const py::gil_scoped_acquire lock;
    const auto count = static_cast<py::ssize_t>(sheet.surface.size());
    const py::array triangles(py::dtype::of<double>(), {count, py::ssize_t{3}, py::ssize_t{3}}, {},
                              count > 0 ? &sheet.surface.front().a.x : nullptr);  // a copy
    const Vec3 u = problem_.air.velocity;
    const py::object given =
        solve_(triangles, py::make_tuple(u.x, u.y, u.z), py::float_(problem_.air.density));
    const auto answer = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(given);
    if (!answer) PyErr_Clear();
    if (!answer || answer.ndim() != 1 || answer.shape(0) != count)
      throw Error(
          ExitCode::bad_data,
          fmt::format("the function of the engine \"{}\" must return one pressure difference [Pa] for "
                      "each of the {} triangles",
                      word_, count));
    std::vector<double> drops(answer.data(), answer.data() + count);
    for (const double drop : drops)
      if (!std::isfinite(drop))
        throw Error(
            ExitCode::bad_data,
            fmt::format("the function of the engine \"{}\" returned {}, but a pressure difference must "
                        "be finite",
                        word_, drop));
    return drops;
  }

  FlowProblem problem_;
  std::string word_;
  const py::object& solve_;
  bool touched_ = false;
  Vec3 force_;
  std::vector<BodyLoad> body_loads_;
  std::vector<SheetLoad> loads_;
};

class PythonEngine : public FlowEngine {
 public:
  PythonEngine(std::string word, const py::object& solve) : word_(std::move(word)), solve_(solve) {}
  std::string name() const override { return word_; }
  std::unique_ptr<Flow> start(const FlowProblem& problem) override {
    for (const FlowBody& body : problem.bodies)
      if (!body.is_sheet())
        throw Error(ExitCode::usage,
                    fmt::format("the engine \"{}\" computes pressures of porous sheets only: set "
                                "flow.porosity_model = \"sheet\"",
                                word_));
    return std::make_unique<PythonFlow>(problem, word_, solve_);
  }

 private:
  std::string word_;
  const py::object& solve_;
};

void add_python_engine(const std::string& word, const py::function& solve, const std::string& meaning) {
  for (const EngineRecord& known : engines())
    if (known.word == word) throw py::value_error(fmt::format("the engine \"{}\" exists already", word));
  if (word.empty() || word.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") != std::string::npos)
    throw py::value_error("the name of an engine has lower-case letters, digits and hyphens only");
  // The table of engines outlives the interpreter, so this reference is never released.
  const py::object& kept = *new py::object(solve);
  Abilities can;
  can.sheets = true;
  can.other_air = true;
  add_engine({word, meaning, can, [word](const EngineOptions&) { return word; },
              [word, &kept](const EngineOptions&) { return std::make_unique<PythonEngine>(word, kept); }});
}

}  // namespace

void add_engines(py::module_& module) {
  module.def(
      "add_engine", &add_python_engine, py::arg("word"), py::arg("solve"), py::kw_only(),
      py::arg("meaning") = "a function in Python",
      "Adds a flow engine to this process; flow.engine = word selects it.\n\nword: lower-case letters, "
      "digits and hyphens.\nsolve: function (triangles, velocity, density) that returns the pressure "
      "difference over each triangle\n  of the canopy, inner over outer side [Pa], as (n,). triangles: "
      "corners, (n, 3, 3) [m]; velocity of the\n  stream, 3 values [m/s]; density [kg/m3]. It is called "
      "once in each coupling iteration.\nmeaning: one clause for the list of engines.\n\nThe porous sheet "
      "(flow.porosity_model = \"sheet\") is required; open jets and unsteady flow are not "
      "available.\nThe flow field of a run is the undisturbed stream.");
}

}  // namespace ripstop::python
