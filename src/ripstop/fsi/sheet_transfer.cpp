#include "ripstop/fsi/sheet_transfer.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "ripstop/core/checked_int.h"
#include "ripstop/fsi/in_parts.h"
#include "ripstop/fsi/lattice.h"

namespace ripstop::inline fsi {
namespace {

constexpr double reach = 2.0;  // of the weights, in flow cells
// Directions in which the faces near a cell spread less than this, in reaches squared, determine no slope:
// across the cloth, and along a strip narrower than the flow's cells. A round piece of cloth has 0.1.
constexpr double least_spread = 0.01;

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Area vector and centre of every cell of cloth; no area elsewhere.
struct Patchwork {
  std::vector<Vec3> area, centre;
  Vec3 middle;  // centre of area

  Patchwork(const std::vector<Cell>& cells, const std::vector<Vec3>& x)
      : area(cells.size()), centre(cells.size()) {
    double whole = 0;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const auto& n = cells[c].corner;
      if (n[0] < 0) continue;
      area[c] = area_vector(x[n[0]], x[n[1]], x[n[2]], x[n[3]]);
      centre[c] = 0.25 * (x[n[0]] + x[n[1]] + x[n[2]] + x[n[3]]);
      middle += norm(area[c]) * centre[c];
      whole += norm(area[c]);
    }
    if (whole > 0) middle = middle / whole;
  }
  Vec3 traction(const RigidTraction& t, std::size_t cell) const {
    return t.at_centre + cross(t.twist, centre[cell] - middle);
  }
  /// All that is not pressure.
  Vec3 traction(const ClothLoad& load, std::size_t cell) const {
    const Vec3 rigid = traction(load.residual_traction, cell);
    return load.of_folds.empty() ? rigid : rigid + load.of_folds[cell];
  }
  Vec3 force(const ClothLoad& load, std::size_t cell) const {
    return load.pressure[cell] * area[cell] + norm(area[cell]) * traction(load, cell);
  }
};

Wrench& operator+=(Wrench& sum, const Wrench& other) {
  sum.force += other.force;
  sum.moment += other.moment;
  return sum;
}

Wrench acting_at(Vec3 point, Vec3 force) {
  return {force, cross(point, force)};
}

/// Pressure of the cloth that one face represents.
struct Sample {
  Vec3 point, outward;
  double pressure = 0;                    // inside over outside [Pa]
  double area = 0;                        // [m2]
  std::optional<double> inside, outside;  // of the pressure itself [Pa]
  bool folded = false;                    // another layer lies nearer than a cell, and looks the other way
};

// At a free edge the whole momentum loss of a face acts on the part of it that the cloth covers. Points of such faces
// are outside the cloth and are projected on its plane.
std::vector<Sample> samples_of(const std::vector<SheetLoad>& loads, const std::vector<Triangle>& surface) {
  std::vector<Sample> samples;
  samples.reserve(loads.size());
  for (const SheetLoad& load : loads) {
    if (!(load.area > 0)) continue;
    const Triangle& t = surface[load.triangle];
    const Vec3 normal = cross(t.b - t.a, t.c - t.a);
    const Vec3 off = dot(load.point - t.a, normal) / dot(normal, normal) * normal;
    samples.push_back(
        {load.point - off, load.outward, load.drop / load.cover, load.area, load.inside, load.outside});
  }
  return samples;
}

/// Samples by where they lie, in boxes of `width` about the sheet.
class Boxes {
 public:
  Boxes(const std::vector<Sample>& samples, double width) : width_(width) {
    Vec3 high{-1e300, -1e300, -1e300};
    low_ = {1e300, 1e300, 1e300};
    for (const Sample& s : samples) {
      low_ = {std::min(low_.x, s.point.x), std::min(low_.y, s.point.y), std::min(low_.z, s.point.z)};
      high = {std::max(high.x, s.point.x), std::max(high.y, s.point.y), std::max(high.z, s.point.z)};
    }
    count_ = {box(high.x, low_.x) + 1, box(high.y, low_.y) + 1, box(high.z, low_.z) + 1};
    begin_.assign(room_of(count_) + 1, 0);
    for (const Sample& s : samples) ++begin_[of(s) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    sorted_.resize(samples.size());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (const Sample& s : samples) sorted_[next[of(s)]++] = s;
  }

  /// All within `radius` of `centre`, and some that are not.
  template <class Visit>
  void near(Vec3 centre, double radius, const Visit& visit) const {
    const auto range = [&](double at, double low, int count) {
      return std::pair(std::clamp(box(at - radius, low), 0, count - 1),
                       std::clamp(box(at + radius, low), 0, count - 1));
    };
    const auto [x0, x1] = range(centre.x, low_.x, count_[0]);
    const auto [y0, y1] = range(centre.y, low_.y, count_[1]);
    const auto [z0, z1] = range(centre.z, low_.z, count_[2]);
    for (int z = z0; z <= z1; ++z) {
      for (int y = y0; y <= y1; ++y) {
        for (std::size_t n = begin_[index(x0, y, z)]; n < begin_[index(x1, y, z) + 1]; ++n) visit(sorted_[n]);
      }
    }
  }

 private:
  int box(double at, double low) const {
    return checked_int(std::clamp(std::floor((at - low) / width_), -most_along, most_along), -most_along,
                       most_along, cloth_too_far);
  }
  std::size_t index(int x, int y, int z) const {
    return x + static_cast<std::size_t>(count_[0]) * (y + static_cast<std::size_t>(count_[1]) * z);
  }
  std::size_t of(const Sample& s) const {
    return index(box(s.point.x, low_.x), box(s.point.y, low_.y), box(s.point.z, low_.z));
  }

  double width_;
  Vec3 low_;
  std::array<int, 3> count_{};
  std::vector<std::size_t> begin_;
  std::vector<Sample> sorted_;
};

/// Largest component of FlowGrid::spacing(), from a table: graded edges contain powers.
class Widths {
 public:
  explicit Widths(const FlowGrid& grid)
      : edges_{grid.edges(0), grid.edges(1), grid.edges(2)}, everywhere_(largest(grid.spacing())) {
    if (!grid.uniform()) everywhere_ = 0;
  }

