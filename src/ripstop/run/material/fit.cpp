#include "ripstop/run/material/fit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "ripstop/core/build_info.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/material/library.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/plot.h"
#include "ripstop/run/material/coupon.h"

namespace ripstop::inline run {
namespace {

using Json = nlohmann::ordered_json;

const CouponComparison* coupon_of(const std::vector<CouponComparison>& coupons, const std::string& name) {
  for (const CouponComparison& c : coupons)
    if (c.name == name) return &c;
  return nullptr;
}

/// File names may hold anything; in quotes and escaped they stay on their line.
std::string in_quotes(const std::string& text) {
  return Json(text).dump(-1, ' ', true, Json::error_handler_t::replace);
}

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json to_json(const Estimate& e) {
  return {{"value", e.value},
          {"standard_error", number(e.standard_error)},
          {"low", number(e.low)},
          {"high", number(e.high)}};
}

/// Hash of version, campaign with its records, and the options.
std::string inputs_of(const Bench& bench, const MaterialFit& fit, const std::string& asked) {
  std::string text = fmt::format("{}\n{}\n{}\n{}\n{}\n", version(), asked, hash_file(bench.file),
                                 bench.degree, bench.zero_offset);
  for (const RecordOrigin& input : fit.inputs) text += input.hash + "\n";
  text += fmt::format("{}\n{}\n", bench.columns, static_cast<int>(bench.decimal));
  return hash_bytes(text);
}

Json to_json(const std::vector<CouponComparison>& coupons) {
  Json all = Json::array();
  for (const CouponComparison& one : coupons) {
    const CouponPoint& end = one.pull.points.back();
    all.push_back({{"name", one.name},
                   {"r2", one.r2},
                   {"waist", end.waist},
                   {"corner_peak", end.corner_peak},
                   {"strain", one.strain},
                   {"measured_n_per_m", one.measured},
                   {"simulated_n_per_m", one.simulated}});
  }
  return all;
}

}  // namespace

std::string interval_text(const Estimate& e, const char* unit, double confidence) {
  if (!std::isfinite(e.standard_error))
    return fmt::format("{:.6g} {} (one sample: no interval)", e.value, unit);
  if (e.standard_error == 0) return fmt::format("{:.6g} {} (not fitted)", e.value, unit);
  return fmt::format("{:.6g} {}, standard error {:.4g}, {:.0f} % interval {:.6g} to {:.6g}", e.value, unit,
                     e.standard_error, 100 * confidence, e.low, e.high);
}

const char* load_unit(const DirectionFit& direction) {
  return direction.name == "line" ? "N" : "N/m";
}

FitResult run_fit(const Bench& bench, bool with_coupons, ThreadTeam& team,
                  const std::function<void(int, double, double, double)>& report) {
  FitResult result{bench, fit_material(bench), {}};
  if (bench.kind != BenchKind::fabric || !with_coupons) return result;
  CouponFitOptions search;
  search.find_shear = !bench.shear_fraction;
  search.find_bending = !bench.bending_fraction;
  MaterialFit& fit = result.fit;
  const CouponFit& coupons = result.coupons.emplace(fit_coupons(fit, bench, search, team, report));
  fit.warnings.insert(fit.warnings.end(), coupons.warnings.begin(), coupons.warnings.end());
  Fabric fabric = coupons.fabric;
  fabric.warning = joined_warnings(fit.warnings);
  fit.material = fabric;
  return result;
}

std::filesystem::path write_fit(const std::filesystem::path& folder, const FitResult& result) {
  make_results_folder(folder, "fit");
  const std::filesystem::path file = folder / (result.bench.name + ".toml");
  write_file(file, material_toml(result));
  for (const char* name : {"result.json", "fit.json"}) write_file(folder / name, to_json(result));
  std::vector<CouponComparison> none;
  const std::vector<CouponComparison>& coupons = result.coupons ? result.coupons->coupons : none;
  write_curves(folder, result.fit, result.bench, coupons);
  for (const CouponComparison& c : coupons) write_coupon(folder, c.name, c.coupon, c.pull);
  read_material(file);
  return file;
}

std::string coupons_json(const Fabric& material, const Bench& bench, const MaterialFit& fit,
                         const std::string& asked, const std::vector<CouponComparison>& coupons) {
  return Json{{"material", material.name},
              {"inputs_hash", inputs_of(bench, fit, asked + material_to_toml(material))},
              {"coupons", to_json(coupons)}}
             .dump(2) +
         "\n";
}

void write_curves(const std::filesystem::path& folder, const MaterialFit& fit, const Bench& bench,
                  const std::vector<CouponComparison>& coupons) {
  for (const DirectionFit& d : fit.directions) {
    const bool banded = d.samples.size() > 1;
    CsvTable table{{"strain", "mean", "spread", "fit", "band_low", "band_high"}, {}};
    for (std::size_t i = 0; i < d.curve.strain.size(); ++i)
      table.rows.push_back({d.curve.strain[i], d.curve.load[i], d.curve.spread[i], d.fit.fit[i],
                            d.fit.band_low[i], d.fit.band_high[i]});
    write_csv(folder / fmt::format("curve-{}.csv", d.name), table);

    Plot plot;
    plot.title = fmt::format("{}, {}", bench.name, d.name);
    plot.x.label = "strain";
    plot.x.from = plot.y.from = 0;
    plot.y.label = load_unit(d) == std::string("N") ? "tension [N]" : "load per width [N/m]";
    for (const CleanRecord& sample : d.samples) {
      PlotSeries points{"", {}, {}, false, true, false};
      const std::size_t step = std::max<std::size_t>(1, sample.strain.size() / 40);
      for (std::size_t i = 0; i < sample.strain.size(); i += step)
        points.x.push_back(sample.strain[i]), points.y.push_back(sample.load[i]);
      points.name = sample.name;
      plot.series.push_back(points);
    }
    plot.series.push_back(
        {fmt::format("fit of degree {}", d.fit.degree), d.curve.strain, d.fit.fit, true, false, false});
    if (banded) {
      const std::string name = fmt::format("{:.0f} % confidence band of the mean", 100 * bench.confidence);
      plot.series.push_back({name, d.curve.strain, d.fit.band_low, true, false, true});
      plot.series.push_back({"", d.curve.strain, d.fit.band_high, true, false, true});
    }
    if (const CouponComparison* c = coupon_of(coupons, d.name))
      plot.series.push_back(
          {fmt::format("virtual coupon, R2 {:.4f}", c->r2), c->strain, c->simulated, true, true, false});
    write_plot(folder / fmt::format("curve-{}.png", d.name), plot);
  }
}

std::string material_toml(const FitResult& result) {
  const auto& [bench, fit, coupons] = result;
  std::string text = fmt::format("# Made by ripstop fit {} from {}.\n", version(),
                                 in_quotes(bench.file.filename().string()));
  const auto say = [&](const std::string& line) { text += "# " + line + "\n"; };
  say(fmt::format("campaign: {}", hash_file(bench.file)));
  for (const RecordOrigin& input : fit.inputs)
    say(fmt::format("record {}: {}", in_quotes(input.file), input.hash));
  for (const DirectionFit& d : fit.directions) {
    say(fmt::format("{}: {} samples, degree {}, R2 {:.4f}, tested up to strain {:.4g}, K_0 {:.4g}", d.name,
                    d.samples.size(), d.fit.degree, d.fit.r2, d.fit.tested_strain, d.fit.offset.value));
    for (std::size_t k = 0; k < d.fit.k.size(); ++k)
      say(fmt::format("{} K_{} {}", d.name, k + 1,
                      interval_text(d.fit.k[k], load_unit(d), bench.confidence)));
  }
  if (coupons) {
    if (coupons->searched)
      say(fmt::format("xi {:.4f} ({:.0f} % interval {:.4f} .. {:.4f}), eps {:.4f}, from virtual coupons",
                      coupons->fabric.shear_fraction, 100 * bench.confidence, coupons->shear_low,
                      coupons->shear_high, coupons->fabric.bending_fraction));
    say(fmt::format("coefficients multiplied by {:.5f} for the clamps", coupons->rescale));
    for (const CouponComparison& c : coupons->coupons)
      say(fmt::format("virtual {} coupon against the mean record: R2 {:.4f}", c.name, c.r2));
    for (const std::string& note : coupons->notes) say(note);
  }
  for (const std::string& note : fit.notes) say(note);
  say("breaking load: of the weakest sample; tested strain: at failure of the first sample");
  return text + material_to_toml(fit.material);
}

std::string to_json(const FitResult& result) {
  const auto& [bench, fit, coupons] = result;
  Json root;
  root["name"] = bench.name;
  root["inputs_hash"] = inputs_of(bench, fit, coupons ? "with coupons" : "without coupons");
  root["kind"] = kind_of(fit.material);
  root["ripstop"] = version();
  root["campaign"] = {{"file", bench.file.filename().string()}, {"hash", hash_file(bench.file)}};
  for (const RecordOrigin& input : fit.inputs)
    root["records"].push_back({{"file", input.file}, {"hash", input.hash}});
  for (const DirectionFit& d : fit.directions) {
    Json direction{{"name", d.name},
                   {"orientation_deg", d.orientation},
                   {"degree", d.fit.degree},
                   {"r2", d.fit.r2},
                   {"r2_all_points", d.fit.r2_all},
                   {"tested_strain", d.fit.tested_strain},
                   {"rising_until", d.fit.rising_until},
                   {"K_0", to_json(d.fit.offset)}};
    for (const Estimate& k : d.fit.k) direction["K"].push_back(to_json(k));
    for (const CleanRecord& s : d.samples)
      direction["samples"].push_back({{"file", s.name},
                                      {"failure_strain", s.failure_strain},
                                      {"failure_load", s.failure_load},
                                      {"slack_m", s.slack},
                                      {"force_offset_n", s.force_offset},
                                      {"noise", s.noise},
                                      {"trimmed", s.trimmed}});
    root["directions"].push_back(direction);
  }
  if (coupons) {
    Json c{{"xi", coupons->fabric.shear_fraction},
           {"xi_low", number(coupons->shear_low)},
           {"xi_high", number(coupons->shear_high)},
           {"eps", coupons->fabric.bending_fraction},
           {"searched", coupons->searched},
           {"rescale", coupons->rescale},
           {"effect_of_eps", coupons->bending_effect},
           {"evaluations", coupons->evaluations}};
    c["coupons"] = to_json(coupons->coupons);
    root["coupons"] = c;
  }
  if (fit.has_permeability)
    root["permeability"] = {{"a", fit.permeability.law.linear},
                            {"b", fit.permeability.law.quadratic},
                            {"r2", fit.permeability.r2},
                            {"cfm", cfm(fit.permeability.law)}};
  root["notes"] = fit.notes;
  root["warnings"] = fit.warnings;
  root["understood"] = fit.understood;
  return root.dump(2) + "\n";
}

}  // namespace ripstop::inline run
