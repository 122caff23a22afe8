// The keys of [flow] and [coupling].
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "ripstop/case/resolve.h"
#include "ripstop/core/toml/fields.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flow/boundaries.h"

namespace ripstop {
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
      .vector("box_m", flow.box_m, above(0).up_to(1000),
              "Box of air: width, height, length along the flow ([NFM] section 5).")
      .absent(by_model(in_diameters(sheet_box),
                       fmt::format("`[{:g}, {:g}, {:g}]`", paper_box.x, paper_box.y, paper_box.z)));
  fields.integers("cells", flow.cells, from(4).up_to(2000), "Cells along each side of the box.")
      .absent(by_model(sheet_defaults.cells, paper_defaults.cells));
  fields.table("core", flow.core, "Cells that are finer about the canopy, so that the box may be wide.");
  fields
      .number("canopy_position_m", flow.canopy_position_m, above(0).up_to(1000),
              "Distance from the inlet to the skirt of the undeformed start shape.")
      .absent(by_model(fmt::format("half the length of the box, at most {:g} d", sheet_skirt),
                       "half the length of the box"));
  fields
      .choice("porosity_model", flow.porosity_model,
              {{"paper", PorosityModel::paper}, {"sheet", PorosityModel::sheet}},
              "\"paper\": the cloth's darcy_1_m2 and forchheimer_1_m as resistance of every cell that the "
              "canopy cuts; "
              "\"sheet\": as the pressure drop a v + b v|v| across the cloth, whatever the cells.")
      .absent("what the canopy cloth's coefficients are for");
}

/// Keys of [flow]: the equations' numerics and the sides of the box.
void describe_numerics(Fields& fields, FlowKeys& flow) {
  fields
      .choice("convection", flow.convection, convection_words(),
              "Of the velocity. \"upwind\": first order, as [NFM]; \"second-order\": limited linear.")
      .absent(by_model(convection_words(), sheet_defaults.convection, paper_defaults.convection));
  fields
      .choice("sides", flow.sides, sides_words(),
              "The four sides of the box. " + boundary_meanings(&BoundaryRecord::sides))
      .absent(by_model(sides_words(), sheet_defaults.sides, paper_defaults.sides));
  fields
      .choice("outlet", flow.outlet, outlet_words(),
              "The end of the box. " + boundary_meanings(&BoundaryRecord::outlet))
      .absent(by_model(outlet_words(), sheet_defaults.outlet, paper_defaults.outlet));
  fields
      .number("residual", flow.residual, above(0).up_to(0.1),
              "Residual of every equation at which a solution ends.")
      .absent(by_model(sheet_defaults.residual, paper_defaults.residual));
  fields
      .integer("max_iterations", flow.max_iterations, from(1).up_to(1'000'000),
               "Most iterations of one flow solution.")
      .absent(by_model(sheet_defaults.max_iterations, paper_defaults.max_iterations));
  fields
      .integer("average_over", flow.average_over, from(0).up_to(1'000'000),
               "Iterations at the end of a flow solution that did not settle, whose mean is taken for it; 0: "
               "the last one stands (built-in engine only).")
      .absent(by_model(sheet_defaults.average_over, paper_defaults.average_over) +
              "; at most max_iterations");
}

}  // namespace

void describe(Fields& fields, CoreKeys& core) {
  fields
      .vector(
          "size_m", core.size_m, from(0).up_to(1000),
          "Width, height, length of the part of the box with uniform cells, about the box's axis; outside "
          "of it cells grow toward the sides. 0: uniform along that axis.")
      .absent(by_model(in_diameters(sheet_core) + ", 0 where a side of the box is less than twice that",
                       "`[0, 0, 0]`"));
  fields.number("start_m", core.start_m, from(0).up_to(1000), "Distance from the inlet to the fine part.")
      .absent("such that a quarter of its length lies before the canopy");
  fields
      .number("growth", core.growth, above(1).up_to(2),
              "Largest ratio of a cell's width to that of its inner neighbour.")
      .absent(by_model(sheet_defaults.growth, paper_defaults.growth));
  fields
      .number(
          "off_axis", core.off_axis, from(0).up_to(0.5),
          "How far the middle of the uniform cells lies beside the canopy's axis, in cells: so much along "
          "x, half as much along y.")
      .absent(fmt::format("`{:g}` for a sheet in time, else `0`", in_time_off_axis));
}