  double at(Vec3 point) const {
    if (everywhere_ > 0) return everywhere_;
    return largest({along(0, point.x), along(1, point.y), along(2, point.z)});
  }

 private:
  static double largest(Vec3 h) { return std::max({h.x, h.y, h.z}); }
  double along(int axis, double x) const {
    const std::vector<double>& edges = edges_[axis];
    const auto inner = edges.end() - 1;  // points beyond the box are in its last cells
    const auto above = std::upper_bound(edges.begin() + 1, inner, x);
    return *above - *(above - 1);
  }

  std::array<std::vector<double>, 3> edges_;
  double everywhere_;  // 0: not the same
};

// Between layers closer than the width of a cell the grid has no separate air: the drop of such a face is that of a
// closed pocket, or of all layers together, and the pressure on the side of that pocket is meaningless.
void find_folds(std::vector<Sample>& samples, const Widths& widths, double box, ThreadTeam* team) {
  const Boxes all(samples, box);
  each_in_parts(team, samples.size(), [&](std::size_t n) {
    Sample& sample = samples[n];
    const double width = widths.at(sample.point);
    all.near(sample.point, width, [&](const Sample& s) {
      const Vec3 d = s.point - sample.point;
      if (!(dot(s.outward, sample.outward) < 0) || !(dot(d, d) < width * width)) return;
      sample.folded = true;
      (dot(d, sample.outward) > 0 ? sample.outside : sample.inside).reset();
    });
  });
}

/// How far the faces about a cell of cloth reach.
struct Reaches {
  Reaches(const Patchwork& cloth, const Widths& widths, double longest)
      : of_cell(cloth.centre.size()), farthest(longest) {
    for (std::size_t c = 0; c < of_cell.size(); ++c) of_cell[c] = reach * widths.at(cloth.centre[c]);
  }
  std::vector<double> of_cell;  // [m]
  double farthest;              // the largest one [m]
};

enum class Side { same, either };

// The plane through the samples within `radius` of the same orientation, by weighted least squares: exact for
// pressures that are linear in space. Nothing if there is no such sample.
bool plane_through(const Boxes& samples, Vec3 centre, Vec3 normal, double radius, Side side,
                   double& pressure) {
  double weights = 0, mean = 0;
  Eigen::Vector3d at = Eigen::Vector3d::Zero(), slope = Eigen::Vector3d::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  samples.near(centre, radius, [&](const Sample& s) {
    const Vec3 d = (s.point - centre) / radius;
    const double inside = 1 - dot(d, d), facing = side == Side::either ? 1 : dot(s.outward, normal);
    if (inside <= 0 || facing <= 0) return;
    const double w = s.area * facing * inside * inside;
    const Eigen::Vector3d e(d.x, d.y, d.z);
    weights += w;
    mean += w * s.pressure;
    at += w * e;
    slope += w * s.pressure * e;
    spread += w * e * e.transpose();
  });
  if (!(weights > 0)) return false;
  mean /= weights;
  at /= weights;
  slope = slope / weights - mean * at;
  spread = spread / weights - at * at.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  const Eigen::Vector3d along =
      (axes.eigenvectors().transpose() * slope).cwiseQuotient(axes.eigenvalues().cwiseMax(least_spread));
  pressure = mean - (axes.eigenvectors() * along).dot(at);
  return true;
}

std::vector<double> pressures(const std::vector<Sample>& samples, const Reaches& reaches,
                              const Patchwork& cloth, double box, ThreadTeam* team) {
  std::vector<double> result(cloth.area.size(), 0.0);
  if (samples.empty()) return result;
  std::vector<Sample> believed;
  for (const Sample& s : samples)
    if (!s.folded) believed.push_back(s);
  const Boxes boxes(believed.empty() ? samples : believed, box);
  each_in_parts(team, result.size(), [&](std::size_t c) {
    const double area = norm(cloth.area[c]);
    if (!(area > 0)) return;
    // Cloth that no face represents, at a seam or in a fold smaller than the cells, takes the nearest value.
    double radius = reaches.of_cell[c];
    Side side = Side::same;
    while (!plane_through(boxes, cloth.centre[c], cloth.area[c] / area, radius, side, result[c]) &&
           radius < reaches.farthest) {
      radius *= 1.5;
      side = Side::either;
    }
  });
  return result;
}

/// A weighted mean of values.
struct Mean {
  double weights = 0, sum = 0;
  bool known() const { return weights > 0; }
  double value() const { return known() ? sum / weights : 0; }
};

// Difference of the mean pressures on both sides of the cloth about a point, each from the nearest values of the grid.
double difference_at(const Boxes& samples, Vec3 centre, double radius, double farthest) {
  Mean inner, outer;
  for (; !(inner.known() && outer.known()) && radius < farthest; radius *= 1.5) {
    const bool seeks_inner = !inner.known(), seeks_outer = !outer.known();
    samples.near(centre, radius, [&](const Sample& s) {
      const Vec3 d = (s.point - centre) / radius;
      const double inside = 1 - dot(d, d);
      if (inside <= 0) return;
      const double w = s.area * inside * inside;
      if (seeks_inner && s.inside) inner.weights += w, inner.sum += w * *s.inside;
      if (seeks_outer && s.outside) outer.weights += w, outer.sum += w * *s.outside;
    });
  }
  return inner.value() - outer.value();
}

// The air in a pleat is connected to that at its mouth, however narrow it is: cloth among folds takes the difference
// of the pressures of the grid on its two sides nearby. Elsewhere `pressure` is unchanged.
void press_into_folds(const Boxes& samples, const Reaches& reaches, const Patchwork& cloth,
                      std::vector<double>& pressure, ThreadTeam* team) {
  const double farthest = reaches.farthest;
  each_in_parts(team, pressure.size(), [&](std::size_t c) {
    const double radius = reaches.of_cell[c];
    double all = 0, folded = 0;
    if (norm(cloth.area[c]) > 0)
      samples.near(cloth.centre[c], radius, [&](const Sample& s) {
        const Vec3 d = (s.point - cloth.centre[c]) / radius;
        const double w = s.area * std::pow(std::max(1 - dot(d, d), 0.0), 2);
        all += w, folded += s.folded ? w : 0;
      });
    if (!(folded > 0)) return;
    const double difference = difference_at(samples, cloth.centre[c], radius, farthest);
    pressure[c] += folded / all * (difference - pressure[c]);
  });
}

// Force of the air beyond that of the pressures, where there are folds: a traction of the cloth nearby, so that
// force that the air exerts on a part of the canopy stays there.
std::vector<Vec3> fold_tractions(const std::vector<SheetLoad>& loads, const std::vector<Sample>& samples,
                                 const Widths& widths, const Patchwork& cloth,
                                 const std::vector<double>& pressure, ThreadTeam* team) {
  struct Sum {
    Vec3 force;                            // that is left [N]
    double area = 0, all = 0, folded = 0;  // of cloth, samples and samples in folds [m2]
  };
  std::vector<Vec3> result(cloth.area.size());
  std::vector<Vec3> places;
  for (const SheetLoad& load : loads) places.push_back(load.point);
  for (const Sample& s : samples) places.push_back(s.point);
  for (std::size_t c = 0; c < result.size(); ++c)
    if (norm(cloth.area[c]) > 0) places.push_back(cloth.centre[c]);
  Lattice<Sum> lattice(places, reach * widths.at(cloth.middle));
  for (const SheetLoad& load : loads)
    lattice.about(load.point, [&](Sum& sum, double share) { sum.force += share * load.force; });
  for (const Sample& s : samples)
    lattice.about(s.point, [&](Sum& sum, double share) {
      sum.all += share * s.area, sum.folded += s.folded ? share * s.area : 0;
    });
  for (std::size_t c = 0; c < result.size(); ++c) {
    if (!(norm(cloth.area[c]) > 0)) continue;
    lattice.about(cloth.centre[c], [&](Sum& sum, double share) {
      sum.force += -share * pressure[c] * cloth.area[c];
      sum.area += share * norm(cloth.area[c]);
    });
  }
  each_in_parts(team, result.size(), [&](std::size_t c) {
    if (!(norm(cloth.area[c]) > 0)) return;
    lattice.about(cloth.centre[c], [&](const Sum& sum, double share) {
      if (sum.all > 0)
        result[c] += share * sum.folded / sum.all / std::max(sum.area, 0.2 * sum.all) * sum.force;
    });
  });
  return result;
}

// t = a + b x (x - c) with given force and moment about c: the smallest integral of t^2 over the cloth with these
// sums (Lagrange multipliers a and b).
RigidTraction smallest_traction(const Patchwork& cloth, Vec3 force, Vec3 moment) {
  Matrix6 matrix = Matrix6::Zero();
  double size = 0, whole = 0;
  for (std::size_t c = 0; c < cloth.area.size(); ++c) {
    const Vec3 r = cloth.centre[c] - cloth.middle;
    whole += norm(cloth.area[c]), size += norm(cloth.area[c]) * dot(r, r);
  }
  if (!(size > 0)) return {};
  size = std::sqrt(size / whole);  // makes the unknowns alike: a and b size
  for (std::size_t c = 0; c < cloth.area.size(); ++c) {
    const Vec3 r = (cloth.centre[c] - cloth.middle) / size;
    Eigen::Matrix3d turn;  // turn * v = v x r
    turn << 0, r.z, -r.y, -r.z, 0, r.x, r.y, -r.x, 0;
    Eigen::Matrix<double, 3, 6> traction;
    traction << Eigen::Matrix3d::Identity(), turn;
    matrix += norm(cloth.area[c]) * traction.transpose() * traction;
  }
  Vector6 right;
  right << force.x, force.y, force.z, moment.x / size, moment.y / size, moment.z / size;
  const Vector6 t = matrix.ldlt().solve(right);
  return {{t(0), t(1), t(2)}, Vec3{t(3), t(4), t(5)} / size};
}

}  // namespace

Wrench wrench_of(const std::vector<SheetLoad>& loads) {
  Wrench sum;
  for (const SheetLoad& load : loads) sum += acting_at(load.point, load.force);
  return sum;
}

Wrench wrench_of(const ClothLoad& load, const std::vector<Cell>& cells, const std::vector<Vec3>& x) {
  const Patchwork cloth(cells, x);
  Wrench sum;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    sum += acting_at(cloth.centre[c], cloth.force(load, c));
  }
  return sum;
}

