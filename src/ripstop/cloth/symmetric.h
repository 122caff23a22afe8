// Algebra of the stiffness blocks of nodes: symmetric matrices as xx, yy, zz, xy, xz, yz.
#pragma once

#include "ripstop/cloth/stability_limit.h"
#include "ripstop/core/vec3.h"

namespace ripstop::inline cloth {

/// Zero for a singular block.
inline Symmetric inverse_of(const Symmetric& a) {
  const auto [xx, yy, zz, xy, xz, yz] = a;
  if (xy == 0 && xz == 0 && yz == 0 && xx > 0) return {1 / xx, 1 / yy, 1 / zz, 0, 0, 0};
  const Symmetric adjugate{yy * zz - yz * yz, xx * zz - xz * xz, xx * yy - xy * xy,
                           xz * yz - xy * zz, xy * yz - xz * yy, xy * xz - xx * yz};
  const double determinant = xx * adjugate[0] + xy * adjugate[3] + xz * adjugate[4];
  if (!(determinant > 0)) return {};  // a node without any stiffness (a hole in the cloth) rests where it is
  Symmetric inverse;
  for (int i = 0; i < 6; ++i) inverse[i] = adjugate[i] / determinant;
  return inverse;
}

/// With P the projection on the free directions of a node: P a P, plus a term of the size of a in the fixed
/// directions.
inline Symmetric within(const Symmetric& p, const Symmetric& a) {
  const Vec3 x = p * (a * (p * Vec3{1, 0, 0})), y = p * (a * (p * Vec3{0, 1, 0})),
             z = p * (a * (p * Vec3{0, 0, 1}));
  return {x.x, y.y, z.z, y.x, z.x, z.y};
}
inline Symmetric held_beside(const Symmetric& p, const Symmetric& a) {
  Symmetric sum = within(p, a);
  const double size = (a[0] + a[1] + a[2]) / 3;
  for (int i = 0; i < 6; ++i) sum[i] += size * ((i < 3 ? 1 : 0) - p[i]);
  return sum;
}

}  // namespace ripstop::inline cloth
