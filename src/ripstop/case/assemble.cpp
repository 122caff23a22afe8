#include "ripstop/case/assemble.h"

namespace ripstop {

PartMaterials part_materials(const Case& value) {
  PartMaterials materials{canopy_fabric(value), suspension_line(value), riser_line(value),
                          reinforcement_tape(value)};
  PorosityModel model = value.flow.porosity_model;
  if (model == PorosityModel::of_cloth) model = materials.canopy.porosity_model;
  if (model != PorosityModel::sheet) return materials;
  for (std::optional<double>* strain : {&materials.canopy.buckling_strain, &materials.tape.buckling_strain})
    if (!*strain) *strain = wrinkling_strain;
  return materials;
}

CanopyMesh parachute_mesh(const Case& value) {
  CanopyMesh mesh = build_mesh(value.parachute, part_materials(value));
  const double z = canopy_position(value);
  for (Vec3& p : mesh.start) p.z += z;
  return mesh;
}

FlowProblem flow_problem(const Case& value) {
  const FlowSettings& settings = value.flow;
  FlowProblem problem;
  problem.grid = flow_grid(value);
  problem.air.speed = air(value).speed;
  problem.air.density = air(value).density;
  problem.air.viscosity = settings.viscosity_pa_s;
  problem.air.temperature = settings.temperature_k;
  problem.air.turbulence_intensity = settings.turbulence_intensity;
  problem.air.viscosity_ratio = settings.viscosity_ratio;
  problem.sides = settings.sides;
  problem.outlet = settings.outlet;
  problem.stopping.residual = settings.residual;
  problem.stopping.max_iterations = settings.max_iterations;
  problem.stopping.average_over = settings.average_over;
  const Fabric& cloth = canopy_fabric(value);
  if (settings.porosity_model == PorosityModel::sheet) {
    problem.sheets = {{{}, cloth.darcy, cloth.forchheimer}};
  } else {
    problem.porous = {{{}, cloth.darcy, cloth.forchheimer}};
  }
  return problem;
}

SteadyProblem steady_problem(const Case& value) {
  return {parachute_mesh(value), flow_problem(value), nominal_area(value.parachute), value.coupling};
}

}  // namespace ripstop