void describe(Fields& fields, WatchKeys& watch) {
  fields.number("courant", watch.courant, above(0).up_to(1),
                "Largest Courant number of a cell, summed over the axes: how long a step is.");
  fields.number("standard_error", watch.standard_error, above(0).up_to(0.2),
                "Of the mean drag, relative, at which the watch ends.");
  fields.number(
      "shortest", watch.shortest, from(5).up_to(1e5),
      "Least time that the mean is taken over, in times that the stream takes for one inflated diameter.");
  fields.number("longest", watch.longest, from(10).up_to(1e6),
                "Longest watch in the same unit, start-up included; at least twice the shortest.");
  fields.choice(
      "eddies", watch.eddies, {{"des", SmallEddies::des}, {"wale", SmallEddies::wale}},
      "Where the viscosity of eddies comes from that the cells do not resolve: \"des\", the k-omega SST "
      "model with the sink of detached-eddy simulation; \"wale\", the velocity's gradient.");
}

void describe(Fields& fields, TunnelKeys& tunnel) {
  fields.choice(
      "kind", tunnel.kind,
      {{"free-air", TunnelKind::free_air},
       {"open-jet", TunnelKind::open_jet},
       {"closed", TunnelKind::closed}},
      "\"free-air\": the stream fills the box; \"open-jet\": a nozzle blows into still air, and the "
      "box begins at its end (built-in engine only); \"closed\": a test section whose walls are the "
      "sides of the box. speed_m_s is the nozzle's, or the empty test section's.");
  fields
      .choice("shape", tunnel.shape,
              {{"circle", NozzleShape::circle},
               {"octagon", NozzleShape::octagon},
               {"rectangle", NozzleShape::rectangle}},
              "Of the nozzle, about the canopy's axis; a closed test section is a rectangle.")
      .absent("`\"circle\"`; closed: `\"rectangle\"`");
  fields
      .number("width_m", tunnel.width_m, above(0).up_to(200),
              "Diameter of a circle, across the flats of a regular octagon, width of a rectangle.")
      .absent("refused, unless in free air");
  fields.number("height_m", tunnel.height_m, above(0).up_to(200), "Of a rectangle.").absent("`width_m`");
  fields
      .number("nozzle_distance_m", tunnel.nozzle_distance_m, above(0).up_to(1000),
              "From the end of the nozzle to the skirt of the undeformed start shape (open jet).")
      .absent("`flow.canopy_position_m`, else `width_m`");
  fields
      .number("collector_distance_m", tunnel.collector_distance_m, above(0).up_to(1000),
              "From the end of the nozzle to the collector, at the room's pressure, where the box ends (open "
              "jet).")
      .absent(fmt::format("no collector: at least {:g} `width_m` behind the skirt", jet_box_behind));
  fields
      .number("outside_speed", tunnel.outside_speed, from(0.01).up_to(0.5),
              "Speed of the air round the nozzle over the nozzle's (open jet).")
      .absent(fmt::format("`{:g}`", jet_outside_speed));
  fields
      .number("shear_layer_m", tunnel.shear_layer_m, above(0).up_to(10),
              "Thickness of the jet's edge at the nozzle: the difference of speed over its largest slope.")
      .absent(fmt::format("{:g} `width_m`", jet_shear_layer));
  fields
      .number("displacement_thickness_m", tunnel.displacement_thickness_m, from(0).up_to(10),
              "Of the boundary layer of each wall, which stands that far further in (closed).")
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
      .number(
          "speed_m_s", flow.speed_m_s, above(0).up_to(100),
          "Free-stream speed; below Mach 0.3, where the canopy's flow model holds. Beside payload.mass_kg: "
          "where the search for the speed begins.")
      .absent("needed, unless payload.mass_kg is given");
  fields.choice(
      "speed_basis", flow.speed_basis, {{"nominal", SpeedBasis::nominal}, {"measured", SpeedBasis::measured}},
      "\"nominal\": speed_m_s is used as it is; \"measured\": the measured speed of the row of [[measured]] "
      "whose nominal speed it is.");
  fields
      .number("height_m", flow.height_m, from(lowest_height).up_to(highest_height),
              "Height above sea level, in place of density and temperature: those of the U.S. Standard "
              "Atmosphere, "
              "1976.")
      .absent("the air is given by its density");
  fields.number("density_kg_m3", flow.density_kg_m3, above(0).up_to(20), "Density of the air.")
      .absent("of height_m, else of the row of [[measured]] whose nominal speed is speed_m_s");
  fields.number("viscosity_pa_s", flow.viscosity_pa_s, above(0).up_to(1e-2), "Dynamic viscosity.")
      .absent("of height_m, else `1.84e-05`");
  fields
      .number("temperature_k", flow.temperature_k, from(100).up_to(1000),
              "Temperature of the air; the pressure follows from the density.")
      .absent("of height_m, else `293.15`");
  fields.number("turbulence_intensity", flow.turbulence_intensity, above(0).up_to(1),
                "At the inlet (assumed).");
  fields.number("viscosity_ratio", flow.viscosity_ratio, above(0).up_to(1e5),
                "Eddy viscosity over viscosity at the inlet (assumed).");
  fields.number("angle_of_attack_deg", flow.angle_of_attack_deg, from(0).up_to(90),
                "Angle between the stream and the z axis. Only the flow problem of the library takes one "
                "above 0; steady "
                "runs and openings hold the canopy on the axis of the stream.");
  fields.number("azimuth_deg", flow.azimuth_deg, from(-360).up_to(360),
                "Of the plane of this angle: from the x axis towards the y axis.");
  describe_space(fields, flow);
  fields.table("tunnel", flow.tunnel, "What the air comes out of; docs/guide/tunnel.md.");
  describe_numerics(fields, flow);
  fields.choice(
      "mesh", flow.mesh, {{"grid", FlowMesh::grid}, {"fitted", FlowMesh::fitted}},
      "\"grid\": cloth parts the box's cells where it stands between their centres; \"fitted\": cells are "
      "moved onto the cloth (OpenFOAM's snappyHexMesh, for the \"sheet\" model).");
  fields.integer("cloth_levels", flow.cloth_levels, from(0).up_to(4),
                 "Times that the cells at the cloth are halved (fitted).");
  fields.integer("ranks", flow.ranks, from(1).up_to(4096), "Processes of the flow solver.");
  fields.toggle(
      "unsteady", flow.unsteady,
      "Go on in time once the steady loop has ended: the mean over a wake that sheds, with its standard "
      "error (built-in engine only).");
  fields.table("watch", flow.watch, "How long an unsteady flow is watched.");
  fields.number("time_limit_s", flow.time_limit_s, from(0).up_to(1e7),
                "Longest wall time of one flow solution; 0: none.");
}

