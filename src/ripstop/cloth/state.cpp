// Positions and velocities in and out of the kernels' layout.
#include <fmt/format.h>

#include <algorithm>

#include "ripstop/cloth/layout.h"
#include "ripstop/core/error.h"

namespace ripstop::inline cloth {
namespace {

void set(AlignedDoubles& vectors, const Cloth& cloth, const std::vector<Vec3>& values, const char* what) {
  const int count = cloth.mesh.node_count();
  if (static_cast<int>(values.size()) != count)
    throw Error(ExitCode::bad_data,
                fmt::format("{} {} for {} nodes of the cloth", values.size(), what, count));
  vectors.assign(3 * static_cast<std::size_t>(cloth.slots), 0.0);
  for (int node = 0; node < count; ++node)
    if (!cloth.is_tied[node]) put(vectors.data(), cloth.slot[node], values[node]);
  follow(cloth, vectors.data(), 0, cloth.row_count, true);
  mirror(cloth, vectors.data(), 0, cloth.row_count);
}

std::vector<Vec3> values(const AlignedDoubles& vectors, const Cloth& cloth) {
  std::vector<Vec3> result(cloth.mesh.node_count());
  for (std::size_t node = 0; node < result.size(); ++node)
    result[node] = get(vectors.data(), cloth.slot[node]);
  return result;
}

}  // namespace

void follow(const Cloth& cloth, double* vectors, int begin_row, int end_row, bool loose) {
  const int begin = cloth.followers_of_row[begin_row];
  const int end = loose ? static_cast<int>(cloth.followers.size()) : cloth.followers_of_row[end_row];
  for (int i = begin; i < end; ++i) {
    const Cloth::Follower& follower = cloth.followers[i];
    Vec3 sum;
    for (int m = follower.first_master; m < follower.end_master; ++m)
      sum += cloth.masters[m].weight * get(vectors, cloth.masters[m].slot);
    put(vectors, follower.slot, sum);
  }
}

void mirror(const Cloth& cloth, double* vectors, int begin_row, int end_row) {
  for (int row = begin_row; row < end_row; ++row) {
    double* first = vectors + at(cloth.row_slot(row));
    for (const PatchLayout::Copy& copy : cloth.patches[cloth.row_patch[row]].copies)
      for (int c = 0; c < 3; ++c) first[at(copy.ghost) + c * lanes] = first[at(copy.source) + c * lanes];
  }
}

AlignedDoubles compile_pressure(const Cloth& cloth, const Loads& loads) {
  const std::vector<double>& pressure = loads.cell_pressure;
  if (std::all_of(pressure.begin(), pressure.end(), [](double p) { return p == 0; })) return {};
  if (static_cast<int>(pressure.size()) != cloth.mesh.cell_count())
    throw Error(ExitCode::bad_data, fmt::format("{} cell pressures for {} cells of the cloth",
                                                pressure.size(), cloth.mesh.cell_count()));
  AlignedDoubles compiled(cloth.slots, 0.0);
  for (std::size_t i = 0; i < cloth.cells.size(); ++i)
    if (const int corner = cloth.cells[i].corner[0]; corner >= 0)
      compiled[cloth.slot[corner]] = 0.125 * pressure[i];
  return compiled;
}

AlignedDoubles compile_node_force(const Cloth& cloth, const Loads& loads) {
  if (loads.node_force.empty()) return {};
  const int count = cloth.mesh.node_count();
  if (static_cast<int>(loads.node_force.size()) != count)
    throw Error(ExitCode::bad_data,
                fmt::format("{} node forces for {} nodes of the cloth", loads.node_force.size(), count));
  AlignedDoubles compiled(3 * static_cast<std::size_t>(cloth.slots), 0.0);
  for (int node = 0; node < count; ++node) put(compiled.data(), cloth.slot[node], loads.node_force[node]);
  return compiled;
}

ClothState start_state(const Cloth& cloth) {
  ClothState state;
  set_positions(state, cloth, cloth.mesh.start);
  state.v.assign(state.x.size(), 0.0);
  return state;
}

void set_positions(ClothState& state, const Cloth& cloth, const std::vector<Vec3>& positions) {
  set(state.x, cloth, positions, "positions");
}
void set_velocities(ClothState& state, const Cloth& cloth, const std::vector<Vec3>& velocities) {
  set(state.v, cloth, velocities, "velocities");
  for (int node : cloth.mesh.fixed) put(state.v.data(), cloth.slot[node], {});
  follow(cloth, state.v.data(), 0, cloth.row_count, true);
  mirror(cloth, state.v.data(), 0, cloth.row_count);
}
std::vector<Vec3> positions(const ClothState& state, const Cloth& cloth) {
  return values(state.x, cloth);
}
std::vector<Vec3> velocities(const ClothState& state, const Cloth& cloth) {
  return values(state.v, cloth);
}

}  // namespace ripstop::inline cloth
