#include "ripstop/case/resolve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ripstop/flight/atmosphere.h"

namespace ripstop {
namespace {

constexpr double least_box_over_core = 2;  // a core that fills more of the box than half of it gains little

std::string given_where(const Origins& origins, const std::string& key) {
  const auto found = origins.find(key);
  if (found == origins.end()) return "given";
  const Origin& origin = found->second;
  return "given " + (origin.option.empty() ? fmt::format("in {}, line {}", origin.file, origin.line)
                                           : "by " + origin.option);
}

/// Takes what is given, else what follows, writes it into the case and notes where it came from.
class Follow {
 public:
  explicit Follow(Resolved& resolved) : resolved_(resolved) {}

  template <class T>
  T operator()(const std::string& key, std::optional<T>& written, const T& otherwise, std::string from) {
    const bool given = written.has_value();
    if (!given) written = otherwise;
    resolved_.sources.push_back(
        {key, given, given ? given_where(resolved_.written.origins, key) : std::move(from)});
    return *written;
  }

 private:
  Resolved& resolved_;
};

// A day in a tunnel: what the air is where neither its own keys nor a height say.
constexpr double usual_viscosity = 1.84e-5;   // [Pa s]
constexpr double usual_temperature = 293.15;  // [K]

void resolve_air(Follow& follow, const Case& given, FlowKeys& keys, FlowSettings& flow) {
  const Air stream = air(given);
  flow.speed_m_s =
      follow("flow.speed_m_s", keys.speed_m_s, stream.speed,
             "payload.mass_kg and the family's usual drag: a first guess, the run finds the speed");
  if (!given.flow.height_m) {
    flow.density_kg_m3 = follow("flow.density_kg_m3", keys.density_kg_m3, stream.density,
                                "the row of [[measured]] with this nominal speed");
    flow.temperature_k =
        follow("flow.temperature_k", keys.temperature_k, usual_temperature, "a day in a tunnel");
    flow.viscosity_pa_s =
        follow("flow.viscosity_pa_s", keys.viscosity_pa_s, usual_viscosity, "a day in a tunnel");
    return;
  }
  const StandardAir standard = standard_air(*given.flow.height_m);
  const std::string from =
      fmt::format("the standard atmosphere at flow.height_m = {:g} m", *given.flow.height_m);
  flow.density_kg_m3 = follow("flow.density_kg_m3", keys.density_kg_m3, standard.density, from);
  flow.temperature_k = follow("flow.temperature_k", keys.temperature_k, standard.temperature, from);
  flow.viscosity_pa_s = follow("flow.viscosity_pa_s", keys.viscosity_pa_s, standard.viscosity, from);
}

void resolve_box(Follow& follow, const Design& parachute, FlowKeys& keys, FlowSettings& flow) {
  const bool sheet = flow.porosity_model == PorosityModel::sheet;
  const ModelDefaults& standard = sheet ? sheet_defaults : paper_defaults;
  const std::string model = sheet ? "the sheet's default" : "the paper model's default";
  const double d = inflated_diameter(parachute);
  const auto diameters = [d](const Vec3& of) {
    return fmt::format("{:g} x {:g} x {:g} inflated diameters of {:.3g} m", of.x, of.y, of.z, d);
  };
  flow.box_m = follow("flow.box_m", keys.box_m, sheet ? d * sheet_box : paper_box,
                      sheet ? diameters(sheet_box) : model);
  flow.cells = follow("flow.cells", keys.cells, standard.cells, model);
  const double half = flow.box_m.z / 2, upstream = d * sheet_skirt;
  flow.canopy_position_m =
      sheet && upstream < half
          ? follow("flow.canopy_position_m", keys.canopy_position_m, upstream,
                   fmt::format("{:g} inflated diameters of {:.3g} m", sheet_skirt, d))
          : follow("flow.canopy_position_m", keys.canopy_position_m, half, "half the length of the box");

  const Vec3 core = d * sheet_core, box = flow.box_m;
  const bool wide = box.x >= least_box_over_core * core.x && box.y >= least_box_over_core * core.y &&
                    box.z >= least_box_over_core * core.z;
  flow.core.size_m = follow("flow.core.size_m", keys.core.size_m, sheet && wide ? core : Vec3{},
                            !sheet  ? model
                            : !wide ? "a side of the box is less than twice as long as a core for this canopy"
                                    : diameters(sheet_core));
  const Vec3 size = flow.core.size_m;
  if (size.z > 0)
    flow.core.start_m =
        follow("flow.core.start_m", keys.core.start_m,
               std::max(0.0, std::min(flow.canopy_position_m - 0.25 * size.z, flow.box_m.z - size.z)),
               "a quarter of the core before the skirt");
  flow.core.growth = follow("flow.core.growth", keys.core.growth, standard.growth, model);
}

void resolve_numerics(Follow& follow, Case& written, Resolved& resolved) {
  FlowSettings& flow = resolved.flow;
  FlowKeys& keys = written.flow;
  const bool sheet = flow.porosity_model == PorosityModel::sheet;
  const ModelDefaults& standard = sheet ? sheet_defaults : paper_defaults;
  const std::string model = sheet ? "the sheet's default" : "the paper model's default";
  flow.convection = follow("flow.convection", keys.convection, standard.convection, model);
  flow.sides = follow("flow.sides", keys.sides, standard.sides, model);
  flow.outlet = follow("flow.outlet", keys.outlet, standard.outlet, model);
  flow.residual = follow("flow.residual", keys.residual, standard.residual, model);
  flow.max_iterations = follow("flow.max_iterations", keys.max_iterations, standard.max_iterations, model);
  flow.average_over = follow("flow.average_over", keys.average_over,
                             std::min(standard.average_over, flow.max_iterations), model);
  CouplingSettings& coupling = resolved.coupling;
  static_cast<CouplingOptions&>(coupling) = written.coupling;
  coupling.load = follow("coupling.load", written.coupling.load, standard.load, model);
  coupling.drag_tolerance =
      follow("coupling.drag_tolerance", written.coupling.drag_tolerance, standard.drag_tolerance, model);
}

}  // namespace

// An arm or gore lies flat in the start shape and has to fit into the core too.
double inflated_diameter(const Design& parachute) {
  constexpr double inflated_over_nominal = 0.7;
  const double nominal = std::sqrt(4 / std::numbers::pi * nominal_area(parachute));
  return std::max(inflated_over_nominal * nominal, start_diameter(parachute) / sheet_core.x);
}

Resolved resolve(const Case& given) {
  Resolved resolved;
  resolved.written = given;
  Case& written = resolved.written;
  FlowSettings& flow = resolved.flow;
  static_cast<FlowOptions&>(flow) = given.flow;
  Follow follow(resolved);
  const Design& parachute = given.parachute;
  follow("parachute.nominal_area_m2", written.parachute.nominal_area_m2, nominal_area(parachute),
         "the type's own definition");
  follow("parachute.lines.onto_disk_m", written.parachute.lines.onto_disk_m, line_length_on_disk(parachute),
         "up to the vent's edge");
  resolve_air(follow, given, written.flow, flow);
  const Fabric& cloth = canopy_fabric(given);
  flow.porosity_model = follow("flow.porosity_model", written.flow.porosity_model, cloth.resistance.model,
                               fmt::format("what darcy and forchheimer of materials.{} are for", cloth.name));
  resolve_box(follow, parachute, written.flow, flow);
  resolve_numerics(follow, written, resolved);
  follow("inflation.line_segment_m", written.inflation.line_segment_m, parachute.mesh.line_segment_m,
         "parachute.mesh.line_segment_m");
  return resolved;
}

double canopy_position(const Case& given) {
  return resolve(given).flow.canopy_position_m;
}

FlowGrid flow_grid(const FlowSettings& flow) {
  FlowGrid grid;
  grid.origin = {-0.5 * flow.box_m.x, -0.5 * flow.box_m.y, 0};
  grid.size = flow.box_m;
  grid.nx = flow.cells[0];
  grid.ny = flow.cells[1];
  grid.nz = flow.cells[2];
  const Vec3 size = flow.core.size_m;
  if (size.x <= 0 && size.y <= 0 && size.z <= 0) return grid;
  const double start = flow.core.start_m;
  return graded(grid, {-0.5 * size.x, -0.5 * size.y, start}, {0.5 * size.x, 0.5 * size.y, start + size.z},
                flow.core.growth);
}

FlowGrid flow_grid(const Case& given) {
  return flow_grid(resolve(given).flow);
}

}  // namespace ripstop
