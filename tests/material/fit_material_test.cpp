#include "ripstop/material/fit_material.h"

#include <gtest/gtest.h>

#include <random>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/toml/problem.h"
#include "ripstop/material/spring_law.h"
#include "synthetic.h"

namespace ripstop {
namespace {

const std::string fabric_head =
    "kind = \"fabric\"\nname = \"c\"\nsource = \"synthetic\"\nareal_density_kg_m2 = 0.0407\nthickness_m = "
    "7.6e-5\n";

struct BenchFile : ::testing::Test {
  TemporaryFolder folder{"bench"};
  std::mt19937 random{29};

  void record(const std::string& name, const SyntheticRecord& wanted) {
    write_file(folder.path / name, synthetic_csv(wanted, random));
  }
  Bench bench(const std::string& toml) {
    write_file(folder.path / "bench.toml", toml);
    return read_bench(folder.path / "bench.toml");
  }
  std::string coupons(const std::string& stem, int count, const SyntheticRecord& wanted) {
    std::string toml;
    for (int i = 0; i < count; ++i) {
      const std::string name = fmt::format("{}-{}.csv", stem, i);
      record(name, wanted);
      toml += fmt::format("[[coupon]]\nfile = \"{}\"\n", name);
    }
    return toml;
  }
};

// Aramid breaks at 2.5 %: with degree 6 K_6 is some 1e10 times K_1. A material that fit writes is read again.
TEST_F(BenchFile, AStiffMaterialIsReadAsItIsWritten) {
  SyntheticRecord aramid;
  aramid.width = 0;
  aramid.length = 0.5;
  aramid.load = [](double e) { return 9e5 * e + 6e6 * e * e; };
  aramid.failure_strain = 0.025;
  aramid.slack = 2e-4;
  const std::string head =
      "kind = \"line\"\nname = \"cord\"\nsource = \"synthetic\"\nlinear_density_kg_m = 0.015\n";
  const std::string records = coupons("a", 4, aramid);
  double largest = 0;
  for (const int degree : {2, 4, 6, 8}) {
    const Material made = fit_material(bench(head + fmt::format("degree = {}\n", degree) + records)).material;
    const std::vector<double>& k = std::get<Line>(made).coefficients_n;
    largest = std::max(largest, *std::max_element(k.begin(), k.end()));
    write_file(folder.path / "cord.toml", material_to_toml(made));
    EXPECT_EQ(std::get<Line>(read_material(folder.path / "cord.toml")).coefficients_n, k) << degree;
  }
  EXPECT_GT(largest, 1e9);  // more than the range of a coefficient alone would allow
}

TEST_F(BenchFile, ManyWarningsFitIntoTheMaterial) {
  const std::vector<std::string> warnings(
      40, "a warning of some eighty characters, as they are in a fit of many records of cloth");
  const std::string joined = joined_warnings(warnings);
  EXPECT_LE(joined.size(), most_warning_text);
  EXPECT_TRUE(joined.ends_with("more warnings of the fit")) << joined;
  EXPECT_EQ(joined_warnings({"a", "b"}), "a; b");
}

TEST_F(BenchFile, ATapeHasTheWidthOfTheCampaign) {
  SyntheticRecord tape;
  tape.width = 0;  // the records do not say it
  tape.load = [](double e) { return 20e3 * e; };
  tape.failure_strain = 0.1;
  const std::string head =
      "kind = \"tape\"\nname = \"t\"\nsource = \"synthetic\"\nlinear_density_kg_m = 0.01\nthickness_m = "
      "1e-3\n"
      "width_m = 0.025\n";
  const Tape made =
      std::get<Tape>(fit_material(bench(head + "degree = 1\n" + coupons("t", 3, tape))).material);
  EXPECT_NEAR(made.coefficients_n_m.at(0), 20e3 / 0.025, 0.1 * 20e3 / 0.025);
  EXPECT_NEAR(made.break_load_n, 2000, 400);
}

TEST_F(BenchFile, SpecimensOfOneFileAreSamples) {
  SyntheticRecord line;
  line.width = 0;
  line.load = [](double e) { return 20e3 * e; };
  line.failure_strain = 0.1;
  const std::string head =
      "kind = \"line\"\nname = \"cord\"\nsource = \"synthetic\"\nlinear_density_kg_m = 2e-3\n";
  std::string all;
  for (int i = 0; i < 3; ++i) all += fmt::format("Specimen {}\n", i + 1) + synthetic_csv(line, random);
  write_file(folder.path / "all.csv", all);
  const MaterialFit whole = fit_material(bench(head + "[[coupon]]\nfile = \"all.csv\"\n"));
  ASSERT_EQ(whole.directions.at(0).samples.size(), 3u);
  EXPECT_EQ(whole.directions[0].samples[1].name, "all.csv (Specimen 2)");
  EXPECT_EQ(whole.inputs.size(), 1u);
  EXPECT_EQ(whole.understood.size(), 6u);
  const std::string one = "[[coupon]]\nfile = \"all.csv\"\nspecimen = \"{}\"\n";
  const auto with = [&](const char* a, const char* b) {
    return fit_material(bench(head + fmt::format(fmt::runtime(one), a) + fmt::format(fmt::runtime(one), b)));
  };
  EXPECT_EQ(with("1", "Specimen 3").directions[0].samples.size(), 2u);
  EXPECT_THROW(with("1", "1"), Error);
  EXPECT_THROW(with("1", "4"), Error);
}

TEST_F(BenchFile, OneRecordCountsOnce) {
  SyntheticRecord line;
  line.width = 0;
  line.load = [](double e) { return 20e3 * e; };
  line.failure_strain = 0.1;
  const std::string head =
      "kind = \"line\"\nname = \"cord\"\nsource = \"synthetic\"\nlinear_density_kg_m = 2e-3\n";
  const std::string two = coupons("a", 2, line);
  fit_material(bench(head + two));
  write_file(folder.path / "copy.csv", read_file(folder.path / "a-0.csv"));
  for (const char* again : {"a-0.csv", "copy.csv"}) {
    try {
      fit_material(bench(head + two + "[[coupon]]\nfile = \"" + again + "\"\n"));
      ADD_FAILURE() << again;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data);
      EXPECT_NE(std::string(error.what()).find("are the same record"), std::string::npos) << error.what();
    }
  }
}

TEST_F(BenchFile, ACopyIsRefusedHoweverItIsWritten) {
  SyntheticRecord cloth;
  cloth.load = [](double e) { return 30006 * e - 18936 * e * e; };
  const std::string head = fabric_head + coupons("a", 3, cloth);
  EXPECT_TRUE(fit_material(bench(head)).warnings.empty());
  const TensileRecord whole = read_record(folder.path / "a-1.csv");
  std::string copy = "# length: 200 mm\n# width: 50 mm\n# orientation: 0 deg\nforce [lbf];extension [in]\n";
  for (std::size_t i = 3; i < whole.force.size(); i += 2)
    copy += fmt::format("{:.4f};{:.5f}\n", 1.04 * whole.force[i] / 4.4482216, whole.displacement[i] / 0.0254);
  write_file(folder.path / "new.csv", copy);
  try {
    fit_material(bench(head + "[[coupon]]\nfile = \"new.csv\"\n"));
    ADD_FAILURE() << "a copy was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    EXPECT_NE(std::string(error.what()).find("a-1.csv and new.csv have the same noise"), std::string::npos)
        << error.what();
  }
}

TEST_F(BenchFile, NoiseSharedInPartIsDoubtedAndKept) {
  SyntheticRecord cloth;
  cloth.load = [](double e) { return 30006 * e - 18936 * e * e; };
  const std::string head = fabric_head + coupons("a", 2, cloth);
  const TensileRecord whole = read_record(folder.path / "a-0.csv");
  const double peak = *std::max_element(whole.force.begin(), whole.force.end());
  std::normal_distribution<double> normal;
  std::string copy = "# length: 200 mm\n# width: 50 mm\n# orientation: 0 deg\nforce [N],extension [m]\n";
  for (std::size_t i = 0; i < whole.force.size(); ++i)
    copy += fmt::format("{:.6f},{:.8f}\n", whole.force[i] + 2.5e-4 * peak * normal(random),
                        whole.displacement[i]);
  write_file(folder.path / "new.csv", copy);
  const MaterialFit fit = fit_material(bench(head + "[[coupon]]\nfile = \"new.csv\"\n"));
  ASSERT_EQ(fit.warnings.size(), 1u);
  EXPECT_NE(fit.warnings[0].find("a-0.csv and new.csv have the same noise"), std::string::npos)
      << fit.warnings[0];
  EXPECT_NE(material_warnings(fit.material, 0).at(0).find("if one is a copy"), std::string::npos);
}

TEST_F(BenchFile, AGripThatSlipsWarnsForEver) {
  SyntheticRecord cloth;
  cloth.load = [](double e) { return 30006 * e - 18936 * e * e; };
  const std::string head = fabric_head + coupons("a", 3, cloth);
  // At 12 % strain the force falls by a third; from there it rises as before.
  const TensileRecord whole = read_record(folder.path / "a-1.csv");
  std::string slipped = "# length: 200 mm\n# width: 50 mm\n# orientation: 0 deg\nforce [N],extension [m]\n";
  for (std::size_t i = 0; i < whole.force.size(); ++i)
    slipped += fmt::format("{:.6f},{:.8f}\n", whole.force[i] - (whole.displacement[i] > 0.026 ? 55 : 0),
                           whole.displacement[i]);
  write_file(folder.path / "a-1.csv", slipped);
  const MaterialFit fit = fit_material(bench(head));
  EXPECT_GT(fit.directions.front().fit.r2, 0.95);
  ASSERT_EQ(fit.warnings.size(), 1u);
  EXPECT_TRUE(fit.warnings[0].starts_with("a-1.csv: the force falls from")) << fit.warnings[0];
  EXPECT_NE(fit.warnings[0].find("check for slip of a grip"), std::string::npos) << fit.warnings[0];
  EXPECT_NE(material_warnings(fit.material, 0).at(0).find("check for slip of a grip"), std::string::npos);
}

// A cubic law with K_1 = 52,000 N/m, with slack of 30 % of the pull in every sample, and in every third. The rule of [NFM]
// takes a straight line, which loses a third of K_1 with R2 above 0.95: its interval says so.
TEST_F(BenchFile, ACubicLawWithSlackKeepsItsStiffness) {
  SyntheticRecord cloth;
  cloth.load = [](double e) { return 52e3 * e - 150e3 * e * e + 275e3 * e * e * e; };
  cloth.failure_strain = 0.3;
  cloth.noise = 1e-3;
  for (const double usual : {0.018, 0.0}) {
    std::string records;
    for (int i = 0; i < 6; ++i) {
      cloth.slack = i % 3 == 0 ? 0.018 : usual;
      records += coupons(fmt::format("cubic-{}-{}", usual, i), 1, cloth);
    }
    const MaterialFit fit = fit_material(bench(fabric_head + records));
    const CurveFit& curve = fit.directions.front().fit;
    EXPECT_EQ(curve.degree, 3);
    EXPECT_NEAR(curve.k[0].value, 52e3, 2e3);
    EXPECT_LT(curve.k[0].low, 52e3);
    EXPECT_GT(curve.k[0].high, 52e3);
    EXPECT_LT(curve.k[0].high - curve.k[0].low, 0.2 * 52e3);
    const std::vector<double>& strain = fit.directions.front().curve.strain;
    for (std::size_t i = 0; strain[i] < 0.05; ++i) {
      EXPECT_LT(curve.band_low[i], cloth.load(strain[i])) << strain[i];
      EXPECT_GT(curve.band_high[i], cloth.load(strain[i])) << strain[i];
    }
    const MaterialFit paper = fit_material(bench("degree_rule = \"nfm\"\n" + fabric_head + records));
    const CurveFit& line = paper.directions.front().fit;
    EXPECT_EQ(line.degree, 1);
    EXPECT_GT(line.r2, 0.95);
    EXPECT_LT(line.k[0].value, 0.7 * 52e3);
    EXPECT_GT(line.k[0].high, 0.97 * 52e3);
    EXPECT_NE(paper.notes.front().find("degree 1: the lowest with R2 above 0.95"), std::string::npos);
  }
}

TEST_F(BenchFile, ALoadWithoutStrainIsMeasuredByTheWorkingStrain) {
  SyntheticRecord bent;
  bent.load = [](double e) { return 5e3 * e + 80e3 * e * e; };
  const std::string records = coupons("a", 3, bent);
  const MaterialFit fit = fit_material(bench("degree = 1\nzero_offset = false\n" + fabric_head + records));
  ASSERT_FALSE(fit.warnings.empty());
  EXPECT_NE(fit.warnings[0].find("of its load at strain 0.05"), std::string::npos) << fit.warnings[0];
  EXPECT_EQ(fit_material(bench("degree = 1\n" + fabric_head + records)).directions.front().fit.offset.value,
            0);
}

// Of cloth that stiffens, a straight line is as stiff as the strains that it is to be right at.
TEST_F(BenchFile, AFitIsThatOfTheStrainsUpToTheWorkingStrain) {
  SyntheticRecord bent;
  bent.load = [](double e) { return 5e3 * e + 80e3 * e * e; };
  const std::string records = coupons("a", 3, bent);
  const auto stiffness = [&](const char* working) {
    return fit_material(bench(working + fabric_head + "degree = 1\n" + records)).directions[0].fit.k[0].value;
  };
  const double low = stiffness("working_strain = 0.01\n"), usual = stiffness(""),
               high = stiffness("working_strain = 0.3\n");
  EXPECT_LT(low, 0.96 * usual);
  EXPECT_GT(high, 1.2 * usual);
  EXPECT_EQ(stiffness("working_strain = 0.05\n"), usual);
}

TEST_F(BenchFile, ALineComesBackInNewtons) {
  SyntheticRecord line;
  line.width = 0;
  line.length = 0.5;
  line.load = [](double e) { return 211895 * e + 489633 * e * e; };  // [NFM] Table 3
  line.failure_strain = 0.035;
  line.slack = 0.001;
  const std::string records = coupons("line", 5, line);
  const MaterialFit fit =
      fit_material(bench("kind = \"line\"\nname = \"cord\"\nsource = \"synthetic\"\n"
                         "linear_density_kg_m = 2.0e-3\ndegree = 2\nzero_offset = true\n" +
                         records));
  const Line cord = std::get<Line>(fit.material);
  const CurveFit& curve = fit.directions.front().fit;
  EXPECT_LT(curve.k[0].low, 211895);
  EXPECT_GT(curve.k[0].high, 211895);
  EXPECT_NEAR(SpringLaw({cord.coefficients_n, 1}).tension(0.03), line.load(0.03), 0.05 * line.load(0.03));
  EXPECT_EQ(cord.compression, 0);  // goes slack
  EXPECT_EQ(cord.linear_density_kg_m, 2.0e-3);
  EXPECT_NEAR(cord.break_load_n, line.load(0.035), 0.2 * line.load(0.035));
  EXPECT_NEAR(cord.tested_strain, 0.035, 0.005);
}

TEST_F(BenchFile, ATapeComesBackPerWidth) {
  SyntheticRecord tape;
  tape.width = 0.02;
  tape.load = [](double e) { return 3064.2 * e + 68823.4 * e * e; };  // [NFM] Table 3
  tape.failure_strain = 0.6;
  const std::string records = coupons("tape", 4, tape);
  const MaterialFit fit =
      fit_material(bench("kind = \"tape\"\nname = \"seam\"\nsource = \"synthetic\"\n"
                         "linear_density_kg_m = 6.0e-3\nwidth_m = 0.02\nthickness_m = 5e-4\n"
                         "degree = 2\ncompression = 0.25\n" +
                         records));
  const Tape seam = std::get<Tape>(fit.material);
  EXPECT_NEAR(SpringLaw({seam.coefficients_n_m, 1}).tension(0.4), tape.load(0.4), 0.06 * tape.load(0.4));
  EXPECT_EQ(seam.width_m, 0.02);
  EXPECT_EQ(seam.compression, 0.25);
  EXPECT_NEAR(seam.break_load_n, 0.02 * tape.load(0.6), 0.1 * 0.02 * tape.load(0.6));
}

TEST_F(BenchFile, AWeftOfItsOwnIsFoundAndALikeOneIsNot) {
  SyntheticRecord warp, weft;
  warp.load = [](double e) { return 30006 * e - 18936 * e * e; };
  weft = warp;
  weft.orientation = 90;
  const std::string head =
      "kind = \"fabric\"\nname = \"c\"\nsource = \"synthetic\"\nareal_density_kg_m2 = 0.0407\n"
      "thickness_m = 7.6e-5\n";
  const std::string first = coupons("warp", 4, warp);
  EXPECT_FALSE(fit_material(bench(head + first + coupons("like", 4, weft))).weft_differs);
  weft.load = [](double e) { return 20000 * e; };
  const MaterialFit fit = fit_material(bench(head + first + coupons("other", 4, weft)));
  EXPECT_TRUE(fit.weft_differs);
  EXPECT_NEAR(SpringLaw({std::get<Fabric>(fit.material).weft_coefficients_n_m, 1}).tension(0.2), 4000, 200);
}

TEST_F(BenchFile, AFitThatTurnsOverIsUsedUpToThereAndWarnsForEver) {
  SyntheticRecord flat;
  flat.load = [](double e) { return e < 0.1 ? 60000 * e : 6000 + 200 * (e - 0.1); };
  flat.noise = 1e-3;
  const MaterialFit fit = fit_material(
      bench("kind = \"fabric\"\nname = \"c\"\nsource = \"synthetic\"\nareal_density_kg_m2 = 0.0407\n"
            "thickness_m = 7.6e-5\ndegree = 2\nzero_offset = true\n" +
            coupons("flat", 3, flat)));
  const Fabric cloth = std::get<Fabric>(fit.material);
  EXPECT_LT(cloth.tested_strain, fit.directions.front().fit.tested_strain);
  ASSERT_FALSE(material_warnings(cloth, 0).empty());
  EXPECT_NE(material_warnings(cloth, 0).front().find("has a maximum at strain"), std::string::npos);
}

TEST_F(BenchFile, FlowReadingsGiveTheClothItsPressureDrop) {
  SyntheticRecord warp;
  warp.load = [](double e) { return 30000 * e; };
  const MaterialFit fit = fit_material(
      bench("kind = \"fabric\"\nname = \"c\"\nsource = \"synthetic\"\nareal_density_kg_m2 = 0.0407\n"
            "thickness_m = 7.6e-5\n" +
            coupons("warp", 3, warp) +
            "[[flow]]\npressure_pa = 100\nvelocity_m_s = 0.2\n[[flow]]\npressure_pa = 240\n"
            "velocity_m_s = 0.4\n[[flow]]\npressure_pa = 420\nvelocity_m_s = 0.6\n"));
  EXPECT_NEAR(as_sheet(std::get<Fabric>(fit.material).resistance).linear, 400, 1e-6);
  EXPECT_NEAR(as_sheet(std::get<Fabric>(fit.material).resistance).quadratic, 500, 1e-6);
  EXPECT_NEAR(fit.permeability.r2, 1, 1e-9);
  const auto notes = [](const MaterialFit& of, const std::string& words) {
    return std::count_if(of.notes.begin(), of.notes.end(),
                         [&](const std::string& note) { return note.find(words) != std::string::npos; });
  };
  EXPECT_EQ(notes(fit, "the pressure drop is that of the cloth"), 1);
  EXPECT_EQ(notes(fit, "air permeability at one pressure: b = 0 is assumed"), 0);
  EXPECT_TRUE(fit.has_permeability);
  const std::string head =
      "kind = \"fabric\"\nname = \"c\"\nsource = \"synthetic\"\nareal_density_kg_m2 = 0.0407\n"
      "thickness_m = 7.6e-5\n" +
      coupons("one", 3, warp);
  const MaterialFit one = fit_material(bench(head + "[[flow]]\npressure_pa = 100\nvelocity_m_s = 0.25\n"));
  EXPECT_NEAR(as_sheet(std::get<Fabric>(one.material).resistance).linear, 400, 1e-6);
  EXPECT_EQ(as_sheet(std::get<Fabric>(one.material).resistance).quadratic, 0);
  EXPECT_EQ(notes(one, "air permeability at one pressure: b = 0 is assumed"), 1);
  const MaterialFit bent = fit_material(bench(head + "[[flow]]\npressure_pa = 100\nvelocity_m_s = 0.2\n"
                                                     "[[flow]]\npressure_pa = 150\nvelocity_m_s = 0.4\n"));
  EXPECT_EQ(as_sheet(std::get<Fabric>(bent.material).resistance).quadratic, 0);
  const auto held = [](const MaterialFit& of) {
    return std::count_if(of.warnings.begin(), of.warnings.end(), [](const std::string& warning) {
      return warning.find("air permeability: a or b would be negative") != std::string::npos;
    });
  };
  EXPECT_EQ(held(bent), 1);
  EXPECT_EQ(held(fit), 0);
  const auto told = std::get<Fabric>(
      fit_material(bench("shear_fraction = 0.3\nbending_fraction = 0.02\n" + head)).material);
  EXPECT_EQ(told.shear_fraction, 0.3);
  EXPECT_EQ(told.bending_fraction, 0.02);
  try {
    bench("kind = \"line\"\nname = \"c\"\nsource = \"synthetic\"\nlinear_density_kg_m = 2e-3\n");
    ADD_FAILURE() << "a bench without a record was accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("write a [[coupon]]"), std::string::npos) << error.what();
  }
  const MaterialFit none = fit_material(bench(head));
  EXPECT_FALSE(none.has_permeability);
  EXPECT_EQ(notes(none, "pressure drop"), 0);
}

// Zero-porosity cloth lets through 0 to 3 cubic feet a minute.
TEST_F(BenchFile, AFlowBelowOneCubicFootIsOne) {
  const Bench read = bench(
      "kind = \"fabric\"\nname = \"c\"\nsource = \"synthetic\"\nareal_density_kg_m2 = 0.0407\n"
      "thickness_m = 7.6e-5\n[[coupon]]\nfile = \"a.csv\"\n[[flow]]\npressure_pa = 0.5\ncfm = 0.4\n"
      "[[flow]]\npressure_pa = 124.5\nvelocity_m_s = 0.002\n");
  ASSERT_EQ(read.flows.size(), 2u);
  EXPECT_EQ(read.flows[0].cfm, 0.4);
  EXPECT_EQ(read.flows[1].velocity_m_s, 0.002);
}

TEST_F(BenchFile, OneThatIsNoTomlIsRefusedWithItsLine) {
  try {
    bench("kind = \"fabric\"\nname = [\n");
    FAIL() << "was read";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("bench.toml:"), std::string::npos) << error.what();
  }
}

TEST_F(BenchFile, EveryMistakeInACampaignIsToldAtOnce) {
  try {
    bench(
        "kind = \"fabric\"\nname = \"c\"\nthicknes_m = 1e-4\n[[coupon]]\nfile = \"a.csv\"\norientation_deg = "
        "30\n"
        "[[flow]]\npressure_pa = 100\n");
    FAIL() << "not refused";
  } catch (const InputError& error) {
    const std::string text = error.what();
    for (const char* part : {"thicknes_m", "source", "areal_density_kg_m2", "orientation_deg", "either cfm"})
      EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
    EXPECT_EQ(error.code(), ExitCode::usage);
  }
}

}  // namespace
}  // namespace ripstop
