#include "ripstop/parachute/disk_gap_band.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "ripstop/core/error.h"
#include "ripstop/parachute/builder.h"

namespace ripstop {
namespace {

constexpr double pi = std::numbers::pi;

// A ring of the disk with a constant number of columns.
struct Ring {
  int columns;
  double outer, inner;  // radii [m]
  int cells;            // radial cells
};

struct Lattice {
  int columns;  // of band and disk edge
  int band_cells;
  std::vector<Ring> rings;  // from the edge to the vent

  int nodes() const {
    int count = columns * (band_cells + 1);
    for (const Ring& ring : rings) count += ring.columns * (ring.cells + 1);
    return count;
  }
};

int cells_for(double length, double spacing) {
  return std::max(2, static_cast<int>(std::lround(length / spacing)));
}

// Columns are halved where they are closer than this many times the mean spacing, or wider just below: 0.72
// and 1.44.
constexpr double closest = 0.72;

Lattice lay_out(const DiskGapBand& d, int columns, double spacing, double radial_spacing,
                int columns_multiple) {
  Lattice lattice{columns, cells_for(d.band_height_m, radial_spacing), {}};
  double outer = 0.5 * d.disk_diameter_m;
  const double vent = 0.5 * d.vent_diameter_m;
  while (true) {
    double inner = closest * spacing * columns / (2 * pi);
    const bool last = columns % (2 * columns_multiple) != 0 || inner < vent + spacing;
    if (last) inner = vent;
    if (outer - inner > 1.5 * radial_spacing || last) {
      lattice.rings.push_back({columns, outer, inner, cells_for(outer - inner, radial_spacing)});
      outer = inner;
    }
    if (last) return lattice;
    columns /= 2;
  }
}

// The lattice whose node count is nearest to the one asked for, among those whose columns meet every gore
// seam and every line and can be halved down to about the mean spacing at the vent.
Lattice choose_lattice(const DiskGapBand& d, const Design& design) {
  const int nodes = design.mesh.cloth_nodes;
  const double spacing = std::sqrt(computed_area(design) / nodes);
  const int multiple = std::lcm(design.gores, design.lines.count);
  const double vent_columns = pi * d.vent_diameter_m / spacing;
  const double edge_columns = pi * d.disk_diameter_m / spacing;
  Lattice best{};
  double best_score = 1e300;
  for (int base = multiple; base <= 2 * edge_columns; base += multiple) {
    for (int columns = base; columns <= 2 * edge_columns; columns *= 2) {
      // Squareness of the cells at the edge and at the vent, as logarithms of the spacing's departure from
      // the mean.
      const double at_edge = std::log(columns / edge_columns);
      const double at_vent = std::log(std::max(1.0, base / vent_columns));
      const double score = at_edge * at_edge + 0.5 * at_vent * at_vent;
      if (score >= best_score) continue;
      best_score = score;
      best.columns = columns;
    }
  }
  if (best.columns == 0) {
    throw Error(
        ExitCode::usage,
        fmt::format(
            "parachute.mesh.cloth_nodes = {}: too few for {} gores and {} lines, whose seams and radials "
            "need columns in multiples of {}; ask for more nodes",
            nodes, design.gores, design.lines.count, multiple));
  }
  // The radial spacing is what is left to meet the node count.
  const int columns = best.columns;
  double low = 0.2 * spacing, high = 5 * spacing;
  for (int i = 0; i < 60; ++i) {
    const double middle = std::sqrt(low * high);
    (lay_out(d, columns, spacing, middle, multiple).nodes() > nodes ? low : high) = middle;
  }
  return lay_out(d, columns, spacing, high, multiple);
}

// A point of the disk or band as the lines run: nodes from the skirt up, across the gap, to the vent.
struct Radial {
  std::vector<int> band, disk;
};

class Builder {
 public:
  Builder(const DiskGapBand& canopy, const Design& design, const PartMaterials& materials)
      : d_(canopy), design_(design), materials_(materials) {}

  Mesh build() {
    lattice_ = choose_lattice(d_, design_);
    add_band();
    add_disk();
    if (design_.tape.hems) add_hem_tape();
    if (design_.tape.seams) add_seam_tape();
    add_lines();
    builder_.flatten_ties();
    return std::move(builder_.mesh);
  }

 private:
  void add_band();
  void add_disk();
  void add_hem_tape();
  void add_seam_tape();
  void add_lines();
  Radial radial_at(int part, int parts) const;
  std::vector<int> sew(const std::vector<int>& path, double length);

