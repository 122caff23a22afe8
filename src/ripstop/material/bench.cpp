#include "ripstop/material/bench.h"

#include <fmt/format.h>

#include "ripstop/core/toml/fields.h"
#include "ripstop/core/toml/read.h"

namespace ripstop::inline material {

void describe(Fields& fields, BenchCoupon& coupon) {
  fields.text("file", coupon.file, 400, "Record (CSV), relative to this file.").required();
  fields.text("specimen", coupon.specimen, 100,
              "Name or number of the specimen in a file with several; default: all of them.");
  fields
      .number("orientation_deg", coupon.orientation_deg, from(0).up_to(90),
              "Angle between load and warp: 0, 45 or 90.")
      .absent("as stated in the record");
  fields.number("length_m", coupon.length_m, above(0).up_to(100), "Gauge length between the clamps.")
      .absent("as stated in the record");
  fields.number("width_m", coupon.width_m, above(0).up_to(10), "Width of the coupon; none for a line.")
      .absent("as stated in the record; for a tape width_m of the campaign");
  fields.text("force_column", coupon.force_column, 200, "Heading of the force, with or without its unit.");
  fields.text("displacement_column", coupon.displacement_column, 200,
              "Heading of the displacement, with or without its unit.");
  fields.text("force_unit", coupon.force_unit, 20, "Unit of the force, if the header has none.");
  fields.text("displacement_unit", coupon.displacement_unit, 20,
              "Unit of the displacement, if the header has none.");
}

void describe(Fields& fields, BenchFlow& flow) {
  fields.number("pressure_pa", flow.pressure_pa, above(0).up_to(1e5),
                "Pressure difference; 124.5 is half an inch of water (ASTM D737).");
  fields.number("velocity_m_s", flow.velocity_m_s, above(0).up_to(100), "Flow per area.");
  fields.number("cfm", flow.cfm, above(0).up_to(1e4),
                "Flow in cubic feet per minute and square foot: 5.08e-3 m/s.");
}

void describe(Fields& fields, Bench& bench) {
  fields
      .choice("kind", bench.kind,
              {{"fabric", BenchKind::fabric}, {"line", BenchKind::line}, {"tape", BenchKind::tape}},
              "Kind of the tested material.")
      .required();
  fields.name("name", bench.name, "Name of the material, and of its file.").required();
  fields.text("source", bench.source, 300, "Source: laboratory, material and test.").required();
  fields.number("areal_density_kg_m2", bench.areal_density_kg_m2, above(0).up_to(10),
                "Mass per area; required for a fabric.");
  fields.number("linear_density_kg_m", bench.linear_density_kg_m, above(0).up_to(100),
                "Mass per length; required for line and tape.");
  fields.number("thickness_m", bench.thickness_m, above(0).up_to(0.1),
                "Thickness; required for fabric and tape.");
  fields.number("width_m", bench.width_m, above(0).up_to(1), "Width of a tape; required for a tape.");
  fields.integer("degree", bench.degree, from(0).up_to(8),
                 "Degree of the curves; 0: chosen by degree_rule, one for all orientations.");
  fields.choice(
      "degree_rule", bench.degree_rule,
      {{"cross-validation", DegreeRule::cross_validation}, {"nfm", DegreeRule::nfm}},
      "\"cross-validation\": lowest degree that predicts a sample from the others as well as any degree; "
      "\"nfm\": lowest degree with R2 above wanted_r2 in every orientation, for unweighted points ([NFM]).");
  fields.number("wanted_r2", bench.wanted_r2, above(0).below(1), "R2 required by degree_rule = \"nfm\".");
  fields.number("working_strain", bench.working_strain, from(1e-3).up_to(4),
                "Strain up to which all points have equal weight. Beyond it the weight is (working_strain / "
                "strain)^2.");
  fields.number("confidence", bench.confidence, above(0).below(1),
                "Confidence level of intervals and bands.");
  fields.toggle("zero_offset", bench.zero_offset,
                "Fit with zero load at zero strain (K_0 = 0: no residual stress); false: K_0 is fitted, but "
                "the springs do not carry it.");
  fields.toggle("single_samples", bench.single_samples,
                "Accept a single record for an orientation, which then has no confidence band.");
  fields.choice(
      "weft", bench.weft,
      {{"auto", WeftChoice::automatic}, {"same", WeftChoice::same}, {"separate", WeftChoice::separate}},
      "Whether the 90 deg records give a separate weft curve or are combined with the 0 deg records.");
  fields.number("compression", bench.compression, from(0).up_to(1),
                "Stiffness of cloth or tape in compression relative to K_1.");
  fields.number("shear_fraction", bench.shear_fraction, from(0).below(1),
                "Shear fraction xi; absent: fitted to the 45 deg coupons, or 0.2 without them.");
  fields.number("bending_fraction", bench.bending_fraction, from(0).below(1),
                "Bending fraction eps; absent: fitted to the coupons if they determine it, else 0.01.");
  fields.text("columns", bench.columns, 500,
              "Columns of all records, for example \"force=Kraft [kN],extension=Weg [mm]\".");
  fields.choice("decimal", bench.decimal,
                {{"auto", table::Decimal::automatic},
                 {"point", table::Decimal::point},
                 {"comma", table::Decimal::comma}},
                "Decimal mark of the records, where numbers are ambiguous.");
  fields.rows("coupon", bench.coupons, "One record.");
  fields.rows("flow", bench.flows, "One reading of an air permeability tester.");
}

Bench read_bench(const std::filesystem::path& file) {
  std::vector<Problem> problems;
  Bench bench;
  try {
    const Document document = parse_toml(read_text_file(file), file.string());
    Origins origins;
    read_and_check([&](Fields& fields) { describe(fields, bench); }, document, origins, problems);
    Findings findings(origins, problems);
    const auto need = [&](const char* key, bool there, const char* why) {
      if (!there && findings.sound({key})) findings.add(key, "", "", fmt::format("is missing: {}", why));
    };
    const bool fabric = bench.kind == BenchKind::fabric;
    if (fabric) need("areal_density_kg_m2", bench.areal_density_kg_m2.has_value(), "required for a fabric");
    if (!fabric)
      need("linear_density_kg_m", bench.linear_density_kg_m.has_value(), "required for line and tape");
    if (bench.kind != BenchKind::line)
      need("thickness_m", bench.thickness_m.has_value(), "required for fabric and tape");
    if (bench.kind == BenchKind::tape) need("width_m", bench.width_m.has_value(), "required for a tape");
    need("coupon", !bench.coupons.empty(), "write a [[coupon]] with `file` for every record");
    for (std::size_t i = 0; i < bench.coupons.size(); ++i) {
      const std::optional<double>& angle = bench.coupons[i].orientation_deg;
      if (angle && *angle != 0 && *angle != 45 && *angle != 90)
        findings.add(fmt::format("coupon[{}].orientation_deg", i), *angle, "0, 45 or 90",
                     "cloth is tested along the warp (0), the weft (90) or the bias (45)");
    }
    try {
      table::parse_columns(bench.columns);
    } catch (const Error& error) {
      findings.add("columns", fmt::format("\"{}\"", bench.columns), "", error.what());
    }
    for (std::size_t i = 0; i < bench.flows.size(); ++i)
      if (bench.flows[i].cfm.has_value() == bench.flows[i].velocity_m_s.has_value())
        findings.add(fmt::format("flow[{}].cfm", i), "", "", "give either cfm or velocity_m_s");
  } catch (const InputError& error) {
    problems = error.problems();
  }
  if (!problems.empty()) throw InputError(ExitCode::usage, problems);
  bench.file = file;
  return bench;
}

}  // namespace ripstop::inline material
