#include "ripstop/parachute/fold_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "ripstop/core/error.h"
#include "ripstop/core/quantity_error.h"
#include "ripstop/parachute/hang.h"

namespace ripstop::inline parachute {
namespace {

using std::numbers::pi;

constexpr int sheet_folds = 4;
constexpr double sector = pi / sheet_folds;  // between two fold lines, as cut and in azimuth when flat
constexpr double same = 1e-9;                // [m]

// Unit vectors from the apex along the folds: the inner ones at the angle `inner` with the axis.
class Cone {
 public:
  explicit Cone(double inner) : inner_(inner) {
    // cos(sector) = cos a cos b + sin a sin b cos(azimuth): here both angles are 45 degrees.
    const double x = std::cos(inner), y = std::sin(inner) * std::cos(sector);
    outer_ = std::atan2(y, x) + std::acos(std::min(1.0, std::cos(sector) / std::hypot(x, y)));
  }
  Vec3 along(int k) const {
    const double angle = k % 2 == 0 ? inner_ : outer_;
    return {std::sin(angle) * std::cos(k * sector), std::sin(angle) * std::sin(k * sector), -std::cos(angle)};
  }
  Vec3 place(Vec3 flat) const {
    const double distance = std::hypot(flat.x, flat.y);
    if (distance < same) return {};
    const double angle = std::atan2(flat.y, flat.x) + (flat.y < 0 ? 2 * pi : 0);
    const int k = std::min(static_cast<int>(angle / sector), 2 * sheet_folds - 1);
    const double psi = angle - k * sector;
    return (distance / std::sin(sector)) * (std::sin(sector - psi) * along(k) + std::sin(psi) * along(k + 1));
  }

 private:
  double inner_, outer_ = 0;
};

struct Radii {
  double inner = std::numeric_limits<double>::infinity(), outer = 0;
  double mean() const { return 0.5 * (inner + outer); }
};

// Of the nodes that the lines hold.
Radii radii_of(const Mesh& mesh, const std::vector<LineLink>& links, const Cone& cone) {
  Radii radii;
  for (const LineLink& link : links) {
    const Vec3 p = cone.place(mesh.start[link.to]);
    radii.inner = std::min(radii.inner, std::hypot(p.x, p.y));
    radii.outer = std::max(radii.outer, std::hypot(p.x, p.y));
  }
  return radii;
}

// Every cell's nodes must lie in one sector, borders included.
void check_lattice(const Mesh& mesh) {
  for (const Patch& patch : mesh.patches) {
    for (int row = 0; row < patch.rows; ++row) {
      for (int column = 0; column + 1 < patch.columns; ++column) {
        const Vec3 a = mesh.start[patch.node(row, column)], b = mesh.start[patch.node(row, column + 1)];
        const double turn = a.x * b.y - a.y * b.x;
        for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}}) {
          const double sa = dot(a, axis), sb = dot(b, axis);
          if (std::abs(turn) > same * same && sa * sb < 0 && std::abs(sa) > same && std::abs(sb) > same)
            throw QuantityError(
                ExitCode::usage,
                "the fold line in the middle of the canopy does not coincide with a line of nodes: "
                "change number of cloth nodes",
                {"number of cloth nodes"});
        }
      }
    }
  }
}

}  // namespace

bool is_flat_sheet(const Mesh& mesh) {
  for (const Patch& patch : mesh.patches) {
    if (patch.periodic) return false;
    for (int i = 0; i < patch.rows * patch.columns; ++i)
      if (std::abs(mesh.start[patch.first_node + i].z - mesh.start[mesh.patches[0].first_node].z) > same)
        return false;
  }
  return true;
}

FoldedStart fold_sheet(const CanopyMesh& mesh, const Folding& folding) {
  if (folding.folds != 0 && folding.folds != sheet_folds)
    throw QuantityError(
        ExitCode::usage,
        fmt::format("number of folds = {}: must be 4, along the arms and the diagonals of the flat canopy",
                    folding.folds),
        {"number of folds"});
  check_lattice(mesh);
  std::vector<int> piece(mesh.node_count(), -1);
  for (const Patch& patch : mesh.patches)
    std::fill_n(piece.begin() + patch.first_node, patch.rows * patch.columns, 0);
  const std::vector<LineLink> links = line_links(mesh, piece);
  if (links.empty()) throw Error(ExitCode::bad_data, "a canopy without lines cannot be folded");

  double low = 0, high = sector;  // of the inner folds; at `sector` and beyond the outer ones fold over
  const auto mean = [&](double inner) { return radii_of(mesh, links, Cone(inner)).mean(); };
  if (!(folding.initial_radius > mean(low) && folding.initial_radius < mean(high)))
    throw QuantityError(
        ExitCode::usage,
        fmt::format("radius of the folded skirt = {:.4g}: with 4 folds the ends of the lines can lie from "
                    "{:.4g} m to below {:.4g} m from the axis",
                    folding.initial_radius, mean(low), mean(high)),
        {"radius of the folded skirt"});
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (mean(middle) < folding.initial_radius ? low : high) = middle;
  }
  const Cone cone(low);
  FoldedStart start{mesh.start, sheet_folds, 0, 0};
  for (int node = 0; node < mesh.node_count(); ++node)
    if (piece[node] >= 0) start.positions[node] = cone.place(mesh.start[node]);
  double by = std::numeric_limits<double>::infinity();
  for (const LineLink& link : links) by = std::min(by, free_way(link, mesh, start.positions, folding.slack));
  for (int node = 0; node < mesh.node_count(); ++node)
    if (piece[node] >= 0) start.positions[node].z += by;
  for (const LineLink& link : links) hang(link, start.positions);
  const Radii radii = radii_of(mesh, links, cone);
  start.inner_radius = radii.inner;
  start.outer_radius = radii.outer;
  return start;
}

}  // namespace ripstop::inline parachute
