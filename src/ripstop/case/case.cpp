#include "ripstop/case/case.h"

#include <algorithm>
#include <cmath>

#include "ripstop/core/toml/fields.h"

namespace ripstop {
namespace {

template <class Kind>
const Kind& material(const Case& value, const std::string& name) {
  const auto found = value.materials.find(name);
  const Kind* chosen = found == value.materials.end() ? nullptr : std::get_if<Kind>(&found->second);
  if (!chosen)
    throw Error(ExitCode::usage, "the case has no material \"" + name + "\" of the kind that is needed");
  return *chosen;
}

}  // namespace

void describe(Fields& fields, CoreSettings& core) {
  fields.vector(
      "size_m", core.size_m, from(0).up_to(1000),
      "Width, height, length of the part of the box with uniform cells, about the box's axis; outside "
      "of it cells grow toward the sides. 0: uniform along that axis.");
  fields.number("start_m", core.start_m, from(0).up_to(1000), "Distance from the inlet to the fine part.")
      .absent("such that a quarter of its length lies before the canopy");
  fields.number("growth", core.growth, above(1).up_to(2),
                "Largest ratio of a cell's width to that of its inner neighbour.");
}

void describe(Fields& fields, FlowSettings& flow) {
  std::vector<std::pair<std::string, std::string>> words;
  std::string meanings;
  for (const EngineRecord& engine : engines()) {
    words.emplace_back(engine.word, engine.word);
    meanings += (meanings.empty() ? "" : ", or ") + engine.meaning;
  }
  fields.choice("engine", flow.engine, words, "Flow solver: " + meanings + ".");
  fields
      .number("speed_m_s", flow.speed_m_s, above(0).up_to(100),
              "Free-stream speed; below Mach 0.3, where the canopy's flow model holds.")
      .required();
  fields.choice(
      "speed_basis", flow.speed_basis, {{"nominal", SpeedBasis::nominal}, {"measured", SpeedBasis::measured}},
      "\"nominal\": speed_m_s is used as it is; \"measured\": the measured speed of the row of [[measured]] "
      "whose nominal speed it is.");
  fields.number("density_kg_m3", flow.density_kg_m3, above(0).up_to(20), "Density of the air.")
      .absent("of the row of [[measured]] whose nominal speed is speed_m_s");
  fields.number("viscosity_pa_s", flow.viscosity_pa_s, above(0).up_to(1e-2), "Dynamic viscosity.");
  fields.number("temperature_k", flow.temperature_k, from(100).up_to(1000),
                "Temperature of the air; the pressure follows from the density.");
  fields.number("turbulence_intensity", flow.turbulence_intensity, above(0).up_to(1),
                "At the inlet (assumed).");
  fields.number("viscosity_ratio", flow.viscosity_ratio, above(0).up_to(1e5),
                "Eddy viscosity over viscosity at the inlet (assumed).");
  fields.vector("box_m", flow.box_m, above(0).up_to(1000),
                "Box of air: width, height, length along the flow ([NFM] section 5).");
  fields.integers("cells", flow.cells, from(4).up_to(2000), "Cells along each side of the box.");
  fields.table("core", flow.core, "Cells that are finer about the canopy, so that the box may be wide.");
  fields
      .number("canopy_position_m", flow.canopy_position_m, above(0).up_to(1000),
              "Distance from the inlet to the skirt of the undeformed start shape.")
      .absent("half the length of the box");
  fields.choice("porosity_model", flow.porosity_model,
                {{"of-cloth", PorosityModel::of_cloth},
                 {"paper", PorosityModel::paper},
                 {"sheet", PorosityModel::sheet}},
                "\"of-cloth\": what the canopy cloth's coefficients are for; \"paper\": the cloth's darcy "
                "and forchheimer as resistance of every cell that the canopy cuts; "
                "\"sheet\": as the pressure drop a v + b v|v| across the cloth, whatever the cells "
                "(built-in engine only).");
  fields.choice("convection", flow.convection,
                {{"upwind", Convection::upwind}, {"second-order", Convection::second_order}},
                "Of the velocity. \"upwind\": first order, as [NFM]; \"second-order\": limited linear.");
  fields.choice(
      "sides", flow.sides,
      {{"zero-gradient", Sides::zero_gradient}, {"slip", Sides::slip}, {"entraining", Sides::entraining}},
      "The four sides of the box. \"zero-gradient\": open, as [NFM]; \"slip\": walls without friction; "
      "\"entraining\": air of the stream may come in with its total pressure (built-in engine only).");
  fields.choice(
      "outlet", flow.outlet, {{"fixed-pressure", Outlet::fixed_pressure}, {"still-air", Outlet::still_air}},
      "The end of the box. \"fixed-pressure\": it is held, and air that comes back has no "
      "momentum, as [NFM]; \"still-air\": air that comes back has the total pressure of air at rest "
      "(built-in engine only; the default of the \"sheet\" model).");
  fields.number("residual", flow.residual, above(0).up_to(0.1),
                "Residual of every equation at which a solution ends.");
  fields.integer("max_iterations", flow.max_iterations, from(1).up_to(1'000'000),
                 "Most iterations of one flow solution.");
  fields.integer(
      "average_over", flow.average_over, from(0).up_to(1'000'000),
      "Iterations at the end of a flow solution that did not settle, whose mean is taken for it; 0: "
      "the last one stands (built-in engine only).");
  fields.integer("ranks", flow.ranks, from(1).up_to(4096), "Processes of the flow solver.");
  fields.number("time_limit_s", flow.time_limit_s, from(0).up_to(1e7),
                "Longest wall time of one flow solution; 0: none.");
}

void describe(Fields& fields, CouplingSettings& coupling) {
  fields.choice(
      "load", coupling.load,
      {{"of-flow", CanopyLoad::of_flow}, {"uniform", CanopyLoad::uniform}, {"sampled", CanopyLoad::sampled}},
      "The flow's force on the cloth. \"uniform\": one pressure difference; \"of-flow\": what the air loses "
      "on every piece of cloth (\"sheet\" model only); \"sampled\": the pressures read on both sides, "
      "scaled.");
  fields.number("drag_tolerance", coupling.drag_tolerance, above(0).up_to(1),
                "Relative change of drag between two iterations at which the coupling may end.");
  fields.number("shape_tolerance_m", coupling.shape_tolerance_m, above(0).up_to(10),
                "Mean displacement of the nodes between two iterations at which it may end.");
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

void describe(Fields& fields, InflationSettings& inflation) {
  fields
      .number("initial_radius_m", inflation.initial_radius_m, above(0).up_to(1000),
              "Radius of the folded skirt, midway between its inner and outer folds.")
      .absent("needed by ripstop inflate");
  fields.integer("folds", inflation.folds, from(0).up_to(1000),
                 "Outer folds round the canopy, as many inner ones; 0: one a line.");
  fields.number("slack_m", inflation.slack_m, from(0).up_to(1000),
                "By which the lines are longer than their way from confluence to skirt.");
  fields
      .number("pressure_pa", inflation.pressure_pa, above(0).up_to(1e6),
              "Uniform pressure difference over the canopy.")
      .absent("from drag_coefficient, or from a steady run given on the command line");
  fields
      .number("drag_coefficient", inflation.drag_coefficient, above(0).up_to(5),
              "C_D on S0: the pressure is such that the steady drag is C_D S0 q at the speed of [flow].")
      .absent("from pressure_pa, or from a steady run given on the command line");
  fields.number("ramp_s", inflation.ramp_s, from(0).up_to(1000),
                "Time in which the pressure rises in proportion to time; 0: at once.");
  fields.number("damping_n_s_m3", inflation.damping_n_s_m3, from(0).up_to(1e5),
                "C_a: absolute damping of the cloth a unit area ([NFM] Eq. 20, mended).");
  fields.number("quadratic_damping_n_s2_m4", inflation.quadratic_damping_n_s2_m4, from(0).up_to(1e5),
                "The same in proportion to the square of the speed.");
  fields.number("line_damping_s", inflation.line_damping_s, from(0).up_to(1e-3),
                "Relative damping of lines and tape as a time: C = line_damping_s K_1 / L0 (assumed).");
  fields.number("cloth_damping_s", inflation.cloth_damping_s, from(0).up_to(1e-3),
                "Relative damping of the cloth's springs, likewise (none assumed).");
  fields.number(
      "cloth_damping_step_share", inflation.cloth_damping_step_share, from(0.05).up_to(0.999),
      "Where the cloth's damping would leave less than this of the stable step, a cell has less of it");
  fields
      .number("line_segment_m", inflation.line_segment_m, from(0.001).up_to(10),
              "Rest length that the springs of a line aim at, in the opening: stiff lines set its step.")
      .absent("that of [parachute.mesh]");
  fields
      .number("cloth_compression", inflation.cloth_compression, from(0).up_to(1),
              "Stiffness of cloth and tape in compression relative to K_1 at any strain, in the opening.")
      .absent("the materials' own, up to their buckling strain");
  fields.number("imperfection_m", inflation.imperfection_m, from(0).up_to(1),
                "The folded cloth starts moved outward by this much times cos(harmonic x azimuth) at the "
                "outer folds of "
                "the skirt, in proportion to the radius elsewhere; 0: symmetric.");
  fields.integer("imperfection_harmonic", inflation.imperfection_harmonic, from(1).up_to(1000),
                 "Waves round the axis of that imperfection.");
  fields.number("duration_s", inflation.duration_s, above(0).up_to(1000), "Time from deployment to the end.");
  fields.number(
      "history_hz", inflation.history_hz, from(10).up_to(1e6),
      "Rows a second of the load history, at least; each has the mean, least and largest load of all "
      "its steps.");
  fields.number("low_pass_hz", inflation.low_pass_hz, from(0).up_to(1e6),
                "Cutoff of a low-pass over the written history; the computation is not filtered; 0: none.");
  fields.numbers("sheet_s", inflation.sheet_s, 1, 12, from(0).up_to(1000),
                 "Instants whose shapes the contact sheet shows, at the next look at the step.");
  fields.integer("frames", inflation.frames, from(1).up_to(100000), "Shapes that are written.");
  fields.number("step_fraction", inflation.step_fraction, above(0).up_to(0.98),
                "Time step over the largest stable one.");
  fields.number("measured_peak_n", inflation.measured_peak_n, above(0).up_to(1e7), "Measured peak load.")
      .absent("withheld or not measured");
  fields
      .number("measured_inflation_time_s", inflation.measured_inflation_time_s, above(0).up_to(1000),
              "Measured time until the load stays within 10 % of steady.")
      .absent("withheld or not measured");
  fields
      .number("printed_peak_n", inflation.printed_peak_n, above(0).up_to(1e7),
              "Peak load that the source's model gives.")
      .absent("not printed");
}

void describe(Fields& fields, Measured& measured) {
  fields
      .number("nominal_speed_m_s", measured.nominal_speed_m_s, above(0).up_to(100),
              "Speed that names the condition.")
      .required();
  fields
      .number("measured_speed_m_s", measured.measured_speed_m_s, above(0).up_to(100),
              "Speed that was measured.")
      .required();
  fields.number("density_kg_m3", measured.density_kg_m3, above(0).up_to(20), "Density of the air.")
      .required();
  fields.number("drag_n", measured.drag_n, above(0).up_to(1e7), "Measured drag.")
      .absent("withheld or not measured");
  fields
      .number("printed_nonlinear_n", measured.printed_nonlinear_n, above(0).up_to(1e7),
              "Drag that the source's nonlinear model gives.")
      .absent("not printed");
  fields
      .number("printed_linear_n", measured.printed_linear_n, above(0).up_to(1e7),
              "Drag that the source's linear model gives.")
      .absent("not printed");
}

void describe(Fields& fields, Case& value) {
  fields.text("title", value.title, 200, "A line for reports.");
  fields.table("parachute", value.parachute, "The parachute.").required();
  fields.named_tables("materials", value.materials,
                      "Materials of this case; they come before those of the library with the same name.");
  fields
      .table(
          "flow", value.flow,
          "The air, its box and its solver. The defaults of the table are those of the \"paper\" model; with "
          "\"sheet\" those stand that \"Air through the cloth\" above lists.")
      .required();
  fields.table("coupling", value.coupling, "The steady loop between cloth and flow.");
  fields.table("inflation", value.inflation, "The opening of the folded canopy.");
  fields.rows("measured", value.measured, "Wind-tunnel conditions to take air from and to compare with.");
}

const Measured* measured_row(const Case& value) {
  const double wanted = value.flow.speed_m_s;
  for (const Measured& row : value.measured)
    if (std::abs(row.nominal_speed_m_s - wanted) <= 1e-9 * wanted) return &row;
  return nullptr;
}

Air air(const Case& value) {
  const FlowSettings& flow = value.flow;
  const Measured* row = measured_row(value);
  if (!row && (flow.speed_basis == SpeedBasis::measured || !flow.density_kg_m3))
    throw Error(ExitCode::usage, "no row of [[measured]] has the nominal speed of this case");
  return {flow.speed_basis == SpeedBasis::measured ? row->measured_speed_m_s : flow.speed_m_s,
          flow.density_kg_m3 ? *flow.density_kg_m3 : row->density_kg_m3};
}

double canopy_position(const Case& value) {
  return value.flow.canopy_position_m.value_or(value.flow.box_m.z / 2);
}

FlowGrid flow_grid(const Case& value) {
  const FlowSettings& flow = value.flow;
  FlowGrid grid;
  grid.origin = {-0.5 * flow.box_m.x, -0.5 * flow.box_m.y, 0};
  grid.size = flow.box_m;
  grid.nx = flow.cells[0];
  grid.ny = flow.cells[1];
  grid.nz = flow.cells[2];
  const Vec3 size = flow.core.size_m;
  if (size.x <= 0 && size.y <= 0 && size.z <= 0) return grid;
  const double start = flow.core.start_m.value_or(std::max(0.0, canopy_position(value) - 0.25 * size.z));
  return graded(grid, {-0.5 * size.x, -0.5 * size.y, start}, {0.5 * size.x, 0.5 * size.y, start + size.z},
                flow.core.growth);
}

const Fabric& canopy_fabric(const Case& value) {
  return material<Fabric>(value, value.parachute.canopy_material);
}
const Line& suspension_line(const Case& value) {
  return material<Line>(value, value.parachute.lines.material);
}
const Line& riser_line(const Case& value) {
  return material<Line>(value, value.parachute.riser.material);
}
const Tape& reinforcement_tape(const Case& value) {
  return material<Tape>(value, value.parachute.tape.material);
}

}  // namespace ripstop
