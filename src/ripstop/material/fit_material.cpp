#include "ripstop/material/fit_material.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "ripstop/core/error.h"
#include "ripstop/core/hash.h"
#include "ripstop/core/least_squares.h"
#include "ripstop/core/units.h"
#include "ripstop/material/copies.h"
#include "ripstop/material/strength.h"

namespace ripstop::inline material {
namespace {

// Strength per mass: cotton cloth 0.02 N/tex, the best fibre (PBO, polyethylene) below 4 N/tex.
constexpr double least_tenacity = 0.003e6, most_tenacity = 6e6;  // [N m/kg], 1e6 is 1 N/tex
constexpr double least_density = 60, most_density = 3000;        // [kg/m3] of cloth as thick as stated
constexpr double notable_difference = 0.02;                      // between warp and weft

LoadKind load_kind(BenchKind kind) {
  return kind == BenchKind::line ? LoadKind::whole : LoadKind::per_width;
}

RecordFormat format_of(const Bench& bench, const BenchCoupon& coupon) {
  return {coupon.force_column,      coupon.displacement_column,          coupon.force_unit,
          coupon.displacement_unit, table::parse_columns(bench.columns), bench.decimal};
}

/// The records of a coupon's file: all specimens in it, or the one that is named.
std::vector<TensileRecord> records_of(const Bench& bench, const BenchCoupon& coupon,
                                      const std::filesystem::path& file) {
  Coupon given;
  given.length = coupon.length_m.value_or(0);
  given.width = coupon.width_m.value_or(bench.kind == BenchKind::tape ? *bench.width_m : 0);
  given.orientation = coupon.orientation_deg.value_or(-1);
  std::vector<TensileRecord> records = read_records(file, given, format_of(bench, coupon));
  if (coupon.specimen.empty()) return records;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (coupon.specimen == records[i].specimen || coupon.specimen == std::to_string(i + 1))
      return {records[i]};
    names.push_back(fmt::format("{} ({})", i + 1, records[i].specimen));
  }
  throw Error(ExitCode::bad_data, fmt::format("{}: no specimen \"{}\"; the file has {}", file.string(),
                                              coupon.specimen, fmt::join(names, ", ")));
}

void check_angle(TensileRecord& record, const Bench& bench) {
  double& angle = record.coupon.orientation;
  if (bench.kind != BenchKind::fabric) angle = 0;
  if (angle == 0 || angle == 45 || angle == 90) return;
  const std::string file = record.file.string();
  throw Error(ExitCode::bad_data,
              angle < 0
                  ? fmt::format("{}: no orientation: write \"# orientation: 45 deg\" in it or "
                                "orientation_deg in {}",
                                file, bench.file.string())
                  : fmt::format("{}: orientation {} deg; cloth must be tested at 0, 45 or 90", file, angle));
}

void warn_of_record(const CleanRecord& record, MaterialFit& fit) {
  if (!record.breaks)
    fit.warnings.push_back(
        fmt::format("{} ends at its maximum force without a break: the strength is at least this value; "
                    "check that the record is complete",
                    record.name));
  for (const std::string& text : {record.slip, record.late})
    if (!text.empty()) fit.warnings.push_back(fmt::format("{}: {}", record.name, text));
}

std::vector<CleanRecord> clean_all(const Bench& bench, MaterialFit& fit) {
  std::vector<CleanRecord> records;
  std::set<std::pair<std::string, std::string>> taken;  // hash of the file and specimen
  std::map<std::string, std::string> names;             // of the files, by hash
  for (const BenchCoupon& coupon : bench.coupons) {
    const std::filesystem::path file = bench.file.parent_path() / coupon.file;
    const std::string hash = hash_file(file);
    for (TensileRecord& record : records_of(bench, coupon, file)) {
      check_angle(record, bench);
      if (!taken.insert({hash, record.specimen}).second)
        throw Error(ExitCode::bad_data, fmt::format("{}: {} and {} are the same record; remove one, because "
                                                    "a repeated test makes the scatter too small",
                                                    bench.file.string(), names[hash], coupon.file));
      fit.understood.insert(fit.understood.end(), record.understood.begin(), record.understood.end());
      records.push_back(clean_record(record, load_kind(bench.kind)));
      records.back().name =
          record.specimen.empty() ? coupon.file : fmt::format("{} ({})", coupon.file, record.specimen);
      warn_of_record(records.back(), fit);
    }
    if (names.emplace(hash, coupon.file).second) fit.inputs.push_back({coupon.file, hash});
  }
  return records;
}

void check_copies(const Bench& bench, const std::vector<CleanRecord>& records, MaterialFit& fit) {
  for (const auto& [first, second, own_noise] : find_copies(records)) {
    const std::string text = fmt::format("{} and {} have the same noise within {:.1f} %", records[first].name,
                                         records[second].name, 100 * own_noise);
    if (own_noise < surely_copied)
      throw Error(ExitCode::bad_data,
                  fmt::format("{}: {}: they are copies of one test with different scale, units, rows or "
                              "start; remove one, because a repeated test makes the scatter too small",
                              bench.file.string(), text));
    fit.warnings.push_back(text + ": if one is a copy of the other, the scatter is too small");
  }
}

DirectionFit direction_of(const std::string& name, const std::vector<CleanRecord>& samples,
                          const Bench& bench) {
  if (samples.size() < 2 && !bench.single_samples)
    throw Error(
        ExitCode::bad_data,
        fmt::format("{}: one sample only for {}: its scatter is unknown, so no band can be given; add "
                    "samples, or accept this with single_samples = true",
                    samples.front().name, name));
  return {name, samples.front().orientation, samples, mean_curve(samples), {}};
}

/// Welch's t test of the loads at half and at the whole of the common strain.
bool differs(const MeanCurve& warp, const MeanCurve& weft, double confidence) {
  for (double part : {0.5, 1.0}) {
    const double strain = part * std::min(warp.tested_strain, weft.tested_strain);
    const auto at = [&](const MeanCurve& curve) {
      std::vector<double> values;
      const auto i = std::min<std::size_t>(
          curve.strain.size() - 1,
          static_cast<std::size_t>(std::lower_bound(curve.strain.begin(), curve.strain.end(), strain) -
                                   curve.strain.begin()));
      for (const auto& sample : curve.samples) values.push_back(sample[i]);
      return values;
    };
    const std::vector<double> a = at(warp), b = at(weft);
    const double difference = std::abs(mean(a) - mean(b));
    if (difference < notable_difference * std::abs(mean(a))) continue;
    if (a.size() < 2 || b.size() < 2) return true;
    const double va = std::pow(standard_deviation(a), 2) / static_cast<double>(a.size());
    const double vb = std::pow(standard_deviation(b), 2) / static_cast<double>(b.size());
    const double degrees =
        (va + vb) * (va + vb) /
        (va * va / static_cast<double>(a.size() - 1) + vb * vb / static_cast<double>(b.size() - 1));
    if (difference > student_t(confidence, std::max(1, static_cast<int>(degrees))) * std::sqrt(va + vb))
      return true;
  }
  return false;
}

void gather_directions(const Bench& bench, const std::vector<CleanRecord>& records, MaterialFit& fit) {
  const auto at = [&](double angle) {
    std::vector<CleanRecord> chosen;
    std::copy_if(records.begin(), records.end(), std::back_inserter(chosen),
                 [&](const CleanRecord& r) { return r.orientation == angle; });
    return chosen;
  };
  if (bench.kind != BenchKind::fabric) {
    fit.directions.push_back(direction_of(bench.kind == BenchKind::line ? "line" : "tape", records, bench));
    return;
  }
  std::vector<CleanRecord> warp = at(0);
  const std::vector<CleanRecord> weft = at(90), bias = at(45);
  if (warp.empty())
    throw Error(
        ExitCode::bad_data,
        fmt::format("{}: no record along the warp (orientation 0), which is required", bench.file.string()));
  fit.directions.push_back(direction_of("warp", warp, bench));
  if (!weft.empty()) {
    DirectionFit other = direction_of("weft", weft, bench);
    fit.weft_differs = bench.weft == WeftChoice::separate ||
                       (bench.weft == WeftChoice::automatic &&
                        differs(fit.directions[0].curve, other.curve, bench.confidence));
    if (fit.weft_differs) {
      fit.directions.push_back(std::move(other));
      fit.notes.push_back("warp and weft differ: separate curves");
    } else {
      warp.insert(warp.end(), weft.begin(), weft.end());
      fit.directions[0] = direction_of("warp", warp, bench);
      fit.notes.push_back("warp and weft are equal within their scatter: one common curve");
    }
  }
  if (!bias.empty()) fit.directions.push_back(direction_of("bias", bias, bench));
}

void check_plausible(const Bench& bench, const MaterialFit& fit) {
  const bool fabric = bench.kind == BenchKind::fabric;
  const double per_width = bench.kind == BenchKind::tape ? *bench.width_m : 1.0;
  const double mass = fabric ? *bench.areal_density_kg_m2 : *bench.linear_density_kg_m / per_width;
  for (const DirectionFit& direction : fit.directions) {
    const double load = mean(direction.curve.failure_load);
    const double tenacity = load / mass;
    if (tenacity >= least_tenacity && tenacity <= most_tenacity) continue;
    const bool line = bench.kind == BenchKind::line;
    throw Error(ExitCode::bad_data,
                fmt::format("{}: {} fails at {:.4g} {} with {:.4g} {}: {:.3g} N/tex, but fibres have {} to "
                            "{} N/tex; check force{} and mass for a factor of 1000 (kN for N, g for kg)",
                            bench.file.string(), direction.name, load, line ? "N" : "N/m", mass,
                            line ? "kg/m" : "kg/m2", 1e-6 * tenacity, 1e-6 * least_tenacity,
                            1e-6 * most_tenacity, line ? "" : ", width"));
  }
  if (!bench.thickness_m) return;
  const double density = mass / *bench.thickness_m;
  if (density < least_density || density > most_density)
    throw Error(ExitCode::bad_data, fmt::format("{}: {:.4g} kg/m2 in {:.4g} mm is {:.4g} kg/m3, but cloth "
                                                "has {} to {}; check mass and thickness for a factor of 1000",
                                                bench.file.string(), mass, 1e3 * *bench.thickness_m, density,
                                                least_density, most_density));
}

std::string why_degree(const std::vector<MeanCurve>& curves, int degree, const FitOptions& options) {
  const double error = prediction_error(curves, degree, options);
  if (options.rule == DegreeRule::nfm || std::isnan(error))
    return fmt::format(
        "degree {}: the lowest with R2 above {}{}", degree, options.wanted_r2,
        options.rule == DegreeRule::nfm ? "" : "; with one sample per direction no prediction can be tested");
  return fmt::format(
      "degree {}: the lowest that predicts a sample from the others as well as any degree, within {:.2g} % "
      "(weighted to strains up to {:.3g})",
      degree, 100 * std::sqrt(error), options.working_strain);
}

void make_fits(const Bench& bench, MaterialFit& fit) {
  FitOptions options;
  if (bench.degree > 0) options.degree = bench.degree;
  options.rule = bench.degree_rule;
  options.wanted_r2 = bench.wanted_r2;
  options.working_strain = bench.working_strain;
  options.confidence = bench.confidence;
  options.zero_offset = bench.zero_offset;
  std::vector<MeanCurve> curves;
  for (const DirectionFit& direction : fit.directions) curves.push_back(direction.curve);
  const int degree = choose_degree(curves, options);
  if (!options.degree) fit.notes.push_back(why_degree(curves, degree, options));
  for (DirectionFit& direction : fit.directions) {
    direction.fit = fit_curve(direction.curve, degree, options);
    const CurveFit& f = direction.fit;
    if (f.rising_until < f.tested_strain)
      fit.warnings.push_back(
          fmt::format("the {} fit of degree {} has a maximum at strain {:.3g}, below the tested {:.3g}: used "
                      "up to this strain only",
                      direction.name, degree, f.rising_until, f.tested_strain));
    const double working = std::min(bench.working_strain, f.tested_strain);
    const double carried = polynomial(f.coefficients(), 1, working);
    if (std::abs(f.offset.value) > 0.02 * carried)
      fit.warnings.push_back(
          fmt::format("the {} fit has K_0 = {:.3g}, {:.1f} % of its load at strain {:.3g}, which no spring "
                      "law carries; fit with zero_offset = true",
                      direction.name, f.offset.value, 100 * std::abs(f.offset.value) / carried, working));
    if (f.k.front().value <= 0)
      throw Error(
          ExitCode::bad_data,
          fmt::format(
              "the {} fit of degree {} starts with K_1 = {:.4g}: it must be above 0; choose a lower degree",
              direction.name, degree, f.k.front().value));
  }
}

template <class Kind>
void fill_common(Kind& material, const Bench& bench, const MaterialFit& fit) {
  material.name = bench.name;
  material.source = bench.source;
  material.tested_strain = 1e9;
  for (const DirectionFit& direction : fit.directions)
    if (direction.name != "bias")
      material.tested_strain = std::min(material.tested_strain, direction.fit.rising_until);
  material.warning = joined_warnings(fit.warnings);
}

double weakest(const MaterialFit& fit) {
  double load = 1e300;
  for (const DirectionFit& direction : fit.directions)
    if (direction.name != "bias")
      load = std::min(
          load, *std::min_element(direction.curve.failure_load.begin(), direction.curve.failure_load.end()));
  return load;
}

Material make_material(const Bench& bench, const MaterialFit& fit) {
  const std::vector<double> coefficients = fit.directions.front().fit.coefficients();
  if (bench.kind == BenchKind::line) {
    Line line;
    fill_common(line, bench, fit);
    line.coefficients_n = coefficients;
    line.linear_density_kg_m = *bench.linear_density_kg_m;
    line.break_load_n = weakest(fit);
    return line;
  }
  if (bench.kind == BenchKind::tape) {
    Tape tape;
    fill_common(tape, bench, fit);
    tape.coefficients_n_m = coefficients;
    tape.width_m = *bench.width_m;
    tape.linear_density_kg_m = *bench.linear_density_kg_m;
    tape.thickness_m = *bench.thickness_m;
    tape.compression = bench.compression;
    tape.break_load_n = weakest(fit) * tape.width_m;
    return tape;
  }
  Fabric fabric;
  fill_common(fabric, bench, fit);
  fabric.coefficients_n_m = coefficients;
  if (const DirectionFit* weft = fit.direction("weft"))
    fabric.weft_coefficients_n_m = weft->fit.coefficients();
  fabric.compression = bench.compression;
  fabric.areal_density_kg_m2 = *bench.areal_density_kg_m2;
  fabric.thickness_m = *bench.thickness_m;
  fabric.break_load_n_m = weakest(fit);
  fabric.shear_fraction = bench.shear_fraction.value_or(fabric.shear_fraction);
  fabric.bending_fraction = bench.bending_fraction.value_or(fabric.bending_fraction);
  if (fit.has_permeability)
    fabric.resistance = {fit.permeability.law.linear, fit.permeability.law.quadratic, {}, {}, {}};
  return fabric;
}

}  // namespace

