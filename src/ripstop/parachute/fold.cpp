#include "ripstop/parachute/fold.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "ripstop/core/error.h"
#include "ripstop/core/quantity_error.h"
#include "ripstop/mesh/each_spring.h"
#include "ripstop/parachute/hang.h"

namespace ripstop::inline parachute {
namespace {

using std::numbers::pi;
constexpr double same = 1e-9;  // lengths closer than this are equal [m]
constexpr double folded_strain = 1e-9;

double radius_of(Vec3 p) {
  return std::hypot(p.x, p.y);
}

// A developable piece of the canopy: patches on one cylinder, or on one cone about the axis.
struct Piece {
  bool is_cylinder = false;
  double radius = 0;  // of its widest row [m]
  double apex = 0;    // z of a cone's apex in the start shape [m]
  double slant = 0;   // sine of the angle between axis and generators: 1 for a flat disk
  double reach = 0;   // largest distance from the apex [m]
  std::vector<int> patches;

  // Folded: radii of the folds at the widest row, and where the piece goes.
  double inner = 0, outer = 0;  // [m]
  double shift = 0;             // added to z, apex included [m]
  bool placed = false;
};

Piece piece_of(const Mesh& mesh, int index) {
  const Patch& patch = mesh.patches[index];
  const auto refuse = [&](const char* why) {
    throw Error(ExitCode::bad_data, fmt::format("patch \"{}\" cannot be folded: {}", patch.name, why));
  };
  if (!patch.periodic || patch.rows < 2) refuse("it does not surround the axis");
  const Vec3 first = mesh.start[patch.node(0, 0)], last = mesh.start[patch.node(patch.rows - 1, 0)];
  const double r0 = radius_of(first), r1 = radius_of(last);
  Piece piece;
  piece.patches = {index};
  piece.radius = std::max(r0, r1);
  piece.is_cylinder = std::abs(r0 - r1) < same;
  if (!piece.is_cylinder) {
    piece.apex = first.z + (last.z - first.z) * r0 / (r0 - r1);
    piece.reach = std::hypot(piece.radius, (r0 > r1 ? first.z : last.z) - piece.apex);
    piece.slant = piece.radius / piece.reach;
  }
  for (int row = 0; row < patch.rows; ++row) {
    for (int column = 0; column < patch.columns; ++column) {
      const Vec3 p = mesh.start[patch.node(row, column)];
      const double off = piece.is_cylinder
                             ? radius_of(p) - piece.radius
                             : radius_of(p) - piece.slant * std::hypot(radius_of(p), p.z - piece.apex);
      if (std::abs(off) > same) {
        refuse("it must be a disk, a cylinder or a frustum");
      }
    }
  }
  return piece;
}

std::vector<Piece> pieces_of(const Mesh& mesh) {
  std::vector<Piece> pieces;
  for (int p = 0; p < static_cast<int>(mesh.patches.size()); ++p) {
    Piece piece = piece_of(mesh, p);
    const auto known = std::find_if(pieces.begin(), pieces.end(), [&](const Piece& other) {
      if (other.is_cylinder != piece.is_cylinder) return false;
      if (piece.is_cylinder) return false;  // two bands hang one behind the other
      return std::abs(other.apex - piece.apex) < same && std::abs(other.slant - piece.slant) < same;
    });
    if (known == pieces.end()) {
      pieces.push_back(std::move(piece));
      continue;
    }
    known->patches.push_back(p);
    known->radius = std::max(known->radius, piece.radius);
    known->reach = std::max(known->reach, piece.reach);
  }
  return pieces;
}

// The zigzag of one piece. Inner folds at the even multiples of pi / folds, outer ones at the odd.
class Zigzag {
 public:
  explicit Zigzag(int folds) : angle_(pi / folds), folds_(folds) {}

