#include "ripstop/parachute/gored.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "ripstop/core/error.h"
#include "ripstop/parachute/ring_layout.h"
#include "ripstop/parachute/sewing.h"

namespace ripstop {
namespace {

using std::numbers::pi;

// A line sewn over a sharper corner than this is two runs: nodes tied between two nodes of the line lie on a
// straight segment.
constexpr double sharp_corner = 20 * pi / 180;

class Builder {
 public:
  Builder(const GorePattern& pattern, const Design& design, const PartMaterials& materials)
      : pattern_(pattern),
        design_(design),
        materials_(materials),
        profile_(start_profile(pattern)),
        lines_reach_vent_(line_length_on_disk(design) >= facts(pattern).line_run * (1 - 1e-9)) {}

  Mesh build() {
    std::vector<Strip> strips;
    for (const GoreStrip& strip : pattern_.strips)
      strips.push_back(
          {strip.length(), [&](double s) { return pattern_.gores * strip.width(s); }, strip.whole});
    const RingLayout layout = lay_out_rings(strips, facts(pattern_).cloth_area, design_);
    for (std::size_t i = 0; i < strips.size(); ++i) add_strip(static_cast<int>(i), layout.strips[i]);
    for (std::size_t i = 1; i < strips.size(); ++i) attach(static_cast<int>(i));
    Path skirt = builder_.row(patches_.front().front(), 0);
    skirt.nodes.pop_back();
    builder_.mesh.skirt_nodes = skirt.nodes;
    add_tapes();
    add_sewn_lines();
    builder_.flatten_ties();
    return std::move(builder_.mesh);
  }

 private:
  void add_strip(int index, const std::vector<Ring>& rings);
  void attach(int index);
  void add_tapes();
  void add_vertical_tapes(int law);
  void add_sewn_lines();

  Vec3 start(int strip, double height, int gore, double across) const;
  ProfilePoint profile_at(int strip, double height) const;
  Path radial(int index, int part, int parts) const;
  std::vector<Path> runs_along(int part, int parts) const;
  Path along(int part, int parts) const;
  double slot_along(int index, int part, int parts) const;
  bool has_corner_below(int index) const;
  const Patch& patch(int index) const { return builder_.mesh.patches[index]; }

