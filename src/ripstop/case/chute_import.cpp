#include "ripstop/case/chute_import.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ripstop/case/case.h"
#include "ripstop/core/error.h"
#include "ripstop/core/toml/problem.h"
#include "ripstop/core/visible.h"
#include "ripstop/parachute/conical.h"
#include "ripstop/parachute/cross.h"
#include "ripstop/parachute/design.h"
#include "ripstop/parachute/disk_gap_band.h"
#include "ripstop/parachute/flat_circular.h"
#include "ripstop/parachute/profile.h"

namespace ripstop::inline cases {
namespace {

using std::numbers::pi;

constexpr double same = 1e-6;  // [m]

std::string list(const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(fmt::format("{:.9g}", value));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

bool is_flat(const ChuteSection& s) {
  return std::abs(s.points.front().y - s.points.back().y) < same;
}
bool is_vertical(const ChuteSection& s) {
  return std::abs(s.points.front().r - s.points.back().r) < same;
}
double inner(const ChuteSection& s) {
  return std::min(s.points.front().r, s.points.back().r);
}
double outer(const ChuteSection& s) {
  return std::max(s.points.front().r, s.points.back().r);
}
double top(const ChuteSection& s) {
  return std::max(s.points.front().y, s.points.back().y);
}
double bottom(const ChuteSection& s) {
  return std::min(s.points.front().y, s.points.back().y);
}

class Importer {
 public:
  Importer(const ChuteFile& file, const ChuteImportOptions& options, const std::string& source)
      : file_(file), options_(options), source_(source) {}

  ImportedCase run(bool as_profile = false) {
    const std::vector<ChuteSection>& s = file_.sections;
    const bool circular =
        std::all_of(s.begin(), s.end(), [](const ChuteSection& section) { return section.circular; });
    gores_ = s.front().gores;
    const bool disk_and_band =
        !as_profile && circular && s.size() == 2 && (disk_gap_band(s[0], s[1]) || disk_gap_band(s[1], s[0]));
    if (as_profile) {
      profile();
    } else if (circular && s.size() == 1 && is_vertical(s[0]) && gores_ == 2) {
      cross(s[0]);
    } else if (circular && s.size() == 1 && !is_vertical(s[0])) {
      one_disk(s[0]);
    } else if (!disk_and_band) {
      profile();
    }
    cloth();
    report_rest();
    result_.case_text = header() + text_ + tail();
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& place, const std::string& what) const {
    throw Error(ExitCode::bad_data, fmt::format("{}: {}: {}", source_, place, what));
  }
  template <class... T>
  void mapped(fmt::format_string<T...> text, T&&... values) {
    result_.mapped.push_back(fmt::format(text, std::forward<T>(values)...));
  }
  template <class... T>
  void changed(fmt::format_string<T...> text, T&&... values) {
    result_.changed.push_back(fmt::format(text, std::forward<T>(values)...));
  }
  template <class... T>
  void assumed(fmt::format_string<T...> text, T&&... values) {
    result_.assumed.push_back(fmt::format(text, std::forward<T>(values)...));
  }

  /// `diameter` of the file's own opening [m], of a canopy so wide.
  double vent(double diameter, double widest) {
    constexpr double share = chute_vent_share;
    if (options_.vent_diameter) {
      if (std::abs(*options_.vent_diameter - diameter) > same)
        changed("vent: {:.6g} m as requested; the file has {:.6g} m", *options_.vent_diameter, diameter);
      return *options_.vent_diameter;
    }
    if (diameter > same) return diameter;
    changed(
        "vent: the gores end in a point, but the mesh needs an opening: {:.6g} m, {} % of the largest "
        "diameter (--vent-diameter)",
        share * widest, 100 * share);
    return share * widest;
  }

  void cross(const ChuteSection& s) {
    Cross canopy{pi * s.points[0].r, top(s) - bottom(s)};
    if (canopy.arm_width_m > canopy.arm_length_m) fail(s.place, "the two strips are wider than long");
    gores_ = 4;
    result_.type = "cross";
    mapped(
        "{}: a cylinder of 2 gores represents the two strips of a cross in openchute: {:.6g} m long, "
        "{:.6g} m wide",
        s.place, canopy.arm_length_m, canopy.arm_width_m);
    text_ =
        fmt::format("arm_length_m = {:.9g}\narm_width_m = {:.9g}\n", canopy.arm_length_m, canopy.arm_width_m);
    canopy_ = canopy;
    lines_ = cross_line_count;
  }

  bool disk_gap_band(const ChuteSection& disk, const ChuteSection& band) {
    const double gap = disk.points[0].y - top(band);
    if (!is_flat(disk) || !is_vertical(band) || is_vertical(disk) ||
        std::abs(outer(disk) - outer(band)) > same || gap < -same)
      return false;
    gores_ = disk.gores;
    result_.type = "disk-gap-band";
    const DiskGapBand canopy{2 * outer(disk), vent(2 * inner(disk), 2 * outer(disk)), gap > same ? gap : 0.0,
                             top(band) - bottom(band)};
    mapped("{}: disk of {:.6g} m, {}: band {:.6g} m high below a gap of {:.6g} m", disk.place,
           canopy.disk_diameter_m, band.place, canopy.band_height_m, canopy.gap_height_m);
    if (band.gores != disk.gores)
      result_.not_mapped.push_back(
          fmt::format("{}.gores = {}: the band of Ripstop has the same number of seams as the disk, {}",
                      band.place, band.gores, disk.gores));
    text_ = fmt::format(
        "disk_diameter_m = {:.9g}\nvent_diameter_m = {:.9g}\ngap_height_m = {:.9g}\nband_height_m = {:.9g}\n",
        canopy.disk_diameter_m, canopy.vent_diameter_m, canopy.gap_height_m, canopy.band_height_m);
    canopy_ = canopy;
    lines_ = gores_;
    return true;
  }

  void one_disk(const ChuteSection& s) {
    need_three_gores(s);
    const double slope = std::atan2(top(s) - bottom(s), outer(s) - inner(s));
    const bool upside_down = (s.points[0].r < s.points[1].r) != (s.points[0].y > s.points[1].y);
    lines_ = gores_;
    if (is_flat(s)) {
      const FlatCircular canopy{2 * outer(s), vent(2 * inner(s), 2 * outer(s)), even()};
      result_.type = "flat-circular";
      mapped("{}: a flat disk of {:.6g} m", s.place, canopy.nominal_diameter_m);
      text_ = fmt::format("nominal_diameter_m = {:.9g}\nvent_diameter_m = {:.9g}\n",
                          canopy.nominal_diameter_m, canopy.vent_diameter_m);
      canopy_ = canopy;
    } else {
      if (upside_down) fail(s.place, "the cone widens towards the vent");
      const Conical canopy{2 * outer(s) / std::sqrt(std::cos(slope)), vent(2 * inner(s), 2 * outer(s)),
                           slope * 180 / pi, even()};
      result_.type = "conical";
      mapped("{}: a cone of {:.6g} degrees, {:.6g} m across its skirt", s.place, canopy.cone_angle_deg,
             2 * outer(s));
      text_ = fmt::format("nominal_diameter_m = {:.9g}\nvent_diameter_m = {:.9g}\ncone_angle_deg = {:.9g}\n",
                          canopy.nominal_diameter_m, canopy.vent_diameter_m, canopy.cone_angle_deg);
      canopy_ = canopy;
    }
    changed("{}: round edges become the straight ones of {} gores; the area is kept", s.place, gores_);
    text_ += vent_lines();
  }

  void need_three_gores(const ChuteSection& s) const {
    if (s.gores < 3) fail(s.place + ".gores", fmt::format("{} gores; Ripstop needs at least 3", s.gores));
  }
  int line_count() const { return options_.line_count.value_or(lines_); }
  bool even() const { return line_count() % 2 == 0; }
  std::string vent_lines() const { return even() ? "" : "vent_lines = false # of an odd number of lines\n"; }

  void profile() {
    result_.type = "profile";
    const ChuteSection* first_polygonal = nullptr;
    for (const ChuteSection& s : file_.sections)
      if (!s.circular && !first_polygonal) first_polygonal = &s;
    if (first_polygonal) gores_ = first_polygonal->gores;
    for (const ChuteSection& s : file_.sections) {
      if (s.gores == gores_) continue;
      if (!s.circular)
        fail(s.place + ".gores",
             fmt::format("{} gores, but {} has {}; the seams of all pieces must lie on the same radials",
                         s.gores, first_polygonal->place, gores_));
      changed("{}.gores = {}: cut as {} gores, like the other pieces", s.place, s.gores, gores_);
    }
    if (gores_ < 3)
      fail(file_.sections.front().place + ".gores",
           fmt::format("{} gores; Ripstop needs at least 3", gores_));
    lines_ = gores_;
    ProfileCanopy canopy;
    canopy.vent_lines = even();
    double widest = 0;
    for (const ChuteSection& s : file_.sections)
      for (const MeridianPoint& p : s.points) widest = std::max(widest, p.r);
    double lift = 0;
    MeridianPoint end;
    for (ChuteSection& s : in_order()) {
      const bool touches =
          !canopy.pieces.empty() && std::hypot(s.points.front().r - end.r, s.points.front().y - end.y) < same;
      end = s.points.back();
      if (s.circular) straighten(s, lift);
      for (MeridianPoint& p : s.points) p.y += s.circular ? 0 : lift;
      ProfilePiece piece;
      for (const MeridianPoint& p : s.points) piece.radius_m.push_back(p.r), piece.height_m.push_back(p.y);
      piece.leading_fullness = s.first_fullness, piece.trailing_fullness = s.last_fullness;
      piece.sewn =
          touches && std::abs(canopy.pieces.back().trailing_fullness - piece.leading_fullness) < 1e-9;
      if (touches)
        assumed("{}: touches the piece below it: {}", s.place,
                piece.sewn ? "sewn to it along the whole edge"
                           : "different fullness: attached at the radials only");
      canopy.pieces.push_back(std::move(piece));
      mapped("{}: piece {} of the gore, {} points, fullness {} at the lower and {} at the upper edge",
             s.place, canopy.pieces.size(), s.points.size(), s.first_fullness, s.last_fullness);
    }
    open_vent(canopy, widest);
    write_profile(canopy);
    canopy_ = canopy;
  }

  /// From the skirt to the vent: the lowest end first, then the piece that begins nearest to the end so far.
  std::vector<ChuteSection> in_order() const {
    std::vector<ChuteSection> left = file_.sections, ordered;
    const auto turned = [](ChuteSection s) {
      std::reverse(s.points.begin(), s.points.end());
      std::swap(s.first_fullness, s.last_fullness);
      return s;
    };
    while (!left.empty()) {
      std::size_t best = 0;
      bool turn = false;
      double least = 1e300;
      for (std::size_t i = 0; i < left.size(); ++i) {
        for (const bool reversed : {false, true}) {
          const MeridianPoint p = reversed ? left[i].points.back() : left[i].points.front();
          // Of two equally low ends the outer one is the skirt.
          const double distance = ordered.empty() ? p.y - 1e-9 * p.r
                                                  : std::hypot(p.r - ordered.back().points.back().r,
                                                               p.y - ordered.back().points.back().y);
          if (distance < least - 1e-12) least = distance, best = i, turn = reversed;
        }
      }
      ordered.push_back(turn ? turned(left[best]) : left[best]);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
    }
    return ordered;
  }

  /// A ring sector of slant L and arcs 2 pi r / N has the area of a trapezoid as high as L: the meridian gets
  /// so much steeper that the strip of flat gores is L long; the parts above are lifted by the difference.
  void straighten(ChuteSection& s, double& lift) {
    const double share = pi / gores_ / std::tan(pi / gores_);
    const MeridianPoint a = s.points.front(), b = s.points.back();
    const double dr = b.r - a.r, dy = b.y - a.y;
    const double height = std::sqrt(dy * dy + (1 - share * share) * dr * dr) * (dy < 0 ? -1 : 1);
    s.points = {{a.r, a.y + lift}, {b.r, a.y + lift + height}};
    lift += height - dy;
    if (std::abs(dr) > same)
      changed("{}: round edges become the straight ones of {} gores; widths and area are kept", s.place,
              gores_);
  }

  void open_vent(ProfileCanopy& canopy, double widest) {
    ProfilePiece& last = canopy.pieces.back();
    const double radius = vent(2 * last.radius_m.back(), 2 * widest) / 2;
    if (radius > last.radius_m.back() + same / 10) {
      while (last.radius_m.size() > 1 && last.radius_m[last.radius_m.size() - 2] <= radius)
        last.radius_m.pop_back(), last.height_m.pop_back();
      const std::size_t n = last.radius_m.size();
      if (n < 2) fail("chute_sections", fmt::format("no room for a vent of {:.6g} m", 2 * radius));
      const double share = (last.radius_m[n - 2] - radius) / (last.radius_m[n - 2] - last.radius_m[n - 1]);
      last.height_m[n - 1] = last.height_m[n - 2] + share * (last.height_m[n - 1] - last.height_m[n - 2]);
      last.radius_m[n - 1] = radius;
    } else if (radius < last.radius_m.back() - same) {
      fail("chute_sections", fmt::format("the cloth ends at a vent of {:.6g} m; a smaller vent of {:.6g} m "
                                         "needs more cloth than the file has",
                                         2 * last.radius_m.back(), 2 * radius));
    }
    double highest = -1e300;
    for (const ProfilePiece& piece : canopy.pieces)
      for (const double y : piece.height_m) highest = std::max(highest, y);
    if (last.height_m.back() < highest - same)
      changed(
          "the vent is {:.6g} m below the highest point, which requires a centre line that Ripstop does not "
          "support: the cloth is cut as designed, but the apex will rise",
          highest - last.height_m.back());
  }

  void write_profile(const ProfileCanopy& canopy) {
    text_ = vent_lines();
    for (const ProfilePiece& piece : canopy.pieces) {
      pieces_ += fmt::format("\n[[parachute.pieces]]\nradius_m = {}\nheight_m = {}\n", list(piece.radius_m),
                             list(piece.height_m));
      if (piece.leading_fullness > 0)
        pieces_ += fmt::format("leading_fullness = {:.9g}\n", piece.leading_fullness);
      if (piece.trailing_fullness > 0)
        pieces_ += fmt::format("trailing_fullness = {:.9g}\n", piece.trailing_fullness);
      if (piece.sewn) pieces_ += "sewn = true\n";
    }
  }

  void cloth() {
    const ChuteSection& first = file_.sections.front();
    mapped("{}.fabric: \"{}\", {:.6g} g/m2", first.place, visible_line(first.fabric),
           1000 * first.areal_density);
    for (const ChuteSection& s : file_.sections)
      if (s.fabric != first.fabric || s.areal_density != first.areal_density)
        result_.not_mapped.push_back(
            fmt::format("{}.fabric: \"{}\", {:.6g} g/m2; a canopy of Ripstop has one cloth, that of {}",
                        s.place, visible_line(s.fabric), 1000 * s.areal_density, first.place));
    assumed(
        "stiffness, strength and porosity of the cloth: values of F-111, because the file contains only the "
        "mass");
  }

  void report_rest() {
    for (const auto& [name, value] : file_.inputs)
      mapped("input {} = {:.9g}: included in the dimensions", name, value);
    if (!file_.parameters.empty())
      mapped("parameters ({}): evaluated and included in the dimensions; the formulas are not kept",
             file_.parameters.size());
    if (!file_.instructions.empty())
      mapped("instructions ({}): comments at the top of the case", file_.instructions.size());
    if (result_.type == "cross") {
      changed("2 gores: written as gores = 4, the arms of a cross");
    } else {
      mapped("{} gores", gores_);
    }
    double seam = 0, hem = 0;
    for (const ChuteSection& s : file_.sections) {
      seam = std::max({seam, s.seam_allowance[0], s.seam_allowance[2]});
      hem = std::max({hem, s.seam_allowance[1], s.seam_allowance[3]});
    }
    result_.not_mapped.push_back(
        fmt::format("seam allowances are not part of a case; the largest of the file: ripstop pattern CASE "
                    "--seam-allowance {:.6g} --hem-allowance {:.6g}",
                    seam, hem));
    result_.not_mapped.push_back("colours, and descriptions, ranges, units and defaults of the inputs");
    result_.not_mapped.insert(result_.not_mapped.end(), file_.not_mapped.begin(), file_.not_mapped.end());
    result_.changed.insert(result_.changed.end(), file_.remarks.begin(), file_.remarks.end());
  }

  std::string header() const {
    std::string text =
        fmt::format("# From {} by `ripstop import`.\n", toml_quoted(std::string(source_), 500));
    for (const std::string& step : file_.instructions) text += "# Instruction: " + visible_line(step) + "\n";
    text += fmt::format(
        "title = {}\n\n[parachute]\ntype = \"{}\"\ngores = {}\ncanopy_material = \"imported-cloth\"\n",
        toml_quoted(file_.name.empty() ? "imported" : file_.name, 100), result_.type, gores_);
    return text;
  }

  std::string tail() {
    Design design;
    design.canopy = canopy_;
    design.gores = gores_;
    const CanopyFacts size = facts(design);
    const double nominal = std::sqrt(4 / pi * size.nominal_area);
    const double length =
        options_.line_length.value_or(std::ceil(100 * std::max(nominal, 1.2 * size.skirt_radius)) / 100);
    if (!options_.line_count) assumed("{} lines: the file has none (--lines)", line_count());
    if (!options_.line_length)
      assumed("lines of {:.6g} m, about the nominal diameter (--line-length)", length);
    assumed(
        "Spectra line; no riser; tape along seams and hems where the load at the flow speed requires it "
        "(parachute.tape.material)");
    assumed("flow: air at 20 degrees, 10 m/s; mesh: 11200 nodes");
    const ChuteSection& first = file_.sections.front();
    return pieces_ +
           fmt::format("\n[parachute.lines]\ncount = {}\nlength_m = {:.9g} # {}\n", line_count(), length,
                       options_.line_length ? "as requested" : "assumed: not in the file") +
           "\n[parachute.mesh]\ncloth_nodes = 11200\n" +
           fmt::format(
               "\n[materials.imported-cloth]\nbase = \"f-111-physical\" # assumed: the file has name and "
               "mass only\n"
               "source = {}\nareal_density_kg_m2 = {:.9g}\n",
               toml_quoted("mass of \"" + first.fabric +
                               "\" in the .chute file; all other properties assumed as F-111",
                           400),
               first.areal_density) +
           "\n[flow] # assumed\nspeed_m_s = 10\ndensity_kg_m3 = 1.2\n";
  }

  const ChuteFile& file_;
  const ChuteImportOptions& options_;
  const std::string& source_;
  ImportedCase result_;
  Canopy canopy_;
  int gores_ = 0;
  int lines_ = 0;
  std::string text_;    // keys of the type
  std::string pieces_;  // tables of the type
};

/// The first thing that is wrong with the imported case, by its key; empty: nothing.
std::string first_problem(const ImportedCase& made) {
  try {
    parse_case(made.case_text, "");
    return "";
  } catch (const InputError& error) {
    const Problem& problem = error.problems().front();
    return fmt::format("{}{}{}: {}", problem.key, problem.value.empty() ? "" : " = ", problem.value,
                       problem.message);
  }
}

}  // namespace

ImportedCase import_chute(const ChuteFile& file, const ChuteImportOptions& options,
                          const std::string& source) {
  ImportedCase direct = Importer(file, options, source).run();
  const std::string problem = first_problem(direct);
  if (problem.empty()) return direct;
  if (direct.type != "profile") {
    ImportedCase general = Importer(file, options, source).run(true);
    if (first_problem(general).empty()) {
      general.changed.push_back(
          fmt::format("type = \"{}\" cannot represent this shape ({}): written as pieces of a profile",
                      direct.type, problem));
      return general;
    }
  }
  std::vector<std::string> places;
  for (const ChuteSection& section : file.sections) places.push_back(section.place);
  throw Error(ExitCode::bad_data,
              fmt::format("{}: {}: no canopy family of Ripstop has this shape. As \"{}\": {}", source,
                          fmt::join(places, ", "), direct.type, problem));
}

}  // namespace ripstop::inline cases