  /// Chord of one strip between two folds, as the cloth is cut, on a cylinder: `columns` chords in a row.
  double strip(const Piece& piece, int columns) const {
    return columns / (2.0 * folds_) * 2 * piece.radius * std::sin(pi / columns);
  }
  /// Angle of one strip at a cone's apex, as the cloth is cut.
  double sector(const Piece& piece, int columns) const {
    return columns / (2.0 * folds_) * 2 * std::asin(piece.slant * std::sin(pi / columns));
  }

  /// The outer fold's radius at the widest row for a given inner one; negative when the strip is too short.
  double outer_radius(const Piece& piece, int columns, double inner) const {
    const double c = std::cos(angle_);
    if (piece.is_cylinder) {  // s^2 = a^2 + b^2 - 2 a b cos(pi / folds)
      const double s = strip(piece, columns);
      const double root = s * s - inner * inner * (1 - c * c);
      return root < 0 ? -1 : inner * c + std::sqrt(root);
    }
    // cos(sector) = cos a cos b + sin a sin b cos(pi / folds) for the angles a, b of the folds with the axis.
    const double a = std::asin(std::min(1.0, inner / piece.reach));
    const double x = std::cos(a), y = std::sin(a) * c, target = std::cos(sector(piece, columns));
    if (std::hypot(x, y) < target) return -1;
    const double b = std::atan2(y, x) + std::acos(target / std::hypot(x, y));
    return b > pi / 2 + same ? -1 : piece.reach * std::sin(std::min(b, pi / 2));
  }

  /// Unit vector from a cone's apex along fold line `k`, for an apex downstream of the cloth.
  Vec3 along(const Piece& piece, int k) const {
    const double sine = (k % 2 == 0 ? piece.inner : piece.outer) / piece.reach;
    return {sine * std::cos(k * angle_), sine * std::sin(k * angle_),
            -std::sqrt(std::max(0.0, 1 - sine * sine))};
  }
  Vec3 on_cylinder(const Piece& piece, int k) const {
    const double r = k % 2 == 0 ? piece.inner : piece.outer;
    return {r * std::cos(k * angle_), r * std::sin(k * angle_), 0};
  }

 private:
  double angle_;
  int folds_;
};

class Folder {
 public:
  Folder(const CanopyMesh& mesh, const Folding& folding)
      : mesh_(mesh),
        folding_(folding),
        folds_(folding.folds > 0 ? folding.folds : static_cast<int>(line_joints(mesh).size())),
        zigzag_(folds_),
        pieces_(pieces_of(mesh)),
        piece_of_node_(mesh.node_count(), -1),
        x_(mesh.start) {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      for (const int p : pieces_[i].patches) {
        const Patch& patch = mesh.patches[p];
        std::fill_n(piece_of_node_.begin() + patch.first_node, patch.rows * patch.columns,
                    static_cast<int>(i));
      }
    }
  }

  FoldedStart run() {
    if (mesh_.rigging.lines.empty() || mesh_.rigging.skirt_nodes.empty()) {
      throw Error(ExitCode::bad_data, "a canopy without lines or skirt cannot be folded");
    }
    check_folds(mesh_, folds_);
    choose_radii();
    for (const Piece& piece : pieces_) place_unshifted(piece);
    hang_pieces();
    hang_lines();
    const Piece& skirt = skirt_piece();
    return {std::move(x_), folds_, skirt.inner, skirt.outer};
  }

 private:
  void choose_radii();
  void place_unshifted(const Piece& piece);
  void hang_pieces();
  void hang_lines();
  void shift(Piece& piece, double by);
  Piece& skirt_piece() { return pieces_[piece_of_node_[mesh_.rigging.skirt_nodes[0]]]; }
  int columns_of(const Piece& piece) const { return mesh_.patches[piece.patches[0]].columns; }
  [[noreturn]] void refuse_radius(const Piece& skirt) const;

