#include "ripstop/case/resolve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ripstop/case/bodies.h"
#include "ripstop/case/cluster.h"
#include "ripstop/case/tape.h"
#include "ripstop/core/words.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flow/engines.h"

namespace ripstop::inline cases {
namespace {

std::string given_where(const Origins& origins, const std::string& key) {
  const auto found = origins.find(key);
  if (found == origins.end()) return "given";
  const Origin& origin = found->second;
  if (!origin.option.empty()) return "given by " + origin.option;
  return origin.line > 0 ? fmt::format("given in {}, line {}", origin.file, origin.line)
                         : "given in " + origin.file;
}

/// Takes the given value, else the derived one, writes it into the case and records its origin.
class Follow {
 public:
  explicit Follow(SettingsValues& values) : values_(values) {}

  template <class T>
  T operator()(const std::string& key, std::optional<T>& written, const T& otherwise, std::string from) {
    const bool given = written.has_value();
    if (!given) written = otherwise;
    values_.sources.push_back({key, in_words(key).unit, given,
                               given ? given_where(values_.written.origins, key) : std::move(from)});
    return *written;
  }

 private:
  SettingsValues& values_;
};

// Default laboratory air, without keys of the air or a height.
constexpr double usual_viscosity = 1.84e-5;   // [Pa s]
constexpr double usual_temperature = 293.15;  // [K]

void resolve_tape(Follow& follow, const Case& given, Case& written) {
  const TapeMaterial tape = tape_material(given);
  follow("parachute.tape.material", written.parachute.tape.material, tape.name, tape.from);
  if (!given.parachute.tape.material) take_tape(tape, written);
}

void resolve_air(Follow& follow, const Case& given, FlowKeys& keys, FlowSettings& flow) {
  const Air stream = air(given);
  flow.speed_m_s = stream.speed;
  flow.height_m = given.flow.height_m;
  flow.nominal_speed_m_s =
      follow("flow.speed_m_s", keys.speed_m_s, stream.speed,
             "start value from payload.mass_kg and the usual drag of the family; the run computes the speed");
  if (!given.flow.height_m) {
    flow.density_kg_m3 = follow("flow.density_kg_m3", keys.density_kg_m3, stream.density,
                                "the row of [[measured]] with this nominal speed");
    flow.temperature_k = follow("flow.temperature_k", keys.temperature_k, usual_temperature,
                                "default laboratory air (20 degC)");
    flow.viscosity_pa_s = follow("flow.viscosity_pa_s", keys.viscosity_pa_s, usual_viscosity,
                                 "default laboratory air (20 degC)");
    return;
  }
  const StandardAir standard = standard_air(*given.flow.height_m);
  const std::string from =
      fmt::format("the standard atmosphere at flow.height_m = {:g} m", *given.flow.height_m);
  flow.density_kg_m3 = follow("flow.density_kg_m3", keys.density_kg_m3, standard.density, from);
  flow.temperature_k = follow("flow.temperature_k", keys.temperature_k, standard.temperature, from);
  flow.viscosity_pa_s = follow("flow.viscosity_pa_s", keys.viscosity_pa_s, standard.viscosity, from);
}

void resolve_tunnel(Follow& follow, FlowKeys& keys, TunnelSettings& tunnel) {
  tunnel.kind = keys.tunnel.kind;
  if (tunnel.kind == TunnelKind::free_air) return;
  const auto take = [&](const char* key, auto& written, auto otherwise, const std::string& from) {
    return follow(std::string("flow.tunnel.") + key, written, otherwise, from);
  };
  TunnelKeys& given = keys.tunnel;
  const bool jet = tunnel.kind == TunnelKind::open_jet;
  Nozzle& nozzle = tunnel.nozzle;
  nozzle.shape = take("shape", given.shape, jet ? NozzleShape::circle : NozzleShape::rectangle,
                      jet ? "default of the open jet" : "the only shape of a closed test section");
  nozzle.width = given.width_m.value_or(0);  // validate() reports its absence
  if (nozzle.shape == NozzleShape::rectangle)
    nozzle.height = take("height_m", given.height_m, nozzle.width, "equal to the width");
  if (jet) {
    const bool placed = keys.canopy_position_m.has_value();
    tunnel.nozzle_distance_m =
        take("nozzle_distance_m", given.nozzle_distance_m, placed ? *keys.canopy_position_m : nozzle.width,
             placed ? "flow.canopy_position_m" : "one width of the nozzle");
    tunnel.outside_speed =
        take("outside_speed", given.outside_speed, jet_outside_speed, "default of the open jet");
    tunnel.shear_layer_m = take("shear_layer_m", given.shear_layer_m, jet_shear_layer * nozzle.width,
                                fmt::format("{:g} widths of the nozzle", jet_shear_layer));
  } else {
    tunnel.displacement_thickness_m = take("displacement_thickness_m", given.displacement_thickness_m, 0.0,
                                           "walls without boundary layers");
  }
}

/// By which the default domain and its core begin farther upstream because of the bodies, and the cells that the core
/// gains along the stream.
struct Room {
  double domain = 0, core = 0;  // [m]
  int cells = 0;
};

Room room_for_bodies(const Case& written, const FlowSettings& flow, double d) {
  if (written.bodies.empty() || flow.porosity_model != PorosityModel::sheet ||
      flow.tunnel.kind != TunnelKind::free_air)
    return {};
  const BodiesAhead ahead = bodies_ahead(written);
  Room room;
  room.domain = std::max(0.0, ahead.domain_front() - d * sheet_skirt);
  room.core = std::max(0.0, ahead.fine_front() - 0.25 * d * sheet_core.z);
  FlowSettings alone;
  alone.box_m = d * sheet_box, alone.cells = sheet_defaults.cells;
  alone.core.size_m = d * sheet_core, alone.core.growth = sheet_defaults.growth;
  alone.core.start_m = d * (sheet_skirt - 0.25 * sheet_core.z);
  room.cells = static_cast<int>(std::ceil(room.core / flow_grid(alone).spacing().z));
  return room;
}

/// The default domain of a cluster, along each axis.
struct ClusterRoom {
  Vec3 core, box;              // by which both are larger than for one canopy [m]
  double upstream = 0;         // the part of it upstream of the skirts [m]
  std::array<int, 3> cells{};  // more, for cells as wide as those of one canopy
};

/// The box is that of one canopy times the root of their number: in relation to the area of all canopies it is as wide
/// and as long. It extends at least as far from the outer canopies.
ClusterRoom room_for_cluster(const Case& written, const FlowSettings& flow, double d) {
  ClusterRoom room;
  if (!written.cluster || flow.porosity_model != PorosityModel::sheet) return room;
  const double wider = std::sqrt(double(written.cluster->canopies)) - 1, growth = sheet_defaults.growth;
  room.core = core_for_cluster(written, d);
  const Vec3 box = d * sheet_box;
  const auto widest = [&](double one, double core, double more) {
    return std::max({wider * one, more, least_box_over_core * (core + more) - one});
  };
  room.box = {widest(box.x, d * sheet_core.x, room.core.x), widest(box.y, d * sheet_core.y, room.core.y),
              wider * box.z + room.core.z};
  room.upstream = wider * d * sheet_skirt + 0.5 * room.core.z;
  FlowSettings alone;
  alone.box_m = box, alone.cells = sheet_defaults.cells;
  alone.core.size_m = d * sheet_core, alone.core.growth = growth;
  alone.core.start_m = d * (sheet_skirt - 0.25 * sheet_core.z);
  const Vec3 cell = flow_grid(alone).spacing();
  // Cells that grow from `h` by `growth` over a width.
  const auto growing = [&](double width, double h) {
    return std::log1p(width * (growth - 1) / (growth * h)) / std::log(growth);
  };
  const auto more = [&](double outside, double wider_by, double h) {
    return growing(outside + wider_by, h) - growing(outside, h);
  };
  const auto across = [&](double outside, double larger_box, double larger_core, double h) {
    const double added = 2 * more(outside, 0.5 * (larger_box - larger_core), h);
    return 2 * static_cast<int>(std::ceil(0.5 * (larger_core / h + added)));
  };
  const Vec3 outside = 0.5 * d * (sheet_box - sheet_core);
  const double before = alone.core.start_m, behind = box.z - before - alone.core.size_m.z;
  const double along = room.core.z / cell.z + more(before, wider * d * sheet_skirt, cell.z) +
                       more(behind, wider * (box.z - d * sheet_skirt), cell.z);
  room.cells = {across(outside.x, room.box.x, room.core.x, cell.x),
                across(outside.y, room.box.y, room.core.y, cell.y), static_cast<int>(std::ceil(along))};
  return room;
}

struct BoxDefault {
  Vec3 size;
  std::string from;
};

/// d: inflated diameters [m].
BoxDefault default_box(const FlowSettings& flow, const TunnelKeys& given, double d) {
  const bool sheet = flow.porosity_model == PorosityModel::sheet;
  BoxDefault box{sheet ? d * sheet_box : paper_box,
                 sheet ? fmt::format("{:g} x {:g} x {:g} inflated diameters of {:.3g} m", sheet_box.x,
                                     sheet_box.y, sheet_box.z, d)
                       : "default of the paper model"};
  const TunnelSettings& tunnel = flow.tunnel;
  const double width = tunnel.nozzle.width, height = nozzle_height(tunnel.nozzle);
  if (tunnel.kind == TunnelKind::closed) {
    const double lost = 2 * tunnel.displacement_thickness_m;
    return {{width - lost, height - lost, box.size.z}, "the test section; " + box.from};
  }
  if (tunnel.kind == TunnelKind::free_air) return box;
  const double behind = std::max((sheet_box.z - sheet_skirt) * d, jet_box_behind * width);
  return {
      {std::max(sheet_box.x * d, jet_box_across * width), std::max(sheet_box.y * d, jet_box_across * height),
       given.collector_distance_m ? *given.collector_distance_m : tunnel.nozzle_distance_m + behind},
      fmt::format("{:g} widths of the nozzle or {:g} inflated diameters of {:.3g} m; {}", jet_box_across,
                  sheet_box.x, d,
                  given.collector_distance_m ? std::string("to the collector")
                                             : fmt::format("{:g} or {:g} of them downstream of the skirt",
                                                           jet_box_behind, sheet_box.z - sheet_skirt))};
}

void resolve_core(Follow& follow, double d, const Room& room, const ClusterRoom& cluster, FlowKeys& keys,
                  FlowSettings& flow) {
  const bool sheet = flow.porosity_model == PorosityModel::sheet;
  const std::string model = sheet ? "default of the sheet model" : "default of the paper model";
  const Vec3 box = flow.box_m;
  Vec3 core = d * sheet_core + cluster.core;
  std::string from = fmt::format("{:g} x {:g} x {:g} inflated diameters of {:.3g} m", sheet_core.x,
                                 sheet_core.y, sheet_core.z, d);
  if (cluster.core.z > 0) from += "; wider and longer for the cluster";
  const auto wide = [](double side, double of_core) { return side >= least_box_over_core * of_core; };
  const bool all_wide = wide(box.x, core.x) && wide(box.y, core.y) && wide(box.z, core.z);
  if (sheet && flow.tunnel.kind == TunnelKind::closed) {  // its sides are where they are
    if (!wide(box.x, core.x)) core.x = 0;
    if (!wide(box.y, core.y)) core.y = 0;
    if (!wide(box.z, core.z)) core.z = 0;
    if (!all_wide) from += "; 0 where the test section is less than twice as wide";
  } else if (!sheet || !all_wide) {
    core = {};
    from = sheet ? "a side of the domain is less than twice as long as the core of this canopy" : model;
  }
  // Ahead of bodies the start of the core does not depend on its length.
  const double quarter =
      0.25 * ((keys.core.size_m && room.core == 0 ? keys.core.size_m->z : core.z) + cluster.core.z);
  if (core.z > 0 && room.core > 0) {
    core.z += room.core;
    from += fmt::format("; longer by {:.3g} m for the bodies", room.core);
  }
  flow.core.size_m = follow("flow.core.size_m", keys.core.size_m, core, from);
  const Vec3 size = flow.core.size_m;
  if (size.z > 0)
    flow.core.start_m =
        follow("flow.core.start_m", keys.core.start_m,
               std::max(0.0, std::min(flow.canopy_position_m - quarter - room.core, flow.box_m.z - size.z)),
               room.core > 0 ? "half a width upstream of the foremost body"
                             : "a quarter of the core upstream of the skirt");
  flow.core.growth =
      follow("flow.core.growth", keys.core.growth, (sheet ? sheet_defaults : paper_defaults).growth, model);
  const bool moves = sheet && keys.unsteady && size.x > 0 && size.y > 0;
  flow.core.off_axis =
      follow("flow.core.off_axis", keys.core.off_axis, moves ? in_time_off_axis : 0.0,
             moves ? "default of unsteady flow" : "default of steady flow and of uniform cells");
}

void resolve_box(Follow& follow, Case& written, FlowSettings& flow) {
  const Design& parachute = written.parachute;
  FlowKeys& keys = written.flow;
  const bool sheet = flow.porosity_model == PorosityModel::sheet;
  const bool jet = flow.tunnel.kind == TunnelKind::open_jet;
  const std::string model = sheet ? "default of the sheet model" : "default of the paper model";
  const double d = inflated_diameter(parachute);
  for (auto& [name, body] : written.bodies)
    follow("body." + name + ".trailing_distance_m", body.trailing_distance_m,
           usual_trailing_distance(parachute),
           "from the end of the riser to the skirt of the inflated canopy, about");
  const Room room = room_for_bodies(written, flow, d);
  const ClusterRoom cluster = room_for_cluster(written, flow, d);
  BoxDefault box = default_box(flow, keys.tunnel, d);
  box.size += cluster.box;
  if (cluster.core.z > 0) box.from += fmt::format("; larger for {} canopies", canopy_count(written));
  if (room.domain > 0) {
    box.size.z += room.domain;
    box.from += fmt::format("; longer by {:.3g} m for the bodies", room.domain);
  }
  flow.box_m = follow("flow.box_m", keys.box_m, box.size, box.from);
  std::array<int, 3> cells = sheet && jet ? jet_cells : (sheet ? sheet_defaults : paper_defaults).cells;
  cells[2] += room.cells;
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] += cluster.cells[i];
  flow.cells = follow("flow.cells", keys.cells, cells,
                      sheet && jet           ? "default of the sheet model in the wide domain of a jet"
                      : cluster.cells[2] > 0 ? model + ", and more for the cluster"
                      : room.cells == 0      ? model
                                             : fmt::format("{}, and {} for the bodies", model, room.cells));
  const double half = (flow.box_m.z + room.domain) / 2,
               upstream = d * sheet_skirt + room.domain + cluster.upstream;
  flow.canopy_position_m =
      jet ? follow("flow.canopy_position_m", keys.canopy_position_m, flow.tunnel.nozzle_distance_m,
                   "flow.tunnel.nozzle_distance_m; the domain begins at the nozzle")
      : sheet && upstream < half
          ? follow("flow.canopy_position_m", keys.canopy_position_m, upstream,
                   room.domain > 0
                       ? std::string("four widths of the widest body upstream of the foremost body")
                   : cluster.core.z > 0
                       ? fmt::format("{:g} inflated diameters of {:.3g} m times the root of {} canopies, and "
                                     "half the depth of the inclined skirts",
                                     sheet_skirt, d, canopy_count(written))
                       : fmt::format("{:g} inflated diameters of {:.3g} m", sheet_skirt, d))
          : follow("flow.canopy_position_m", keys.canopy_position_m, half, "half the length of the domain");
  resolve_core(follow, d, room, cluster, keys, flow);
}

/// Abilities of the engine; an unknown engine, which check_engine() reports, has all of them.
Abilities abilities_of(const std::string& engine) {
  for (const EngineRecord& one : engines())
    if (one.word == engine) return one.can;
  return engines().front().can;
}

void resolve_numerics(Follow& follow, Case& written, SettingsValues& values) {
  FlowSettings& flow = values.flow;
  FlowKeys& keys = written.flow;
  const bool sheet = flow.porosity_model == PorosityModel::sheet;
  const ModelDefaults& standard = sheet ? sheet_defaults : paper_defaults;
  const std::string model = sheet ? "default of the sheet model" : "default of the paper model";
  const Abilities can = abilities_of(flow.engine);
  const std::string lacking =
      fmt::format("the flow engine \"{}\" does not support the default of the sheet model", flow.engine);
  const bool sides_lack = !can.has_boundary(standard.sides.word),
             outlet_lacks = !can.has_boundary(standard.outlet.word),
             averages_lack = standard.average_over > 0 && !can.averages;
  flow.convection = follow("flow.convection", keys.convection, standard.convection, model);
  const TunnelKind tunnel = flow.tunnel.kind;
  flow.sides =
      tunnel == TunnelKind::free_air
          ? follow("flow.sides", keys.sides, sides_lack ? Sides::slip : standard.sides,
                   sides_lack ? lacking : model)
          : follow(
                "flow.sides", keys.sides, tunnel == TunnelKind::closed ? Sides::slip : Sides::entraining,
                tunnel == TunnelKind::closed ? "the walls of the test section" : "still air around the jet");
  flow.outlet =
      tunnel == TunnelKind::open_jet
          ? follow("flow.outlet", keys.outlet, Outlet::still_air, "still air around the jet")
          : follow("flow.outlet", keys.outlet, outlet_lacks ? Outlet::fixed_pressure : standard.outlet,
                   outlet_lacks ? lacking : model);
  flow.residual = follow("flow.residual", keys.residual, standard.residual, model);
  flow.max_iterations = follow("flow.max_iterations", keys.max_iterations, standard.max_iterations, model);
  flow.average_over = follow("flow.average_over", keys.average_over,
                             averages_lack ? 0 : std::min(standard.average_over, flow.max_iterations),
                             averages_lack ? lacking : model);
  CouplingSettings& coupling = values.coupling;
  static_cast<CouplingOptions&>(coupling) = written.coupling;
  coupling.load = follow("coupling.load", written.coupling.load, standard.load, model);
  coupling.drag_tolerance =
      follow("coupling.drag_tolerance", written.coupling.drag_tolerance, standard.drag_tolerance, model);
  // Of 1 mm at a nominal diameter of 1 m; to a micrometre, so that areas that are 1 m but for rounding have it.
  const double shape = std::max(1e-9, 1e-6 * std::round(1e3 * nominal_diameter(written.parachute)));
  coupling.shape_tolerance_m = follow("coupling.shape_tolerance_m", written.coupling.shape_tolerance_m, shape,
                                      "0.1 % of the nominal diameter");
}

}  // namespace