ClothLoad load_of_flow(const std::vector<SheetLoad>& loads, const FlowGrid& grid,
                       const std::vector<Triangle>& surface, const std::vector<Cell>& cells,
                       const std::vector<Vec3>& x, Folds folds, ThreadTeam* team) {
  if (!std::all_of(x.begin(), x.end(), is_finite)) throw Error(ExitCode::diverged, cloth_too_far());
  const Patchwork cloth(cells, x);
  std::vector<Sample> samples = samples_of(loads, surface);
  const Widths widths(grid);
  const double box = samples.empty() ? 1 : 0.5 * reach * widths.at(samples.front().point);
  find_folds(samples, widths, box, team);
  const Reaches reaches(cloth, widths, norm(grid.size));
  ClothLoad load{pressures(samples, reaches, cloth, box, team), {}, {}};
  if (folds == Folds::filled && !samples.empty()) {
    press_into_folds(Boxes(samples, box), reaches, cloth, load.pressure, team);
    load.of_folds = fold_tractions(loads, samples, widths, cloth, load.pressure, team);
  }
  const Wrench air = wrench_of(loads), plain = wrench_of(load, cells, x);
  const Vec3 force = air.force - plain.force;
  load.residual_traction =
      smallest_traction(cloth, force, air.moment - plain.moment - cross(cloth.middle, force));
  return load;
}

std::vector<Vec3> node_forces(const ClothLoad& load, const std::vector<Cell>& cells,
                              const std::vector<Vec3>& x) {
  const Patchwork cloth(cells, x);
  std::vector<Vec3> force(x.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c].corner[0] < 0) continue;
    const Vec3 each = 0.25 * cloth.force(load, c);
    for (const int node : cells[c].corner) force[node] += each;
  }
  return force;
}

double residual_traction_share(const ClothLoad& load, const std::vector<Cell>& cells,
                               const std::vector<Vec3>& x) {
  const Patchwork cloth(cells, x);
  double traction = 0, pressure = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const Vec3 t = cloth.traction(load, c);
    traction += norm(cloth.area[c]) * dot(t, t);
    pressure += norm(cloth.area[c]) * load.pressure[c] * load.pressure[c];
  }
  return pressure > 0 ? std::sqrt(traction / pressure) : 0;
}

}  // namespace ripstop::inline fsi