  const CanopyMesh& mesh_;
  Folding folding_;
  int folds_;
  Zigzag zigzag_;
  std::vector<Piece> pieces_;
  std::vector<int> piece_of_node_;
  std::vector<Vec3> x_;
};

void Folder::refuse_radius(const Piece& skirt) const {
  throw QuantityError(
      ExitCode::usage,
      fmt::format(
          "radius of the folded skirt = {}: with {} folds the skirt, {:.4g} m in radius as cut, folds to "
          "radii from {:.4g} m to below {:.4g} m; more folds allow smaller ones",
          folding_.initial_radius, folds_, skirt.radius,
          0.5 * zigzag_.outer_radius(skirt, columns_of(skirt), 0), skirt.radius),
      {"radius of the folded skirt"});
}

// The mean of inner and outer fold is the given radius at the skirt; every other piece keeps the same share
// of its own radius at its inner folds.
void Folder::choose_radii() {
  Piece& skirt = skirt_piece();
  const int columns = columns_of(skirt);
  const auto mean = [&](double inner) { return 0.5 * (inner + zigzag_.outer_radius(skirt, columns, inner)); };
  if (!(folding_.initial_radius > mean(0)) || !(folding_.initial_radius < skirt.radius)) refuse_radius(skirt);
  double low = 0, high = folding_.initial_radius;
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (mean(middle) < folding_.initial_radius ? low : high) = middle;
  }
  const double share = low / skirt.radius;
  for (Piece& piece : pieces_) {
    piece.inner = share * piece.radius;
    piece.outer = zigzag_.outer_radius(piece, columns_of(piece), piece.inner);
    if (piece.outer < 0) refuse_radius(skirt);
  }
}

// Strip k lies between fold lines k and k + 1. On a cone a node at distance l from the apex and angle psi
// from fold line k is at l (sin(beta - psi) d_k + sin(psi) d_{k+1}) / sin(beta): plane, and at its distances
// to all others.
void Folder::place_unshifted(const Piece& piece) {
  for (const int p : piece.patches) {
    const Patch& patch = mesh_.patches[p];
    const int width = patch.columns / (2 * folds_);
    for (int row = 0; row < patch.rows; ++row) {
      for (int column = 0; column < patch.columns; ++column) {
        const int node = patch.node(row, column), k = column / width;
        const double t = double(column % width) / width;
        const Vec3 start = mesh_.start[node];
        if (piece.is_cylinder) {
          x_[node] = (1 - t) * zigzag_.on_cylinder(piece, k) + t * zigzag_.on_cylinder(piece, k + 1);
          x_[node].z = start.z;
          continue;
        }
        const double beta = zigzag_.sector(piece, patch.columns);
        const double l = std::hypot(radius_of(start), start.z - piece.apex);
        const Vec3 plane = std::sin((1 - t) * beta) * zigzag_.along(piece, k) +
                           std::sin(t * beta) * zigzag_.along(piece, k + 1);
        x_[node] = Vec3{0, 0, piece.apex} + (l / std::sin(beta)) * plane;
      }
    }
  }
}

void Folder::shift(Piece& piece, double by) {
  piece.placed = true;
  for (const int p : piece.patches) {
    const Patch& patch = mesh_.patches[p];
    for (int node = patch.first_node; node < patch.first_node + patch.rows * patch.columns; ++node)
      x_[node].z += by;
  }
}

// Each piece is placed as its shortest link to the placed pieces allows.
void Folder::hang_pieces() {
  const std::vector<LineLink> all = line_links(mesh_, piece_of_node_);
  for (std::size_t round = 0; round < pieces_.size(); ++round) {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (pieces_[i].placed) continue;
      double by = std::numeric_limits<double>::infinity();
      for (const LineLink& link : all) {
        if (piece_of_node_[link.to] != static_cast<int>(i)) continue;
        if (link.from != mesh_.rigging.confluence && !pieces_[piece_of_node_[link.from]].placed) continue;
        by = std::min(by, free_way(link, mesh_, x_, folding_.slack));
      }
      if (std::isfinite(by)) shift(pieces_[i], by);
    }
  }
  for (const Piece& piece : pieces_) {
    if (!piece.placed) {
      throw Error(ExitCode::bad_data, fmt::format("patch \"{}\" cannot be folded: no line is attached to it",
                                                  mesh_.patches[piece.patches[0]].name));
    }
  }
}