  const GorePattern& pattern_;
  const Design& design_;
  const PartMaterials& materials_;
  Profile profile_;
  bool lines_reach_vent_;
  MeshBuilder builder_;
  std::vector<std::vector<int>> patches_;  // of every strip
};

ProfilePoint Builder::profile_at(int strip, double height) const {
  const std::vector<Station>& stations = pattern_.strips[strip].stations;
  std::size_t i = 1;
  while (i + 1 < stations.size() && stations[i].height < height) ++i;
  const double share = (height - stations[i - 1].height) / (stations[i].height - stations[i - 1].height);
  const ProfilePoint a = profile_[strip][i - 1], b = profile_[strip][i];
  return {a.apothem + share * (b.apothem - a.apothem), a.z + share * (b.z - a.z)};
}

// Fullness f makes the width (1 + f) chord, which a parabola of sagitta chord sqrt(3 f / 8) takes up. The
// sail keeps its height when it tilts about its upper edge by the slope g of the sagitta: it rises by h (1 -
// sqrt(1 - g^2)).
Vec3 Builder::start(int index, double height, int gore, double across) const {
  constexpr double steepest = 0.8;
  const GoreStrip& strip = pattern_.strips[index];
  const double angle = 2 * pi * (gore + 0.5) / pattern_.gores;
  const Vec3 outward{std::cos(angle), std::sin(angle), 0}, sideways{-outward.y, outward.x, 0};
  const ProfilePoint p = profile_at(index, height);
  Vec3 place = p.apothem * outward + across * strip.chord(height) * sideways + Vec3{0, 0, p.z};
  const auto sagitta = [&](double h) {
    const double fullness = strip.width(h) / strip.chord(h) - 1;
    return fullness > 1e-12 ? strip.chord(h) * std::sqrt(3 * fullness / 8) : 0.0;
  };
  const double top = sagitta(strip.length()), here = sagitta(height);
  if (top <= 0 && here <= 0) return place;
  const double below = strip.length() - height;
  const double bend = 1 - 4 * across * across;
  const double slope = below > 0 ? std::clamp((here - top) / below, -steepest, steepest) : 0;
  const ProfilePoint low = profile_[index].front(), high = profile_[index].back();
  const double run = std::hypot(high.apothem - low.apothem, high.z - low.z);
  const Vec3 up = ((high.apothem - low.apothem) / run) * outward + Vec3{0, 0, (high.z - low.z) / run};
  const Vec3 out = ((high.z - low.z) / run) * outward + Vec3{0, 0, (low.apothem - high.apothem) / run};
  const double tilt = slope * bend;
  place += (top * bend + tilt * below) * out + below * (1 - std::sqrt(1 - tilt * tilt)) * up;
  return place;
}

void Builder::add_strip(int index, const std::vector<Ring>& rings) {
  const GoreStrip& strip = pattern_.strips[index];
  patches_.emplace_back();
  for (const Ring& ring : rings) {
    const int per_gore = ring.columns / pattern_.gores;
    const auto height = [&](int row) { return ring.from + (ring.to - ring.from) * row / ring.cells; };
    PatchShape shape{ring.cells + 1, ring.columns, true, [&](int row, int column) {
                       return start(index, height(row), column / per_gore,
                                    double(column % per_gore) / per_gore - 0.5);
                     }};
    shape.cut = [&](int row, int column) {
      const auto at = [&](int r, int c) {
        return Vec3{(double(c) / per_gore - 0.5) * strip.width(height(r)), height(r), 0};
      };
      const int c = column % per_gore;
      return std::array{at(row, c), at(row, c + 1), at(row + 1, c + 1), at(row + 1, c)};
    };
    std::vector<int>& patches = patches_.back();
    patches.push_back(builder_.add_patch(strip.name, shape, materials_.canopy));
    if (patches.size() > 1) builder_.tie_rows(patches[patches.size() - 2], patches.back());
  }
}

// Holds strip `index` on the one before, along the whole edge or at the radials.
void Builder::attach(int index) {
  const GoreStrip& strip = pattern_.strips[index];
  const int lower = patches_[index - 1].back(), upper = patches_[index].front();
  if (strip.joined) {
    builder_.tie_rows(lower, upper);
    return;
  }
  const Patch &below = patch(lower), &above = patch(upper);
  if (strip.slot > 0) {
    if (!design_.tape.seams && !lines_reach_vent_)
      throw Error(ExitCode::usage,
                  fmt::format("nothing spans the slot below the {}: let the lines run up to the vent (leave "
                              "out parachute.lines.onto_disk_m) or set parachute.tape.seams = true",
                              strip.name));
    return;
  }
  std::set<int> columns;  // of the coarser edge
  for (const int parts : {design_.gores, design_.lines.count})
    for (int part = 0; part < parts; ++part) columns.insert(above.columns / parts * part);
  const int ratio = below.columns / above.columns;
  for (const int column : columns)
    builder_.tie(below.node(below.rows - 1, column * ratio), {{above.node(0, column), 1.0}});
}

double Builder::slot_along(int index, int part, int parts) const {
  const double gore = double(part) * pattern_.gores / parts;
  const double across = gore - std::floor(gore) - 0.5;
  const double chord_change =
      pattern_.strips[index].stations.front().chord - pattern_.strips[index - 1].stations.back().chord;
  return std::hypot(pattern_.strips[index].slot, across * chord_change);
}

bool Builder::has_corner_below(int index) const {
  const auto direction = [](ProfilePoint a, ProfilePoint b) {
    return std::atan2(b.z - a.z, b.apothem - a.apothem);
  };
  const std::vector<ProfilePoint>& below = profile_[index - 1];
  const std::vector<ProfilePoint>& above = profile_[index];
  const double turn = direction(below[below.size() - 2], below.back()) - direction(above[0], above[1]);
  return std::abs(turn) > sharp_corner;
}

// The radial's own length: a sail that is fuller below than above has longer sides, which are eased onto it.
Path Builder::radial(int index, int part, int parts) const {
  Path path = builder_.radial(patches_[index], part, parts);
  const std::vector<Vec3>& x = builder_.mesh.start;
  for (std::size_t i = 0; i < path.lengths.size(); ++i)
    path.lengths[i] = norm(x[path.nodes[i + 1]] - x[path.nodes[i]]);
  return path;
}

// What lies along one radial from the skirt to the vent, cut into smooth runs; each begins with the node that
// ends the one before.
std::vector<Path> Builder::runs_along(int part, int parts) const {
  std::vector<Path> runs{radial(0, part, parts)};
  for (std::size_t i = 1; i < patches_.size(); ++i) {
    const int index = static_cast<int>(i);
    const Path piece = radial(index, part, parts);
    if (pattern_.strips[i].slot > 0) {
      runs.back().append({{piece.nodes.front()}, {}}, slot_along(index, part, parts));
    } else {
      runs.back().nodes.back() = piece.nodes.front();
    }
    if (has_corner_below(index)) {
      runs.push_back(piece);
    } else {
      runs.back().extend(piece);
    }
  }
  return runs;
}

void Builder::add_tapes() {
  const int law = builder_.law({materials_.tape.coefficients_n_m, materials_.tape.compression});
  const Tape& tape = materials_.tape;
  if (design_.tape.hems) {
    const int part = builder_.part("hem tape");
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      builder_.add_tape(builder_.row(patches_[i].front(), 0), tape, law, part);
      const int top = patches_[i].back();
      const bool sewn_above = i + 1 < patches_.size() && pattern_.strips[i + 1].joined;
      if (!sewn_above) builder_.add_tape(builder_.row(top, patch(top).rows - 1), tape, law, part);
    }
  }
  if (design_.tape.seams) {
    const int part = builder_.part("seam tape");
    for (int gore = 0; gore < pattern_.gores; ++gore)
      builder_.add_tape(along(gore, pattern_.gores), tape, law, part);
  }
  add_vertical_tapes(law);
}

// At the columns nearest to equal parts of the gore; the columns of all strips lie on the same rays.
void Builder::add_vertical_tapes(int law) {
  if (pattern_.vertical_tapes == 0) return;
  const int part = builder_.part("vertical tape");
  int coarsest = 1 << 30;
  for (const std::vector<int>& patches : patches_)
    coarsest = std::min(coarsest, patch(patches.back()).columns / pattern_.gores);
  std::set<int> chosen;
  for (int k = 1; k <= pattern_.vertical_tapes; ++k)
    chosen.insert(static_cast<int>(std::lround(double(k) * coarsest / (pattern_.vertical_tapes + 1))));
  for (int gore = 0; gore < pattern_.gores; ++gore) {
    for (const int column : chosen) {
      if (column == 0 || column == coarsest) continue;
      builder_.add_tape(along(gore * coarsest + column, pattern_.gores * coarsest), materials_.tape, law,
                        part);
    }
  }
}

Path Builder::along(int part, int parts) const {
  Path whole;
  for (const Path& run : runs_along(part, parts)) whole.extend(run);
  return whole;
}

void Builder::add_sewn_lines() {
  std::vector<Path> sewn;
  for (int k = 0; k < design_.lines.count; ++k) {
    double left = line_length_on_disk(design_);
    Path line;
    for (const Path& run : runs_along(k, design_.lines.count)) {
      const Path piece = sew(builder_, run, left, design_.mesh.line_segment_m);
      left -= piece.length();
      line.extend(piece);
      if (piece.nodes.back() != run.nodes.back()) break;
    }
    sewn.push_back(std::move(line));
  }
  add_lines(builder_, design_, materials_, sewn);
  if (pattern_.vent_lines && lines_reach_vent_) add_vent_lines(builder_, materials_, sewn);
}

}  // namespace

Mesh build_gored(const GorePattern& pattern, const Design& design, const PartMaterials& materials) {
  return Builder(pattern, design, materials).build();
}

}  // namespace ripstop