  double skirt_to_disk() const { return d_.band_height_m + d_.gap_height_m; }
  int tape_law() {
    if (tape_law_ < 0)
      tape_law_ = builder_.law({materials_.tape.coefficients_n_m, materials_.tape.compression});
    return tape_law_;
  }
  const Patch& patch(int index) const { return builder_.mesh.patches[index]; }
  std::vector<int> row_nodes(const Patch& patch, int row) const {
    std::vector<int> nodes(patch.columns);
    std::iota(nodes.begin(), nodes.end(), patch.node(row, 0));
    return nodes;
  }

  const DiskGapBand& d_;
  const Design& design_;
  const PartMaterials& materials_;
  Lattice lattice_{};
  MeshBuilder builder_;
  int band_ = -1;
  std::vector<int> rings_;
  int tape_law_ = -1;
};

void Builder::add_band() {
  const double radius = 0.5 * d_.disk_diameter_m;
  const int rows = lattice_.band_cells + 1;
  band_ = builder_.add_patch("band", rows, lattice_.columns, true, true, materials_.canopy,
                             [&](int row, int column) {
                               const double angle = 2 * pi * column / lattice_.columns;
                               return Vec3{radius * std::cos(angle), radius * std::sin(angle),
                                           d_.band_height_m * row / lattice_.band_cells};
                             });
  builder_.mesh.skirt_nodes = row_nodes(patch(band_), 0);
}

void Builder::add_disk() {
  for (std::size_t k = 0; k < lattice_.rings.size(); ++k) {
    const Ring& ring = lattice_.rings[k];
    const bool refined = k + 1 < lattice_.rings.size();  // its last row is tied to the coarser ring
    const auto polar = [&](double radius, int column, int columns) {
      const double angle = 2 * pi * column / columns;
      return Vec3{radius * std::cos(angle), radius * std::sin(angle), skirt_to_disk()};
    };
    rings_.push_back(builder_.add_patch(
        "disk", ring.cells + 1, ring.columns, true, false, materials_.canopy, [&](int row, int column) {
          const double radius = ring.outer + (ring.inner - ring.outer) * row / ring.cells;
          if (refined && row == ring.cells && column % 2 == 1) {
            // In the middle of the coarser ring's chord, so that the tie is exact in the start shape.
            return 0.5 * (polar(radius, column - 1, ring.columns) + polar(radius, column + 1, ring.columns));
          }
          return polar(radius, column, ring.columns);
        }));
    if (k == 0) continue;
    const Patch& fine = patch(rings_[k - 1]);
    const Patch& coarse = patch(rings_[k]);
    for (int column = 0; column < fine.columns; ++column) {
      const int left = coarse.node(0, column / 2);
      const int right = coarse.node(0, (column / 2 + 1) % coarse.columns);
      const int node = fine.node(fine.rows - 1, column);
      if (column % 2 == 0) {
        builder_.tie(node, {{left, 1.0}});
      } else {
        builder_.tie(node, {{left, 0.5}, {right, 0.5}});
      }
    }
  }
}

void Builder::add_hem_tape() {
  const int part = builder_.part("hem tape");
  const Patch& band = patch(band_);
  for (const std::vector<int>& hem :
       {row_nodes(band, 0), row_nodes(band, band.rows - 1), row_nodes(patch(rings_.front()), 0),
        row_nodes(patch(rings_.back()), patch(rings_.back()).rows - 1)}) {
    builder_.add_tape(hem, true, materials_.tape, tape_law(), part);
  }
}

void Builder::add_seam_tape() {
  const int part = builder_.part("seam tape");
  for (int gore = 0; gore < design_.gores; ++gore) {
    const Radial seam = radial_at(gore, design_.gores);
    builder_.add_tape(seam.band, false, materials_.tape, tape_law(), part);
    builder_.add_tape(seam.disk, false, materials_.tape, tape_law(), part);
  }
}

Radial Builder::radial_at(int part, int parts) const {
  Radial radial;
  const auto column = [&](const Patch& p) { return p.columns / parts * part; };
  const Patch& band = patch(band_);
  for (int row = 0; row < band.rows; ++row) radial.band.push_back(band.node(row, column(band)));
  for (std::size_t k = 0; k < rings_.size(); ++k) {
    const Patch& ring = patch(rings_[k]);
    const int rows =
        k + 1 < rings_.size() ? ring.rows - 1 : ring.rows;  // the next ring holds the shared node
    for (int row = 0; row < rows; ++row) radial.disk.push_back(ring.node(row, column(ring)));
  }
  return radial;
}

// Chooses the nodes of `path` (a straight run of cloth nodes) that become nodes of the line, at least
// line_segment_m apart, and ties the nodes between to them. Goes no farther than `length`.
std::vector<int> Builder::sew(const std::vector<int>& path, double length) {
  const std::vector<Vec3>& x = builder_.mesh.start;
  std::vector<double> s(path.size());
  for (std::size_t i = 1; i < path.size(); ++i) s[i] = s[i - 1] + norm(x[path[i]] - x[path[i - 1]]);
  std::size_t end = 0;
  while (end + 1 < path.size() && s[end + 1] <= length * (1 + 1e-9)) ++end;
  if (end == 0) return {path[0]};
  std::vector<std::size_t> chosen;
  for (int segments = std::max(1, static_cast<int>(s[end] / design_.mesh.line_segment_m)); segments >= 1;
       --segments) {
    chosen.assign(1, 0);
    double shortest = s[end];
    for (int k = 1; k <= segments; ++k) {
      const double target = s[end] * k / segments;
      std::size_t i = chosen.back() + 1;
      while (i < end && std::abs(s[i + 1] - target) < std::abs(s[i] - target)) ++i;
      shortest = std::min(shortest, s[i] - s[chosen.back()]);
      chosen.push_back(i);
    }
    if (shortest >= 0.95 * design_.mesh.line_segment_m || segments == 1) break;
  }
  std::vector<int> nodes{path[0]};
  for (std::size_t k = 1; k < chosen.size(); ++k) {
    const std::size_t from = chosen[k - 1], to = chosen[k];
    for (std::size_t i = from + 1; i < to; ++i) {
      const double weight = (s[i] - s[from]) / (s[to] - s[from]);
      builder_.tie(path[i], {{path[from], 1 - weight}, {path[to], weight}});
    }
    nodes.push_back(path[to]);
  }
  return nodes;
}

void Builder::add_lines() {
  Mesh& mesh = builder_.mesh;
  const double radius = 0.5 * d_.disk_diameter_m;
  const double reach = std::sqrt(design_.lines.length_m * design_.lines.length_m - radius * radius);
  const Line& line = materials_.line;
  const SpringLaw whole{line.coefficients_n, line.compression};
  // Any cross-section of a chain is crossed by one axial and two bending springs: together they are the
  // line's law.
  const int axial = builder_.law(whole.scaled(1 - line.bending_fraction));
  const int bending = builder_.law(whole.scaled(0.5 * line.bending_fraction));

  mesh.confluence = builder_.add_node({0, 0, -reach}, 0);
  const int free_segments =
      std::max(1, static_cast<int>(design_.lines.length_m / design_.mesh.line_segment_m));
  for (int k = 0; k < design_.lines.count; ++k) {
    const Radial radial = radial_at(k, design_.lines.count);
    const Vec3 skirt = mesh.start[radial.band.front()], confluence = mesh.start[mesh.confluence];
    std::vector<int> nodes{mesh.confluence};
    for (int i = 1; i < free_segments; ++i) {
      nodes.push_back(builder_.add_node(confluence + (skirt - confluence) * (double(i) / free_segments), 0));
    }
    for (const int node : sew(radial.band, d_.band_height_m)) nodes.push_back(node);
    for (const int node : sew(radial.disk, line_length_on_disk(design_))) nodes.push_back(node);
    const int part = builder_.part(fmt::format("line {}", k + 1));
    mesh.lines.push_back(
        {k, builder_.add_chain(nodes, line, axial, bending, part), free_segments, 1 - line.bending_fraction});
  }

  if (design_.riser.length_m <= 0) {
    mesh.fixed = {mesh.confluence};
    return;
  }
  const Line& riser = materials_.riser;
  const SpringLaw law{riser.coefficients_n, riser.compression};
  const int segments = std::max(1, static_cast<int>(design_.riser.length_m / design_.mesh.line_segment_m));
  const Vec3 confluence = mesh.start[mesh.confluence];
  std::vector<int> nodes;
  for (int i = 0; i < segments; ++i) {
    nodes.push_back(
        builder_.add_node(confluence - Vec3{0, 0, design_.riser.length_m * (1 - double(i) / segments)}, 0));
  }
  nodes.push_back(mesh.confluence);
  mesh.riser_springs =
      builder_.add_chain(nodes, riser, builder_.law(law.scaled(1 - riser.bending_fraction)),
                         builder_.law(law.scaled(0.5 * riser.bending_fraction)), builder_.part("riser"));
  mesh.fixed = {nodes.front()};
}

}  // namespace

Mesh build_canopy(const DiskGapBand& canopy, const Design& design, const PartMaterials& materials) {
  return Builder(canopy, design, materials).build();
}

}  // namespace ripstop