void Folder::hang_lines() {
  for (const LineLink& link : line_links(mesh_, piece_of_node_)) hang(link, x_);
}

// A sheet that is folded without strain shortens those springs only that cross a fold.
void drop_folded_springs(Patch& patch, const std::vector<Vec3>& x) {
  for (const Direction d : {shear_up, shear_down, bend_row, bend_column}) {
    for (int i = 0; i < patch.rows * patch.columns; ++i) {
      if (patch.width[d][i] <= 0) continue;
      const int row = i / patch.columns + direction_offset[d].row;
      const int column = i % patch.columns + direction_offset[d].column;
      const double length = norm(x[patch.node(row, column)] - x[patch.first_node + i]);
      if (length < (1 - folded_strain) * patch.rest_length[d][i]) patch.width[d][i] = 0;
    }
  }
}

}  // namespace

void check_folds(const Mesh& mesh, int folds) {
  int common = 0;
  for (const Patch& patch : mesh.patches) common = std::gcd(common, patch.columns);
  if (folds >= 3 && common % (2 * folds) == 0) return;
  std::vector<int> possible;
  for (int n = 3; 2 * n <= common; ++n) {
    if (common % (2 * n) == 0) possible.push_back(n);
  }
  throw QuantityError(
      ExitCode::usage,
      fmt::format(
          "number of folds = {}: fold lines follow columns of the mesh, and its rings have multiples of {} "
          "columns; {}",
          folds, common,
          possible.empty() ? "no number is possible: use more cloth nodes"
                           : fmt::format("possible: {}", fmt::join(possible, ", "))),
      {"number of folds"});
}

bool folds_without_strain(const Mesh& mesh) {
  std::vector<char> tied(mesh.node_count(), 0);  // a tied node lies on a chord
  for (const Tie& tie : mesh.ties) tied[tie.node] = 1;
  for (const Patch& patch : mesh.patches) {
    if (!patch.periodic || patch.rows < 2) return false;
    for (int row = 0; row < patch.rows; ++row) {
      for (int column = 1; column < patch.columns; ++column) {
        const double r = radius_of(mesh.start[patch.node(row, column)]);
        if (!tied[patch.node(row, column)] && !tied[patch.node(row, 0)] &&
            std::abs(r - radius_of(mesh.start[patch.node(row, 0)])) > same)
          return false;
      }
    }
  }
  return true;
}

FoldedStart fold(const CanopyMesh& mesh, const Folding& folding) {
  return Folder(mesh, folding).run();
}

CanopyMesh with_creases(const CanopyMesh& mesh, const FoldedStart& folded) {
  CanopyMesh result = mesh;
  for (Patch& patch : result.patches) {
    if (!patch.periodic) {
      drop_folded_springs(patch, folded.positions);
      continue;
    }
    check_folds(mesh, folded.folds);
    const int strip = patch.columns / (2 * folded.folds);
    for (int row = 0; row < patch.rows; ++row) {
      for (int fold_line = 0; fold_line < 2 * folded.folds; ++fold_line) {
        const int before = (fold_line * strip - 1 + patch.columns) % patch.columns;
        patch.width[bend_row][row * patch.columns + before] = 0;
      }
    }
  }
  return result;
}

StartStrain start_strain(const Mesh& mesh, const std::vector<Vec3>& x) {
  StartStrain result;
  each_spring(mesh, [&](const SpringView& s) {
    double strain = norm(x[s.b] - x[s.a]) / s.rest_length - 1;
    if (strain <= 0 && s.law->tangent(strain) <= 0) return;  // slack
    strain = std::abs(strain);
    if (s.patch >= 0 && (s.direction == bend_row || s.direction == bend_column)) {
      result.bending = std::max(result.bending, strain);
    } else if (strain > result.largest) {
      result.largest = strain;
      result.part = s.patch >= 0 ? mesh.patches[s.patch].name : mesh.parts[mesh.springs[s.index].part];
    }
  });
  return result;
}

}  // namespace ripstop::inline parachute
