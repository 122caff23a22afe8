#include "ripstop/parachute/fold_gores.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

// One row of one patch, from the vent down.
struct Level {
  const Patch* patch;
  int row;
  double gap;  // to the level above, along the seam: 0 within a patch, where the columns have their lengths
  bool same_patch;
};

double row_length(const Level& level, int from, int count) {
  const Patch& p = *level.patch;
  double sum = 0;
  for (int c = from; c < from + count; ++c)
    sum += p.rest_length[along_row][level.row * p.columns + c % p.columns];
  return sum;
}

std::vector<Level> levels_of(const Mesh& mesh) {
  std::vector<Level> levels;
  for (auto patch = mesh.patches.rbegin(); patch != mesh.patches.rend(); ++patch) {
    for (int row = patch->rows - 1; row >= 0; --row) {
      Level level{&*patch, row, 0, row + 1 < patch->rows};
      if (!level.same_patch && !levels.empty()) {
        const Level& above = levels.back();
        level.gap = norm(mesh.start[above.patch->node(above.row, 0)] - mesh.start[patch->node(row, 0)]);
      }
      levels.push_back(level);
    }
  }
  return levels;
}

// Length of fold line `k` of `lines` between a level and the one above.
double column_length(const Level& level, int k, int lines) {
  if (!level.same_patch) return level.gap;
  const Patch& p = *level.patch;
  return p.rest_length[along_column][level.row * p.columns + p.columns / lines * k];
}

double rise(double length, double sideways) {
  return std::sqrt(std::max(0.0, length * length - sideways * sideways));
}

}  // namespace

FoldedStart zigzag_of_gores(const Mesh& mesh, int folds, double share) {
  check_folds(mesh, folds);
  const int lines = 2 * folds;
  const double turn = std::numbers::pi / folds, c = std::cos(turn);
  FoldedStart result{mesh.start, folds, 0, 0};
  std::vector<double> radius(lines, 0.0), z(lines, 0.0), last_radius, last_z;
  bool first = true;
  for (const Level& level : levels_of(mesh)) {
    const Patch& patch = *level.patch;
    const int width = patch.columns / lines;
    const Vec3 seam = mesh.start[patch.node(level.row, 0)];
    const double inner = share * std::hypot(seam.x, seam.y);
    last_radius = radius, last_z = z;
    const auto hang_from_above = [&](int k) {
      z[k] = first ? 0.0 : last_z[k] - rise(column_length(level, k, lines), radius[k] - last_radius[k]);
    };
    for (int k = 0; k < lines; k += 2) {
      radius[k] = inner;
      hang_from_above(k);
    }
    // s^2 = a^2 + b^2 - 2 a b cos(pi / folds) + (difference in z)^2 gives b; the z of the outer fold depends
    // on it a little.
    for (int k = 1; k < lines; k += 2) {
      const double s =
          0.5 * (row_length(level, (k - 1) * width, width) + row_length(level, k * width, width));
      const double neighbours = 0.5 * (z[k - 1] + z[(k + 1) % lines]);
      z[k] = neighbours;
      for (int i = 0; i < 30; ++i) {
        const double level_part = rise(s, z[k] - neighbours);
        const double root = level_part * level_part - inner * inner * (1 - c * c);
        if (root < 0) {
          throw Error(
              ExitCode::usage,
              fmt::format("a strip of {:.4g} m between two folds is too short for inner folds at {:.4g} "
                          "m from the axis; ask for another inflation.initial_radius_m or other folds",
                          s, inner));
        }
        radius[k] = inner * c + std::sqrt(root);
        hang_from_above(k);
      }
    }
    for (int k = 0; k < lines; ++k) {
      const int next = (k + 1) % lines;
      const Vec3 from{radius[k] * std::cos(k * turn), radius[k] * std::sin(k * turn), z[k]};
      const Vec3 to{radius[next] * std::cos((k + 1) * turn), radius[next] * std::sin((k + 1) * turn),
                    z[next]};
      const double whole = row_length(level, k * width, width);
      for (int i = 0; i < width; ++i) {
        const double t = row_length(level, k * width, i) / whole;
        result.positions[patch.node(level.row, k * width + i)] = (1 - t) * from + t * to;
      }
    }
    first = false;
  }
  result.inner_radius = radius[0];
  result.outer_radius = radius[1];
  for (const Tie& tie : mesh.ties) {
    Vec3 place{};
    for (const Tie::Master& master : tie.masters) place += master.weight * result.positions[master.node];
    result.positions[tie.node] = place;
  }
  return result;
}

}  // namespace ripstop