void describe(Fields& fields, CouplingKeys& coupling) {
  fields
      .choice(
          "load", coupling.load, load_words(),
          "The flow's force on the cloth. \"of-flow\": what the air loses on every piece of cloth (\"sheet\" "
          "model only); \"uniform\": one pressure difference; \"sampled\": the pressures read on both sides, "
          "scaled.")
      .absent(by_model(load_words(), sheet_defaults.load, paper_defaults.load));
  fields
      .number("drag_tolerance", coupling.drag_tolerance, above(0).up_to(1),
              "Relative change of drag between two iterations at which the coupling may end.")
      .absent(by_model(sheet_defaults.drag_tolerance, paper_defaults.drag_tolerance));
  fields
      .number("shape_tolerance_m", coupling.shape_tolerance_m, above(0).up_to(10),
              "Mean displacement of the nodes between two iterations at which it may end.")
      .absent("0.1 % of the nominal diameter");
  fields.integer("max_iterations", coupling.max_iterations, from(1).up_to(10000),
                 "Most iterations of the coupling.");
  fields.number("relaxation", coupling.relaxation, above(0).up_to(1),
                "Share of a new iterate that is taken.");
  fields.choice(
      "acceleration", coupling.acceleration,
      {{"none", Acceleration::none}, {"aitken", Acceleration::aitken}, {"anderson", Acceleration::anderson}},
      "How iterates are combined.");
  fields.number("cloth_tolerance", coupling.cloth_tolerance, above(0).up_to(0.1),
                "Residual force over applied force at which the cloth is in equilibrium.");
  fields.toggle("linear", coupling.linear, "Keep only K_1 of every law: the linear model of [NFM].");
  fields.integer("threads", coupling.threads, from(0).up_to(1024),
                 "Threads of the cloth solver; 0: one a core.");
}

}  // namespace ripstop
