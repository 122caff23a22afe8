#include "ripstop/case/assemble.h"

namespace ripstop {

PartMaterials part_materials(const Case& given) {
  return {canopy_fabric(given), suspension_line(given), riser_line(given), reinforcement_tape(given)};
}

CanopyMesh parachute_mesh(const Case& given) {
  CanopyMesh mesh = build_mesh(given.parachute, part_materials(given));
  const double z = canopy_position(given);
  for (Vec3& p : mesh.start) p.z += z;
  return mesh;
}

FlowProblem flow_problem(const Case& given) {
  const FlowSettings settings = resolve(given).flow;
  FlowProblem problem;
  problem.grid = flow_grid(settings);
  problem.air.speed = air(given).speed;
  problem.air.density = settings.density_kg_m3;
  problem.air.viscosity = settings.viscosity_pa_s;
  problem.air.temperature = settings.temperature_k;
  problem.air.turbulence_intensity = settings.turbulence_intensity;
  problem.air.viscosity_ratio = settings.viscosity_ratio;
  problem.sides = settings.sides;
  problem.outlet = settings.outlet;
  problem.stopping.residual = settings.residual;
  problem.stopping.max_iterations = settings.max_iterations;
  problem.stopping.average_over = settings.average_over;
  const ClothResistance& cloth = canopy_fabric(given).resistance;
  if (settings.porosity_model == PorosityModel::sheet) {
    const PressureDrop drop = as_sheet(cloth);
    problem.sheets = {{{}, drop.linear, drop.quadratic}};
  } else {
    const PorousCellLaw cells = as_cells(cloth);
    problem.porous = {{{}, cells.darcy, cells.forchheimer}};
  }
  return problem;
}

SteadyProblem steady_problem(const Case& given) {
  return {parachute_mesh(given), flow_problem(given), nominal_area(given.parachute), resolve(given).coupling};
}

}  // namespace ripstop
