#include "ripstop/parachute/gored.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "ripstop/core/error.h"
#include "ripstop/core/quantity_error.h"
#include "ripstop/parachute/ring_layout.h"
#include "ripstop/parachute/sewing.h"

namespace ripstop::inline parachute {
namespace {

using std::numbers::pi;

// A line sewn over a sharper corner than this is two runs: nodes tied between two nodes of the line lie
// on a straight segment.
constexpr double sharp_corner = 20 * pi / 180;

class Builder {
 public:
  Builder(const GorePattern& pattern, const Design& design, const PartMaterials& materials)
      : pattern_(pattern),
        design_(design),
        materials_(materials),
        profile_(start_profile(pattern)),
        lines_reach_vent_(line_length_on_disk(design) >= facts(pattern).line_run * (1 - 1e-9)) {}

  CanopyMesh build() {
    std::vector<Strip> strips;
    for (const GoreStrip& strip : pattern_.strips)
      strips.push_back(
          {strip.length(), [&](double s) { return pattern_.gores * strip.width(s); }, strip.whole});
    const RingLayout layout = lay_out_rings(strips, facts(pattern_).cloth_area, design_);
    for (std::size_t i = 0; i < strips.size(); ++i) add_strip(static_cast<int>(i), layout.strips[i]);
    for (std::size_t i = 1; i < strips.size(); ++i) attach(static_cast<int>(i));
    builder_.set_skirt(patches_.front().front());
    if (materials_.tape) add_tapes(*materials_.tape);
    add_sewn_lines();
    return builder_.finish();
  }

 private:
  void add_strip(int index, const std::vector<Ring>& rings);
  void attach(int index);
  void add_tapes(const Tape& tape);
  void add_vertical_tapes(const Tape& tape, int law);
  void add_sewn_lines();

