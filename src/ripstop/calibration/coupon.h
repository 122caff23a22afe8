// Virtual coupons: cloth between two clamps, pulled by the cloth solver itself ([NFM],
// from tests to springs).
//
// The pull is along y, the width along x. At 45 deg the yarns lie on the diagonals and the straight cuts run
// through nodes, so every cell at a cut or a clamp is a half: a triangle of two yarn pieces, half of one
// diagonal's width along the cut, and the other diagonal's inner half. That half ends in the middle of the
// cut: on a point tied to the two nodes there, or held by the clamp. A homogeneous stretch therefore has the
// same energy per area up to the edge, and no yarn runs along a cut.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ripstop/cloth/cloth.h"
#include "ripstop/core/thread_team.h"
#include "ripstop/material/material.h"
#include "ripstop/mesh/mesh.h"

namespace ripstop::inline calibration {

struct CouponShape {
  double length = 0.2;        // [m] between the clamps
  double width = 0.05;        // [m]
  int orientation = 0;        // 0: warp along the pull, 90: weft, 45 [deg]
  int cells = 10;             // across the width; at 45 deg: half-diagonals across the width / 2
  double aspect = 1;          // of a cell at 0 and 90 deg: its length along the pull / across it
  bool bias_lattice = false;  // 45 deg with the lattice along the pull and the yarns on its diagonals, as in
                              // a canopy cut on the bias; else the lattice lies along the yarns
};

struct CouponMesh {
  Mesh mesh;
  double length = 0, width = 0;  // [m] as built; at 45 deg the length is within half a cell of the wanted one
  double spacing = 0;            // [m] of the yarns across the pull (0, 90) or of either yarn (45)
  std::vector<int> lower_clamp, upper_clamp;   // held nodes
  std::vector<int> middle_left, middle_right;  // the nodes at the cuts nearest to half the length
};

/// Throws Error(usage) for a shape that cannot be built: fewer than 2 cells, an orientation not 0, 45, 90.
CouponMesh coupon_mesh(const Fabric& fabric, const CouponShape& shape);

/// One held position of the clamps.
struct CouponPoint {
  double strain = 0;       // of the distance between the clamps
  double load = 0;         // clamp force per width as cut [N/m]
  double waist = 1;        // width in the middle / width as cut
  double corner_peak = 1;  // highest von Mises stress at a clamp corner / that in the middle
  double residual = 0;     // left by the relaxation
};

struct CouponPull {
  std::vector<CouponPoint> points;
  std::vector<Vec3> positions;    // at the last strain
  std::vector<double> von_mises;  // [N/m] of every cell at the last strain
  double largest_strain = 0;      // of a spring
  bool converged = true;
  int steps = 0;  // of relaxation, in all
};

struct PullOptions {
  double tolerance = 1e-5;  // of the relaxation, on the clamp force
  bool stress = true;
};

/// Moves the clamps apart by `strains` (rising) and lets the cloth come to rest at each. A start from `guess`
/// (one set of positions a strain, of a similar cloth on the same mesh; filled on return) saves most steps.
CouponPull pull_coupon(const CouponMesh& coupon, const std::vector<double>& strains,
                       const PullOptions& options, ThreadTeam& team,
                       std::vector<std::vector<Vec3>>* guess = nullptr);

}  // namespace ripstop::inline calibration