std::optional<Jet> jet_of(const TunnelSettings& tunnel) {
  if (tunnel.kind != TunnelKind::open_jet) return {};
  return Jet{tunnel.nozzle, tunnel.outside_speed, tunnel.shear_layer_m};
}

// An arm or gore lies flat in the start shape and has to fit into the core too.
double inflated_diameter(const Design& parachute) {
  constexpr double inflated_over_nominal = 0.7;
  return std::max(inflated_over_nominal * nominal_diameter(parachute),
                  start_diameter(parachute) / sheet_core.x);
}

SettingsValues settings_values(const Case& given) {
  SettingsValues values;
  values.written = given;
  Case& written = values.written;
  FlowSettings& flow = values.flow;
  static_cast<FlowOptions&>(flow) = given.flow;
  Follow follow(values);
  const Design& parachute = given.parachute;
  follow("parachute.nominal_area_m2", written.parachute.nominal_area_m2, nominal_area(parachute),
         "definition of the canopy family");
  follow("parachute.lines.onto_disk_m", written.parachute.lines.onto_disk_m, line_length_on_disk(parachute),
         "to the edge of the vent");
  resolve_tape(follow, given, written);
  resolve_air(follow, given, written.flow, flow);
  const Fabric& cloth = canopy_fabric(given);
  flow.porosity_model = follow("flow.porosity_model", written.flow.porosity_model, model_of(cloth.resistance),
                               fmt::format("model of the permeability of materials.{}", cloth.name));
  resolve_tunnel(follow, written.flow, flow.tunnel);
  resolve_box(follow, written, flow);
  resolve_numerics(follow, written, values);
  follow("inflation.line_segment_m", written.inflation.line_segment_m, parachute.mesh.line_segment_m,
         "parachute.mesh.line_segment_m");
  return values;
}

double cells_across(const Settings& resolved) {
  const FlowSettings& flow = resolved.flow();
  return smallest_size_ratio(resolved.written()) * inflated_diameter(resolved.parachute()) /
         flow_grid(flow).spacing({0, 0, flow.canopy_position_m}).x;
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
  const double start = flow.core.start_m, off = flow.core.off_axis;
  const auto core_from = [&](double x, double y) {
    return graded(grid, {x - 0.5 * size.x, y - 0.5 * size.y, start},
                  {x + 0.5 * size.x, y + 0.5 * size.y, start + size.z}, flow.core.growth);
  };
  const FlowGrid on_axis = core_from(0, 0);
  if (off == 0) return on_axis;
  const Vec3 cell = on_axis.spacing();
  return core_from(off * cell.x, 0.5 * off * cell.y);
}

}  // namespace ripstop::inline cases
