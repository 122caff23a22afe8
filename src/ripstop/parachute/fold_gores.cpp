#include "ripstop/parachute/fold_gores.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ripstop/core/error.h"
#include "ripstop/core/quantity_error.h"

namespace ripstop::inline parachute {
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

// How far out an outer fold lies when inner folds lie at `inner` from the axis, and a strip of length `strip`
// rises by `height` between them:
//
//   s^2 = a^2 + b^2 - 2 a b cos(pi / folds) + height^2   with a = `inner`, c = cos(pi / folds), gives b.
double outer_fold(double strip, double height, double inner, double c) {
  const double level_part = rise(strip, height);
  const double root = level_part * level_part - inner * inner * (1 - c * c);
  if (root < 0) {
    throw QuantityError(
        ExitCode::usage,
        fmt::format("a strip of {:.4g} m between two folds is too short for inner folds at {:.4g} "
                    "m from the axis; change radius of the folded skirt or number of folds",
                    strip, inner),
        {"radius of the folded skirt", "number of folds"});
  }
  return inner * c + std::sqrt(root);
}

// Where the fold lines cross one level: even ones inside, odd ones outside.
struct FoldLines {
  std::vector<double> radius, z;
};

// Of a level below `above`, whose lines hang from those; the first level is at z = 0.
FoldLines fold_lines(const Level& level, const FoldLines& above, bool first, double inner, double c) {
  FoldLines now = above;
  const int lines = static_cast<int>(above.z.size()), width = level.patch->columns / lines;
  const auto hang_from_above = [&](int k) {
    now.z[k] =
        first ? 0.0 : above.z[k] - rise(column_length(level, k, lines), now.radius[k] - above.radius[k]);
  };
  for (int k = 0; k < lines; k += 2) {
    now.radius[k] = inner;
    hang_from_above(k);
  }
  for (int k = 1; k < lines; k += 2) {
    const double strip =
        0.5 * (row_length(level, (k - 1) * width, width) + row_length(level, k * width, width));
    const double neighbours = 0.5 * (now.z[k - 1] + now.z[(k + 1) % lines]);
    now.z[k] = neighbours;
    for (int i = 0; i < 30; ++i) {  // z depends on the radius a little
      now.radius[k] = outer_fold(strip, now.z[k] - neighbours, inner, c);
      hang_from_above(k);
    }
  }
  return now;
}

// The nodes of a level on the straight strips between its fold lines.
void place_level(const Level& level, const FoldLines& at, double turn, std::vector<Vec3>& positions) {
  const Patch& patch = *level.patch;
  const int lines = static_cast<int>(at.z.size()), width = patch.columns / lines;
  const auto corner = [&](int k, int turns) {
    return Vec3{at.radius[k] * std::cos(turns * turn), at.radius[k] * std::sin(turns * turn), at.z[k]};
  };
  for (int k = 0; k < lines; ++k) {
    const Vec3 from = corner(k, k), to = corner((k + 1) % lines, k + 1);
    const double whole = row_length(level, k * width, width);
    for (int i = 0; i < width; ++i) {
      const double t = row_length(level, k * width, i) / whole;
      positions[patch.node(level.row, k * width + i)] = (1 - t) * from + t * to;
    }
  }
}

}  // namespace

FoldedStart zigzag_of_gores(const Mesh& mesh, int folds, double share) {
  check_folds(mesh, folds);
  const double turn = std::numbers::pi / folds;
  FoldedStart result{mesh.start, folds, 0, 0};
  FoldLines lines{std::vector<double>(2 * folds, 0.0), std::vector<double>(2 * folds, 0.0)};
  bool first = true;
  for (const Level& level : levels_of(mesh)) {
    const Vec3 seam = mesh.start[level.patch->node(level.row, 0)];
    lines = fold_lines(level, lines, first, share * std::hypot(seam.x, seam.y), std::cos(turn));
    place_level(level, lines, turn, result.positions);
    first = false;
  }
  result.inner_radius = lines.radius[0];
  result.outer_radius = lines.radius[1];
  for (const Tie& tie : mesh.ties) {
    Vec3 place{};
    for (const Tie::Master& master : tie.masters) place += master.weight * result.positions[master.node];
    result.positions[tie.node] = place;
  }
  return result;
}

}  // namespace ripstop::inline parachute
