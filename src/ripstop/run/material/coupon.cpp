#include "ripstop/run/material/coupon.h"

#include <fmt/format.h>

#include "ripstop/core/build_info.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/material/library.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/sheet_picture.h"
#include "ripstop/output/vtk.h"
#include "ripstop/run/json.h"

namespace ripstop::inline run {

std::string to_json(const CouponResult& result) {
  return json_text(result);
}

CouponResult run_coupon(const Fabric& fabric, const CouponShape& shape, double strain, int points,
                        ThreadTeam& team) {
  if (!(strain > 0)) strain = fabric.tested_strain > 0 ? fabric.tested_strain : 0.1;
  std::vector<double> strains;
  for (int i = 1; i <= points; ++i) strains.push_back(strain * i / points);
  const std::string asked =
      fmt::format("{}\n{}\n{} {} {} {} {} {} {}", version(), material_to_toml(fabric), shape.orientation,
                  shape.bias_lattice, shape.length, shape.width, shape.cells, strain, points);
  CouponResult result{fabric.name, hash_bytes(asked), shape.orientation, coupon_mesh(fabric, shape), {}};
  result.pull = pull_coupon(result.coupon, strains, {}, team);
  return result;
}

void write_coupon_result(const std::filesystem::path& folder, const CouponResult& result) {
  make_results_folder(folder, "coupon");
  CsvTable table{columns_of<CouponPoint>(), {}};
  for (const CouponPoint& point : result.pull.points) table.rows.push_back(row_of(point));
  write_csv(folder / "coupon.csv", table);
  write_coupon(folder, fmt::format("{}", result.orientation), result.coupon, result.pull);
  write_file(folder / "result.json", to_json(result));
}

void write_coupon(const std::filesystem::path& folder, const std::string& name, const CouponMesh& coupon,
                  const CouponPull& pull) {
  const double strain = pull.points.back().strain;
  write_sheet_picture(
      folder / fmt::format("coupon-{}.png", name), coupon.mesh, pull.positions,
      {fmt::format("Coupon {}, strain {:.3g}", name, strain),
       "von Mises stress [N/m]",
       pull.von_mises,
       {{0, 0, 0}, {coupon.width, 0, 0}, {coupon.width, coupon.length, 0}, {0, coupon.length, 0}}});
  VtkSurface surface = canopy_surface(coupon.mesh, pull.positions);
  surface.cell_arrays.push_back(
      vtk_array("von_mises_n_per_m", cloth_cells_only(coupon.mesh, pull.von_mises)));
  write_vtp(folder / fmt::format("coupon-{}.vtp", name), surface);
}

}  // namespace ripstop::inline run