  Vec3 start(int strip, double height, int gore, double across) const;
  ProfilePoint profile_at(int strip, double height) const;
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
  CanopyBuilder builder_;
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

// An arc of half angle A is A / sin A times as long as its chord, and its sagitta is chord/2 tan(A/2).
double sagitta_of(double chord, double fullness) {
  if (fullness <= 1e-12) return 0;
  double angle = std::sqrt(6 * fullness);  // A / sin A = 1 + A^2/6 + ...
  for (int i = 0; i < 20; ++i) {
    const double sine = std::sin(angle), ratio = angle / sine;
    angle -= (ratio - 1 - fullness) * sine / (1 - ratio * std::cos(angle));
  }
  return 0.5 * chord * std::tan(0.5 * angle);
}

// Fullness is taken up by an arc between the radials, outward. A sail keeps its height when it tilts about
// its upper edge by the slope g of the sagitta: it rises by h (1 - sqrt(1 - g^2)).
Vec3 Builder::start(int index, double height, int gore, double across) const {
  constexpr double steepest = 0.9;
  const GoreStrip& strip = pattern_.strips[index];
  const double turn = 2 * pi * (gore + 0.5) / pattern_.gores;
  const Vec3 outward{std::cos(turn), std::sin(turn), 0}, sideways{-outward.y, outward.x, 0};
  const ProfilePoint p = profile_at(index, height);
  const Vec3 middle = p.apothem * outward + Vec3{0, 0, p.z};
  const double chord = strip.chord(height), below = strip.length() - height;
  const auto wanted = [&](double h) {
    return sagitta_of(strip.chord(h), strip.width(h) / strip.chord(h) - 1);
  };
  const double top = wanted(strip.length());
  const double sagitta = top + std::clamp(wanted(height) - top, -steepest * below, steepest * below);
  if (sagitta <= 0) return middle + across * chord * sideways;

  const double half_angle = 2 * std::atan(2 * sagitta / chord), radius = 0.5 * chord / std::sin(half_angle);
  const double angle = 2 * across * half_angle;
  const double bulge = radius * (std::cos(angle) - std::cos(half_angle));
  const double slope = below > 0 ? (sagitta - top) / below * bulge / sagitta : 0;
  const ProfilePoint low = profile_[index].front(), high = profile_[index].back();
  const double run = std::hypot(high.apothem - low.apothem, high.z - low.z);
  const Vec3 up = ((high.apothem - low.apothem) / run) * outward + Vec3{0, 0, (high.z - low.z) / run};
  const Vec3 out = ((high.z - low.z) / run) * outward + Vec3{0, 0, (low.apothem - high.apothem) / run};
  return middle + radius * std::sin(angle) * sideways + bulge * out +
         below * (1 - std::sqrt(std::max(0.0, 1 - slope * slope))) * up;
}

void Builder::add_strip(int index, const std::vector<Ring>& rings) {
  const GoreStrip& strip = pattern_.strips[index];
  patches_.emplace_back();
  for (const Ring& ring : rings) {
    const int per_gore = ring.columns / pattern_.gores;
    const auto height = [&](int row) { return ring.from + ring.rise(row); };
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
    shape.grain = design_.cut;
    std::vector<int>& patches = patches_.back();
    patches.push_back(builder_.add_patch(strip.name, shape, materials_.canopy));
    if (patches.size() > 1) builder_.tie_rows(patches[patches.size() - 2], patches.back());
  }
}

// Attaches strip `index` to the previous one, along the whole edge or at the radials.
void Builder::attach(int index) {
  const GoreStrip& strip = pattern_.strips[index];
  const int lower = patches_[index - 1].back(), upper = patches_[index].front();
  if (strip.joined) {
    builder_.tie_rows(lower, upper);
    return;
  }
  const Patch &below = patch(lower), &above = patch(upper);
  if (strip.slot > 0) {
    if (!(design_.tape.seams && materials_.tape) && !lines_reach_vent_)
      throw QuantityError(
          ExitCode::usage,
          fmt::format("no line or tape crosses the slot below the {}: it needs either the default length "
                      "of lines on the canopy, which reaches the vent, or tape on the seams",
                      strip.name),
          {"length of lines on the canopy", "tape on the seams"});
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
  return slot_length(pattern_, index, gore - std::floor(gore) - 0.5);
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

// Nodes along one radial from the skirt to the vent, divided into smooth runs; each begins with the last node
// of the previous one.
std::vector<Path> Builder::runs_along(int part, int parts) const {
  std::vector<Path> runs{builder_.radial(patches_.front(), part, parts)};
  for (std::size_t i = 1; i < patches_.size(); ++i) {
    const int index = static_cast<int>(i);
    const Path piece = builder_.radial(patches_[i], part, parts);
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

void Builder::add_tapes(const Tape& tape) {
  const int law = builder_.add_tape_law(tape);
  if (design_.tape.hems) {
    const int part = builder_.part("hem tape");
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      if (has_hem_tape(design_, pattern_, i, false))
        builder_.add_tape(builder_.row(patches_[i].front(), 0), tape, law, part);
      const int top = patches_[i].back();
      if (has_hem_tape(design_, pattern_, i, true))
        builder_.add_tape(builder_.row(top, patch(top).rows - 1), tape, law, part);
    }
  }
  if (design_.tape.seams) {
    const int part = builder_.part("seam tape");
    for (int gore = 0; gore < pattern_.gores; ++gore)
      builder_.add_tape(along(gore, pattern_.gores), tape, law, part);
  }
  add_vertical_tapes(tape, law);
}

// At the columns nearest to equal parts of the gore; the columns of all strips lie on the same rays.
void Builder::add_vertical_tapes(const Tape& tape, int law) {
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
      builder_.add_tape(along(gore * coarsest + column, pattern_.gores * coarsest), tape, law, part);
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
      const Path piece = builder_.sew(run, left, design_.mesh.line_segment_m, design_.mesh.sewn_straight);
      left -= piece.length();
      line.extend(piece);
      if (piece.nodes.back() != run.nodes.back()) break;
    }
    sewn.push_back(std::move(line));
  }
  ApexLines apex{pattern_.apex_line_ratio * design_.lines.length_m, {}};
  if (apex.length > 0)
    for (int k = 0; k < design_.lines.count; ++k)
      apex.ends.push_back(runs_along(k, design_.lines.count).back().nodes.back());
  builder_.add_lines(design_, materials_, sewn, apex);
  if (pattern_.vent_lines && lines_reach_vent_) builder_.add_vent_lines(materials_, sewn);
}

}  // namespace

bool has_hem_tape(const Design& design, const GorePattern& pattern, std::size_t strip, bool upper) {
  const bool last = strip + 1 == pattern.strips.size();
  if (!design.tape.hems) return false;
  if (upper) return last || (!pattern.strips[strip + 1].joined && design.tape.inner_hems);
  return strip == 0 || pattern.strips[strip].joined || design.tape.inner_hems;
}

CanopyMesh build_gored(const GorePattern& pattern, const Design& design, const PartMaterials& materials) {
  return Builder(pattern, design, materials).build();
}

}  // namespace ripstop::inline parachute
