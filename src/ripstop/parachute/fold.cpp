#include "ripstop/parachute/fold.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double same = 1e-9;  // lengths closer than this are equal [m]

double radius_of(Vec3 p) {
  return std::hypot(p.x, p.y);
}

void check_folds(const Mesh& mesh, int folds) {
  int common = 0;
  for (const Patch& patch : mesh.patches) common = std::gcd(common, patch.columns);
  if (folds >= 3 && common % (2 * folds) == 0) return;
  std::vector<int> possible;
  for (int n = 3; 2 * n <= common; ++n) {
    if (common % (2 * n) == 0) possible.push_back(n);
  }
  throw Error(
      ExitCode::usage,
      fmt::format(
          "inflation.folds = {}: fold lines follow columns of the mesh, and its rings have multiples of {} "
          "columns; {}",
          folds, common,
          possible.empty() ? "no number of folds fits: ask for more cloth_nodes"
                           : fmt::format("possible: {}", fmt::join(possible, ", "))));
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
  if (!patch.periodic || patch.rows < 2) refuse("it does not go round the axis");
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
        refuse("it is neither a disk nor a cylinder nor a frustum");
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
  Folder(const Mesh& mesh, const Folding& folding)
      : mesh_(mesh),
        folding_(folding),
        folds_(folding.folds > 0 ? folding.folds : static_cast<int>(mesh.lines.size())),
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
    if (mesh_.lines.empty() || mesh_.skirt_nodes.empty()) {
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
  // A part of a line between two nodes of the cloth, or the confluence and one.
  struct Link {
    int from, to;
    std::vector<int> nodes;       // all of them, ends included
    std::vector<double> lengths;  // rest lengths between them
    double length() const { return std::accumulate(lengths.begin(), lengths.end(), 0.0); }
  };

  void choose_radii();
  void place_unshifted(const Piece& piece);
  void hang_pieces();
  void hang_lines();
  void hang(const Link& link);
  void shift(Piece& piece, double by);
  std::vector<Link> links() const;
  Piece& skirt_piece() { return pieces_[piece_of_node_[mesh_.skirt_nodes[0]]]; }
  int columns_of(const Piece& piece) const { return mesh_.patches[piece.patches[0]].columns; }
  [[noreturn]] void refuse_radius(const Piece& skirt) const;

  const Mesh& mesh_;
  Folding folding_;
  int folds_;
  Zigzag zigzag_;
  std::vector<Piece> pieces_;
  std::vector<int> piece_of_node_;
  std::vector<Vec3> x_;
};

void Folder::refuse_radius(const Piece& skirt) const {
  throw Error(
      ExitCode::usage,
      fmt::format(
          "inflation.initial_radius_m = {}: with {} folds the skirt, {:.4g} m in radius as cut, folds to "
          "radii from {:.4g} m to below {:.4g} m; more folds allow smaller ones",
          folding_.initial_radius, folds_, skirt.radius,
          0.5 * zigzag_.outer_radius(skirt, columns_of(skirt), 0), skirt.radius));
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

std::vector<Folder::Link> Folder::links() const {
  std::vector<Link> links;
  for (const LineRun& line : mesh_.lines) {
    Link link{mesh_.confluence, -1, {mesh_.confluence}, {}};
    for (const int s : line.springs) {
      const Spring& spring = mesh_.springs[s];
      const int next = spring.a == link.nodes.back() ? spring.b : spring.a;
      link.nodes.push_back(next);
      link.lengths.push_back(spring.rest_length);
      if (piece_of_node_[next] < 0) continue;
      link.to = next;
      if (link.from == mesh_.confluence || piece_of_node_[link.from] != piece_of_node_[next])
        links.push_back(link);
      link = {next, -1, {next}, {}};
    }
  }
  return links;
}

void Folder::shift(Piece& piece, double by) {
  piece.placed = true;
  for (const int p : piece.patches) {
    const Patch& patch = mesh_.patches[p];
    for (int node = patch.first_node; node < patch.first_node + patch.rows * patch.columns; ++node)
      x_[node].z += by;
  }
}

// A link allows its far end to lie downstream of its near end by sqrt(length^2 - lateral^2). Each piece goes
// where its shortest link to what is already placed allows.
void Folder::hang_pieces() {
  const std::vector<Link> all = links();
  for (std::size_t round = 0; round < pieces_.size(); ++round) {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (pieces_[i].placed) continue;
      double by = std::numeric_limits<double>::infinity();
      for (const Link& link : all) {
        const bool free_part = link.from == mesh_.confluence;
        if (piece_of_node_[link.to] != static_cast<int>(i)) continue;
        if (!free_part && !pieces_[piece_of_node_[link.from]].placed) continue;
        const double length = link.length() - (free_part ? folding_.slack : 0.0);
        const Vec3 from = x_[link.from], to = x_[link.to];
        const double lateral = std::hypot(to.x - from.x, to.y - from.y);
        if (!(length > lateral)) {
          throw Error(ExitCode::usage,
                      fmt::format("inflation.slack_m = {}: a line of {:.4g} m does not reach from the "
                                  "confluence to the folded skirt at {:.4g} m from the axis",
                                  folding_.slack, link.length(), lateral));
        }
        by = std::min(by, from.z + std::sqrt(length * length - lateral * lateral) - to.z);
      }
      if (std::isfinite(by)) shift(pieces_[i], by);
    }
  }
  for (const Piece& piece : pieces_) {
    if (!piece.placed) {
      throw Error(ExitCode::bad_data, fmt::format("patch \"{}\" cannot be folded: no line holds it",
                                                  mesh_.patches[piece.patches[0]].name));
    }
  }
}

void Folder::hang_lines() {
  for (const Link& link : links()) hang(link);
}

// A link's inner nodes: on the straight way when it is taut, else on the arc of a circle that bulges away
// from the axis, every segment a chord of its rest length: D = (2 / k) sin(sum asin(l_i k / 2)) for the
// curvature k.
void Folder::hang(const Link& link) {
  const Vec3 from = x_[link.from], to = x_[link.to];
  const double distance = norm(to - from), length = link.length();
  if (link.nodes.size() < 3) return;
  const Vec3 way = (to - from) / distance;
  const auto half_angle = [&](double curvature) {
    double sum = 0;
    for (const double l : link.lengths) sum += std::asin(std::min(1.0, 0.5 * l * curvature));
    return sum;
  };
  double low = 0, high = 2 / *std::max_element(link.lengths.begin(), link.lengths.end());
  if (length > distance * (1 + 1e-12)) {
    for (int i = 0; i < 200; ++i) {
      const double k = 0.5 * (low + high);
      const double half = half_angle(k);
      (half < pi && 2 / k * std::sin(half) > distance ? low : high) = k;
    }
  }
  const double curvature = low, half = half_angle(curvature);
  const double azimuth = std::atan2(to.y, to.x);
  const Vec3 outward{std::cos(azimuth), std::sin(azimuth), 0};
  const Vec3 across = outward - dot(outward, way) * way;
  const Vec3 side = across / norm(across);
  double turned = -half;  // angle on the circle, from the middle of the arc
  Vec3 p = from;
  for (std::size_t i = 0; i + 2 < link.nodes.size(); ++i) {
    const double step = 2 * std::asin(std::min(1.0, 0.5 * link.lengths[i] * curvature));
    // A segment points along the circle's tangent at its middle.
    const double tangent = turned + 0.5 * step;
    const double l = curvature > 0 ? link.lengths[i] : link.lengths[i] * distance / length;
    p += l * (std::cos(tangent) * way - std::sin(tangent) * side);
    turned += step;
    x_[link.nodes[i + 1]] = p;
  }
}

}  // namespace