const DirectionFit* MaterialFit::direction(const std::string& name) const {
  for (const DirectionFit& d : directions)
    if (d.name == name) return &d;
  return nullptr;
}

MaterialFit fit_material(const Bench& bench) {
  MaterialFit fit;
  const std::vector<CleanRecord> records = clean_all(bench, fit);
  check_copies(bench, records, fit);
  gather_directions(bench, records, fit);
  check_plausible(bench, fit);
  make_fits(bench, fit);
  if (!bench.flows.empty()) {
    std::vector<FlowPoint> points;
    for (const BenchFlow& flow : bench.flows)
      points.push_back({flow.pressure_pa, flow.cfm ? *flow.cfm * cfm_per_square_foot : *flow.velocity_m_s});
    fit.permeability = fit_permeability(points);
    fit.has_permeability = true;
    fit.notes.push_back(
        "the pressure drop is that of the cloth; the \"paper\" porosity model requires calibrated "
        "coefficients (darcy_1_m2, forchheimer_1_m) instead");
    if (fit.permeability.one_point)
      fit.notes.push_back("air permeability at one pressure: b = 0 is assumed (creeping flow)");
    if (fit.permeability.on_bound)
      fit.warnings.push_back(
          "air permeability: a or b would be negative and is set to 0; check the readings");
  }
  fit.material = make_material(bench, fit);
  return fit;
}

