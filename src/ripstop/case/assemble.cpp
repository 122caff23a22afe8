#include "ripstop/case/assemble.h"

#include <fmt/format.h>

#include "ripstop/case/cost.h"

namespace ripstop {

PartMaterials part_materials(const Case& given) {
  PartMaterials materials{canopy_fabric(given), suspension_line(given), riser_line(given), std::nullopt};
  if (const Tape* tape = reinforcement_tape(given)) materials.tape = *tape;
  if (resolve(given).flow.porosity_model != PorosityModel::sheet) return materials;
  if (!materials.canopy.buckling_strain) materials.canopy.buckling_strain = wrinkling_strain;
  if (materials.tape && !materials.tape->buckling_strain) materials.tape->buckling_strain = wrinkling_strain;
  return materials;
}

CanopyMesh parachute_mesh(const Case& given) {
  const Cost cost = cost_of(given);
  require_memory(cost.cloth_memory, fmt::format("a mesh of {:.3g} nodes", cost.nodes));
  CanopyMesh mesh = build_mesh(given.parachute, part_materials(given));
  const double z = canopy_position(given);
  for (Vec3& p : mesh.start) p.z += z;
  return mesh;
}

FlowProblem flow_problem(const Case& given) {
  const FlowSettings flow = resolve(given).flow;
  FlowProblem problem;
  problem.grid = flow_grid(flow);
  problem.air.speed = air(given).speed;
  problem.air.density = flow.density_kg_m3;
  problem.air.viscosity = flow.viscosity_pa_s;
  problem.air.temperature = flow.temperature_k;
  problem.air.turbulence_intensity = flow.turbulence_intensity;
  problem.air.viscosity_ratio = flow.viscosity_ratio;
  problem.sides = flow.sides;
  problem.outlet = flow.outlet;
  problem.jet = jet_of(flow.tunnel);
  problem.stopping.residual = flow.residual;
  problem.stopping.max_iterations = flow.max_iterations;
  problem.stopping.average_over = flow.average_over;
  const ClothResistance& cloth = canopy_fabric(given).resistance;
  if (flow.porosity_model == PorosityModel::sheet) {
    const PressureDrop drop = as_sheet(cloth);
    problem.sheets = {{{}, drop.linear, drop.quadratic}};
  } else {
    const PorousCellLaw cells = as_cells(cloth);
    problem.porous = {{{}, cells.darcy, cells.forchheimer}};
  }
  return problem;
}

SteadyProblem steady_problem(const Case& given) {
  SteadyProblem problem{parachute_mesh(given), flow_problem(given), nominal_area(given.parachute),
                        resolve(given).coupling, std::nullopt};
  if (given.flow.unsteady) {
    const WatchKeys& keys = given.flow.watch;
    problem.averaging_window = {keys.courant, keys.standard_error, keys.shortest, keys.longest,
                                inflated_diameter(given.parachute)};
  }
  return problem;
}

}  // namespace ripstop
