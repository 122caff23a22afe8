// The files of a fit have its numbers: the material with where it comes from, every direction's curve, result.json.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ripstop/core/build_info.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/core/thread_team.h"
#include "ripstop/material/library.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/material/fit.h"

namespace ripstop {
namespace {

struct FitFiles : testing::Test {
  const std::filesystem::path campaign =
      std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/fit-ripstop/bench.toml";
  TemporaryFolder root{"fit-files"};
  ThreadTeam team{1};
  FitResult result = run_fit(read_bench(campaign), false, team);
};

TEST_F(FitFiles, TheMaterialHasItsProvenanceAndReadsBack) {
  const std::filesystem::path folder = root.path / "a/new/folder";
  const std::filesystem::path file = write_fit(folder, result);
  EXPECT_EQ(file, folder / "synthetic-ripstop.toml");
  const Fabric read = std::get<Fabric>(read_material(file)), &made = std::get<Fabric>(result.fit.material);
  EXPECT_EQ(read.coefficients_n_m, made.coefficients_n_m);
  EXPECT_EQ(read.weft_coefficients_n_m, made.weft_coefficients_n_m);
  EXPECT_EQ(read.break_load_n_m, made.break_load_n_m);

  const std::string text = read_file(file);
  const auto has = [&](const std::string& line) {
    EXPECT_NE(text.find("# " + line + "\n"), std::string::npos) << line << "\n" << text.substr(0, 3000);
  };
  has("campaign: " + hash_file(campaign));
  has("record \"records/weft-3.csv\": " + hash_file(campaign.parent_path() / "records/weft-3.csv"));
  for (const DirectionFit& d : result.fit.directions) {
    has(fmt::format("{}: {} samples, degree 2, R2 {:.4f}, tested up to strain {:.4g}, K_0 0", d.name,
                    d.name == "warp" ? 10 : 5, d.fit.r2, d.curve.tested_strain));  // the weft is like it
    for (std::size_t k = 0; k < 2; ++k)
      has(d.name + " K_" + std::to_string(k + 1) + " " +
          interval_text(d.fit.k.at(k), load_unit(d), result.bench.confidence));
  }
  for (const std::string& note : result.fit.notes) has(note);
  EXPECT_EQ(text.find("virtual"), std::string::npos);  // no coupon was pulled
  for (const char* name : {"result.json", "fit.json"})
    EXPECT_EQ(read_file(folder / name), to_json(result)) << name;
}

TEST_F(FitFiles, ACurvesTableHasMeanSpreadFitAndBandAtEveryStrain) {
  write_curves(root.path, result.fit, result.bench, {});
  ASSERT_GE(result.fit.directions.size(), 2u);
  for (const DirectionFit& d : result.fit.directions) {
    const CsvTable table = read_csv(root.path / ("curve-" + d.name + ".csv"));
    ASSERT_EQ(table.rows.size(), d.curve.strain.size());
    EXPECT_EQ(table.column("strain"), d.curve.strain);
    EXPECT_EQ(table.column("mean"), d.curve.load);
    EXPECT_EQ(table.column("spread"), d.curve.spread);
    EXPECT_EQ(table.column("fit"), d.fit.fit);
    EXPECT_EQ(table.column("band_low"), d.fit.band_low);
    EXPECT_EQ(table.column("band_high"), d.fit.band_high);
    EXPECT_TRUE(std::filesystem::exists(root.path / ("curve-" + d.name + ".png")));
    const std::size_t end = d.fit.fit.size() - 1;
    EXPECT_LT(d.fit.band_low[end], d.fit.fit[end]);
    EXPECT_GT(d.fit.band_high[end], d.fit.fit[end]);
  }
}

TEST_F(FitFiles, ResultJsonHasTheCampaignItsDirectionsAndTheAir) {
  const auto json = nlohmann::json::parse(to_json(result));
  EXPECT_EQ(json.at("name"), "synthetic-ripstop");
  EXPECT_EQ(json.at("ripstop"), version());
  EXPECT_EQ(json.at("kind"), "fabric");
  EXPECT_EQ(json.at("campaign").at("file"), "bench.toml");
  EXPECT_EQ(json.at("campaign").at("hash"), hash_file(campaign));
  EXPECT_FALSE(json.contains("coupons"));
  ASSERT_EQ(json.at("records").size(), result.fit.inputs.size());
  EXPECT_EQ(json["records"][0]["file"], result.fit.inputs[0].file);
  EXPECT_EQ(json["records"][0]["hash"], result.fit.inputs[0].hash);
  ASSERT_EQ(json.at("directions").size(), result.fit.directions.size());
  for (std::size_t i = 0; i < result.fit.directions.size(); ++i) {
    const DirectionFit& d = result.fit.directions[i];
    const auto& j = json["directions"][i];
    EXPECT_EQ(j["name"], d.name);
    EXPECT_EQ(j["orientation_deg"], d.orientation);
    EXPECT_EQ(j["degree"], 2);
    EXPECT_EQ(j["r2"], d.fit.r2);
    EXPECT_EQ(j["r2_all_points"], d.fit.r2_all);
    EXPECT_EQ(j["tested_strain"], d.fit.tested_strain);
    EXPECT_EQ(j["rising_until"], d.fit.rising_until);
    ASSERT_EQ(j["K"].size(), 2u);
    EXPECT_EQ(j["K"][1]["value"], d.fit.k[1].value);
    EXPECT_EQ(j["K"][1]["standard_error"], d.fit.k[1].standard_error);
    EXPECT_EQ(j["K"][1]["low"], d.fit.k[1].low);
    EXPECT_EQ(j["K"][1]["high"], d.fit.k[1].high);
    ASSERT_EQ(j["samples"].size(), d.samples.size());
    EXPECT_EQ(j["samples"][2]["file"], d.samples[2].name);
    EXPECT_EQ(j["samples"][2]["failure_strain"], d.samples[2].failure_strain);
    EXPECT_EQ(j["samples"][2]["failure_load"], d.samples[2].failure_load);
    EXPECT_EQ(j["samples"][2]["slack_m"], d.samples[2].slack);
    EXPECT_EQ(j["samples"][2]["force_offset_n"], d.samples[2].force_offset);
    EXPECT_EQ(j["samples"][2]["noise"], d.samples[2].noise);
  }
  EXPECT_EQ(json.at("permeability").at("a"), result.fit.permeability.law.linear);
  EXPECT_NEAR(json["permeability"]["cfm"].get<double>(), 3, 0.05);  // as the tester read it
  EXPECT_EQ(json.at("notes"), result.fit.notes);
  EXPECT_EQ(json.at("warnings"), result.fit.warnings);
}

TEST(FitText, AnIntervalIsPrintedWhereThereIsOne) {
  EXPECT_EQ(interval_text({1234.5678, 12.34, 1200, 1269.1356}, "N/m", 0.95),
            "1234.57 N/m, standard error 12.34, 95 % interval 1200 to 1269.14");
  EXPECT_EQ(interval_text({0, 0, 0, 0}, "N", 0.95), "0 N (not fitted)");
  const double none = std::nan("");
  EXPECT_EQ(interval_text({2.5, none, none, none}, "N/m", 0.95), "2.5 N/m (one sample: no interval)");
  DirectionFit direction;
  direction.name = "line";
  EXPECT_EQ(load_unit(direction), std::string("N"));
  direction.name = "tape";
  EXPECT_EQ(load_unit(direction), std::string("N/m"));
}

}  // namespace
}  // namespace ripstop