std::string joined_warnings(const std::vector<std::string>& warnings) {
  std::string text;
  for (std::size_t i = 0; i < warnings.size(); ++i) {
    const std::string more = fmt::format("; and {} more warnings of the fit", warnings.size() - i);
    if (text.size() + 2 + warnings[i].size() + more.size() > most_warning_text) {
      std::size_t cut = text.empty() ? most_warning_text / 2 : 0;
      while (cut > 0 && (static_cast<unsigned char>(warnings[i][cut]) & 0xc0) == 0x80)
        --cut;  // whole characters
      return text + warnings[i].substr(0, cut) + more;
    }
    text += (text.empty() ? "" : "; ") + warnings[i];
  }
  return text;
}

std::vector<std::string> material_warnings(const Material& material, double largest_strain) {
  return std::visit(
      [&](const auto& m) {
        std::vector<std::string> list;
        if (!m.warning.empty()) list.push_back(fmt::format("{}: {}", m.name, m.warning));
        if (m.tested_strain > 0 && largest_strain > m.tested_strain)
          list.push_back(
              fmt::format("{}: the largest strain of a spring, {:.3g}, exceeds the tested strain of {:.3g}; "
                          "the law is extrapolated",
                          m.name, largest_strain, m.tested_strain));
        if (const std::optional<double> specific = specific_strength(m);
            specific && *specific > strongest_fibre)
          list.push_back(
              fmt::format("{}: its strength ({}) is {:.3g} N/tex of the mass that carries it; the "
                          "strongest fibre has {:.3g} N/tex: check the units of break load and mass, or "
                          "give a break load",
                          m.name, strength_of(m).from, *specific / 1e6, strongest_fibre / 1e6));
        return list;
      },
      material);
}

}  // namespace ripstop::inline material