FoldedStart fold(const Mesh& mesh, const Folding& folding) {
  return Folder(mesh, folding).run();
}

Mesh with_creases(const Mesh& mesh, int folds) {
  check_folds(mesh, folds);
  Mesh result = mesh;
  for (Patch& patch : result.patches) {
    const int strip = patch.columns / (2 * folds);
    for (int row = 0; row < patch.rows; ++row) {
      for (int fold_line = 0; fold_line < 2 * folds; ++fold_line) {
        const int before = (fold_line * strip - 1 + patch.columns) % patch.columns;
        patch.width[bend_row][row * patch.columns + before] = 0;
      }
    }
  }
  return result;
}

StartStrain start_strain(const Mesh& mesh, const std::vector<Vec3>& x) {
  StartStrain result;
  const auto strain_of = [&](int a, int b, double rest, double compression) {
    const double strain = norm(x[b] - x[a]) / rest - 1;
    return strain > 0 || compression > 0 ? std::abs(strain) : 0.0;
  };
  for (const Patch& patch : mesh.patches) {
    for (int d = 0; d < direction_count; ++d) {
      for (int i = 0; i < patch.rows * patch.columns; ++i) {
        if (patch.width[d][i] <= 0) continue;
        const int row = i / patch.columns, column = i % patch.columns;
        const int other = (column + direction_offset[d].column + patch.columns) % patch.columns;
        const double strain =
            strain_of(patch.node(row, column), patch.node(row + direction_offset[d].row, other),
                      patch.rest_length[d][i], patch.law[d].compression);
        if (d == bend_row || d == bend_column) {
          result.bending = std::max(result.bending, strain);
        } else if (strain > result.largest) {
          result.largest = strain;
          result.part = patch.name;
        }
      }
    }
  }
  for (const Spring& spring : mesh.springs) {
    const double strain =
        strain_of(spring.a, spring.b, spring.rest_length, mesh.laws[spring.law].compression);
    if (strain <= result.largest) continue;
    result.largest = strain;
    result.part = mesh.parts[spring.part];
  }
  return result;
}

}  // namespace ripstop
