// The keys of [flow] and [coupling].
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "ripstop/case/resolve.h"
#include "ripstop/core/toml/fields.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flow/boundaries.h"

namespace ripstop::inline cases {
namespace {

template <class Value>
using Words = std::vector<std::pair<std::string, Value>>;
Words<Convection> convection_words() {
  return {{"upwind", Convection::upwind}, {"second-order", Convection::second_order}};
}
/// The kinds of boundary for one part of the box, which `maker` makes.
template <class Kind, class Maker>
Words<Kind> boundary_words(Maker BoundaryRecord::*maker) {
  Words<Kind> words;
  for (const auto& row : boundaries())
    if ((*row).*maker) words.emplace_back(row->word, Kind{row->word});
  return words;
}
Words<Sides> sides_words() {
  return boundary_words<Sides>(&BoundaryRecord::sides);
}
Words<Outlet> outlet_words() {
  return boundary_words<Outlet>(&BoundaryRecord::outlet);
}
/// As "slip": walls without friction; ...
template <class Maker>
std::string boundary_meanings(Maker BoundaryRecord::*maker) {
  std::string text;
  for (const auto& row : boundaries())
    if ((*row).*maker) text += fmt::format("{}\"{}\": {}", text.empty() ? "" : "; ", row->word, row->meaning);
  return text + ".";
}
Words<CanopyLoad> load_words() {
  return {
      {"of-flow", CanopyLoad::of_flow}, {"uniform", CanopyLoad::uniform}, {"sampled", CanopyLoad::sampled}};
}

/// As "6 d by 6 d by 9 d".
std::string in_diameters(const Vec3& of) {
  return fmt::format("{:g} d x {:g} d x {:g} d", of.x, of.y, of.z);
}

/// The default of a key in the reference: the sheet's, and the paper model's.
std::string by_model(const std::string& sheet, const std::string& paper) {
  return sheet == paper ? sheet : sheet + "; `paper`: " + paper;
}
std::string by_model(double sheet, double paper) {
  return by_model(fmt::format("`{}`", sheet), fmt::format("`{}`", paper));
}
std::string by_model(const std::array<int, 3>& sheet, const std::array<int, 3>& paper) {
  return by_model(fmt::format("`[{}]`", fmt::join(sheet, ", ")),
                  fmt::format("`[{}]`", fmt::join(paper, ", ")));
}
template <class Value>
std::string by_model(const Words<Value>& words, Value sheet, Value paper) {
  const auto quoted_word = [&](Value meaning) {
    for (const auto& [word, value] : words)
      if (value == meaning) return "`\"" + word + "\"`";
    return std::string();
  };
  return by_model(quoted_word(sheet), quoted_word(paper));
}

/// Keys of [flow]: the box, its cells, the canopy's place in it and how the cloth resists.
void describe_space(Fields& fields, FlowKeys& flow) {
  fields
      .vector(
          "box_m", flow.box_m, above(0).up_to(1000),
          "Flow domain: width, height, length along the flow ([NFM] section 5). With bodies or a cluster, "
          "domain, cells and fine core are larger by default; ripstop check prints them.")
      .absent(by_model(in_diameters(sheet_box),
                       fmt::format("`[{:g}, {:g}, {:g}]`", paper_box.x, paper_box.y, paper_box.z)));
  fields.integers("cells", flow.cells, from(4).up_to(2000), "Number of cells along each side of the domain.")
      .absent(by_model(sheet_defaults.cells, paper_defaults.cells));
  fields.table("core", flow.core,
               "Fine core: smaller cells around the canopy, so that the domain may be wide.");
  fields
      .number("canopy_position_m", flow.canopy_position_m, above(0).up_to(1000),
              "Distance from the inlet to the skirt of the undeformed start shape.")
      .absent(by_model(fmt::format("half the length of the domain, at most {:g} d", sheet_skirt),
                       "half the length of the domain"));
  fields
      .choice("porosity_model", flow.porosity_model,
              {{"paper", PorosityModel::paper}, {"sheet", PorosityModel::sheet}},
              "Model of porous cloth. \"paper\": resistance by darcy_1_m2 and forchheimer_1_m in every cell "
              "that the canopy intersects; \"sheet\": porous sheet with the pressure drop a v + b v|v|, "
              "independent of the cell size.")
      .absent("model for which the canopy material has coefficients");
}

/// Keys of [flow]: the equations' numerics and the sides of the box.
void describe_numerics(Fields& fields, FlowKeys& flow) {
  fields
      .choice("convection", flow.convection, convection_words(),
              "Discretisation of the convection of velocity. \"upwind\": first order, as in [NFM]; "
              "\"second-order\": limited linear (OpenFOAM: linearUpwind; unsteady flow: LUST).")
      .absent(by_model(convection_words(), sheet_defaults.convection, paper_defaults.convection));
  fields
      .choice(
          "sides", flow.sides, sides_words(),
          "Boundary condition at the four sides of the domain. " + boundary_meanings(&BoundaryRecord::sides))
      .absent(by_model(sides_words(), sheet_defaults.sides, paper_defaults.sides));
  fields
      .choice("outlet", flow.outlet, outlet_words(),
              "Boundary condition at the end of the domain. " + boundary_meanings(&BoundaryRecord::outlet))
      .absent(by_model(outlet_words(), sheet_defaults.outlet, paper_defaults.outlet));
  fields
      .number("residual", flow.residual, above(0).up_to(0.1),
              "Residual of every equation at which a flow solution is converged.")
      .absent(by_model(sheet_defaults.residual, paper_defaults.residual));
  fields
      .integer("max_iterations", flow.max_iterations, from(1).up_to(1'000'000),
               "Largest number of iterations of one flow solution.")
      .absent(by_model(sheet_defaults.max_iterations, paper_defaults.max_iterations));
  fields
      .integer("average_over", flow.average_over, from(0).up_to(1'000'000),
               "Number of last iterations over which a flow solution that did not converge is averaged; 0: "
               "the last iteration is used (built-in engine only).")
      .absent(by_model(sheet_defaults.average_over, paper_defaults.average_over) +
              "; at most max_iterations");
}

}  // namespace

void describe(Fields& fields, CoreKeys& core) {
  fields
      .vector("size_m", core.size_m, from(0).up_to(1000),
              "Width, height and length of the region with uniform cells, around the axis of the domain. "
              "Outside of it the cells grow towards the boundaries. 0: uniform along that axis.")
      .absent(by_model(in_diameters(sheet_core) + ", 0 where a side of the domain is less than twice that",
                       "`[0, 0, 0]`"));
  fields.number("start_m", core.start_m, from(0).up_to(1000), "Distance from the inlet to the fine core.")
      .absent(
          "such that a quarter of its length is upstream of the canopy; with bodies half a width upstream of "
          "the foremost one");
  fields
      .number("growth", core.growth, above(1).up_to(2),
              "Largest ratio of a cell's width to that of its inner neighbour.")
      .absent(by_model(sheet_defaults.growth, paper_defaults.growth));
  fields
      .number("off_axis", core.off_axis, from(0).up_to(0.5),
              "Grid alignment: offset of the centre of the uniform cells from the canopy axis along x, in "
              "cells. The offset along y is half of it.")
      .absent(fmt::format("`{:g}` for a sheet in unsteady flow, else `0`", in_time_off_axis));
}

void describe(Fields& fields, WatchKeys& watch) {
  fields.number("courant", watch.courant, above(0).up_to(1),
                "Largest Courant number of a cell, summed over the axes. It determines the time step.");
  fields.number("standard_error", watch.standard_error, above(0).up_to(0.2),
                "Relative standard error of the mean drag at which the averaging window ends.");
  fields.number("shortest", watch.shortest, from(5).up_to(1e5),
                "Shortest averaging window, in units of inflated diameter over stream speed.");
  fields.number(
      "longest", watch.longest, from(10).up_to(1e6),
      "Longest record in the same unit, including the start-up; at least twice the shortest window.");
  fields.choice("eddies", watch.eddies, {{"des", SmallEddies::des}, {"wale", SmallEddies::wale}},
                "Subgrid-scale model. \"des\": k-omega SST with the dissipation of detached-eddy simulation; "
                "\"wale\": eddy viscosity from the velocity gradient.");
}

void describe(Fields& fields, TunnelKeys& tunnel) {
  fields.choice(
      "kind", tunnel.kind,
      {{"free-air", TunnelKind::free_air},
       {"open-jet", TunnelKind::open_jet},
       {"closed", TunnelKind::closed}},
      "\"free-air\": the stream fills the domain; \"open-jet\": a nozzle blows into still air, and the "
      "domain begins at its exit (built-in engine only); \"closed\": a test section whose walls are the "
      "sides of the domain. speed_m_s is the speed at the nozzle or in the empty test section.");
  fields
      .choice(
          "shape", tunnel.shape,
          {{"circle", NozzleShape::circle},
           {"octagon", NozzleShape::octagon},
           {"rectangle", NozzleShape::rectangle}},
          "Cross section of the nozzle, centred on the canopy axis; a closed test section is a rectangle.")
      .absent("`\"circle\"`; closed: `\"rectangle\"`");
  fields
      .number("width_m", tunnel.width_m, above(0).up_to(200),
              "Diameter of a circle, width across the flats of a regular octagon, or width of a rectangle.")
      .absent("required, except in free air");
  fields.number("height_m", tunnel.height_m, above(0).up_to(200), "Height of a rectangle.")
      .absent("`width_m`");
  fields
      .number("nozzle_distance_m", tunnel.nozzle_distance_m, above(0).up_to(1000),
              "Distance from the nozzle exit to the skirt of the undeformed start shape (open jet).")
      .absent("`flow.canopy_position_m`, else `width_m`");
  fields
      .number("collector_distance_m", tunnel.collector_distance_m, above(0).up_to(1000),
              "Distance from the nozzle exit to the collector, which is at ambient pressure and ends the "
              "domain (open jet).")
      .absent(fmt::format("no collector: at least {:g} `width_m` downstream of the skirt", jet_box_behind));
  fields
      .number("outside_speed", tunnel.outside_speed, from(0.01).up_to(0.5),
              "Speed of the air around the nozzle over the speed of the jet (open jet).")
      .absent(fmt::format("`{:g}`", jet_outside_speed));
  fields
      .number("shear_layer_m", tunnel.shear_layer_m, above(0).up_to(10),
              "Thickness of the shear layer at the nozzle: speed difference over the largest speed gradient.")
      .absent(fmt::format("{:g} `width_m`", jet_shear_layer));
  fields
      .number("displacement_thickness_m", tunnel.displacement_thickness_m, from(0).up_to(10),
              "Displacement thickness of the boundary layer, by which each wall is moved inward (closed).")
      .absent("`0`");
}

void describe(Fields& fields, FlowKeys& flow) {
  Words<std::string> words;
  std::string meanings;
  for (const EngineRecord& engine : engines()) {
    words.emplace_back(engine.word, engine.word);
    meanings += (meanings.empty() ? "" : ", or ") + engine.meaning;
  }
  fields.choice("engine", flow.engine, words, "Flow solver: " + meanings + ".");
  fields
      .number("speed_m_s", flow.speed_m_s, above(0).up_to(fastest_stream),
              "Free-stream speed, below Mach 0.3, the limit of the flow model. With payload.mass_kg: start "
              "value of the iteration for the speed.")
      .absent("required, unless payload.mass_kg is given");
  fields.choice("speed_basis", flow.speed_basis,
                {{"nominal", SpeedBasis::nominal}, {"measured", SpeedBasis::measured}},
                "\"nominal\": speed_m_s is the speed of the stream; \"measured\": the measured speed of the "
                "row of [[measured]] with this nominal speed is used.");
  fields
      .number("height_m", flow.height_m, from(lowest_height).up_to(highest_height),
              "Height above sea level, which determines density and temperature by the U.S. Standard "
              "Atmosphere, 1976.")
      .absent("the density determines the air");
  fields.number("density_kg_m3", flow.density_kg_m3, above(0).up_to(20), "Density of the air.")
      .absent("from height_m, else from the row of [[measured]] whose nominal speed is speed_m_s");
  fields.number("viscosity_pa_s", flow.viscosity_pa_s, above(0).up_to(1e-2), "Dynamic viscosity.")
      .absent("from height_m, else `1.84e-05`");
  fields
      .number("temperature_k", flow.temperature_k, from(100).up_to(1000),
              "Temperature of the air; the pressure follows from the density.")
      .absent("from height_m, else `293.15`");
  fields.number("turbulence_intensity", flow.turbulence_intensity, above(0).up_to(1),
                "Turbulence intensity at the inlet (assumed).");
  fields.number("viscosity_ratio", flow.viscosity_ratio, above(0).up_to(1e5),
                "Eddy viscosity over viscosity at the inlet (assumed).");
  fields.number("angle_of_attack_deg", flow.angle_of_attack_deg, from(0).up_to(90),
                "Angle between the stream and the z axis. Values above 0 are accepted only by the flow "
                "interface of the library. `ripstop stability` sets the angle itself; steady runs and "
                "openings have the stream along the axis.");
  fields.number("azimuth_deg", flow.azimuth_deg, from(-360).up_to(360),
                "Azimuth of the plane of this angle, from the x axis towards the y axis.");
  describe_space(fields, flow);
  fields.table("tunnel", flow.tunnel, "Wind tunnel around the canopy (docs/guide/tunnel.md).");
  describe_numerics(fields, flow);
  fields.choice(
      "symmetry", flow.symmetry,
      {{"auto", FlowSymmetry::automatic}, {"full", FlowSymmetry::full}, {"quarter", FlowSymmetry::quarter}},
      "Part of the domain that a steady run solves. \"full\": the whole domain. \"quarter\": a quarter with "
      "planes of symmetry at x = 0 and y = 0, whose flow is mirrored. \"auto\": a "
      "quarter if the cloth is a sheet, canopy, cells and stream are symmetric, and 16 or more cells lie "
      "across the canopy, else the whole domain. Unsteady runs, openings and flights use the whole domain.");
  fields.choice("mesh", flow.mesh, {{"grid", FlowMesh::grid}, {"fitted", FlowMesh::fitted}},
                "\"grid\": cloth is represented by faces of the cells of the domain; \"fitted\": cells are "
                "fitted to the cloth (snappyHexMesh of OpenFOAM, for the \"sheet\" model).");
  fields.integer("cloth_levels", flow.cloth_levels, from(0).up_to(4),
                 "Number of times that the cells at the cloth are halved (fitted mesh).");
  fields.integer("ranks", flow.ranks, from(1).up_to(4096), "Number of processes of the flow solver.");
  fields.toggle("unsteady", flow.unsteady,
                "Continue in time after the steady coupling and average the unsteady wake, with the standard "
                "error of the mean (built-in engine only).");
  fields.table("watch", flow.watch, "Averaging window of an unsteady flow.");
  fields.number("time_limit_s", flow.time_limit_s, from(0).up_to(1e7),
                "Longest wall time of one flow solution; 0: none.");
}

void describe(Fields& fields, CouplingKeys& coupling) {
  fields
      .choice("load", coupling.load, load_words(),
              "Load of the flow on the cloth. \"of-flow\": momentum that the air loses at every piece of "
              "cloth (\"sheet\" model only); \"uniform\": one pressure difference; \"sampled\": pressures "
              "sampled on both sides, scaled to the air load.")
      .absent(by_model(load_words(), sheet_defaults.load, paper_defaults.load));
  fields
      .number(
          "drag_tolerance", coupling.drag_tolerance, above(0).up_to(1),
          "Relative change of drag between two coupling iterations below which the coupling can converge.")
      .absent(by_model(sheet_defaults.drag_tolerance, paper_defaults.drag_tolerance));
  fields
      .number("shape_tolerance_m", coupling.shape_tolerance_m, above(0).up_to(10),
              "Mean displacement of the nodes between two coupling iterations below which it can converge.")
      .absent("0.1 % of the nominal diameter");
  fields.integer("max_iterations", coupling.max_iterations, from(1).up_to(10000),
                 "Largest number of coupling iterations.");
  fields.number("relaxation", coupling.relaxation, above(0).up_to(1),
                "Relaxation factor of the load on the cloth.");
  fields.choice(
      "acceleration", coupling.acceleration,
      {{"none", Acceleration::none}, {"aitken", Acceleration::aitken}, {"anderson", Acceleration::anderson}},
      "Convergence acceleration of the coupling iterations.");
  fields.number("cloth_tolerance", coupling.cloth_tolerance, above(0).up_to(0.1),
                "Ratio of residual to applied force below which the cloth is in equilibrium.");
  fields.toggle(
      "coarse_start", coupling.coarse_start,
      "First solve the coupling on cells twice as wide, and start from that shape, load and flow. "
      "Requires the built-in engine, the \"sheet\" model, 16 or more cells across the canopy, and no "
      "open jet.");
  fields.toggle("linear", coupling.linear,
                "Linear material model: only the stiffness coefficient K_1 of every material.");
  fields.integer("threads", coupling.threads, from(0).up_to(1024),
                 "Number of threads of the cloth solver; 0: one per core.");
}

}  // namespace ripstop::inline cases
