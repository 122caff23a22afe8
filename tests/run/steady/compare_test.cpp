// Models beside each other: what each keeps of its laws, what is told of them, and the files.
#include "ripstop/run/steady/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "ripstop/case/assemble.h"
#include "ripstop/core/error.h"
#include "ripstop/output/csv.h"
#include "tests/run/steady/finished_run.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

TEST(CompareModels, TheWeftAndTheTapeKeepTheirFirstCoefficientToo) {
  Case given = square_law_case();
  Fabric cloth = canopy_fabric(given);
  cloth.name = given.parachute.canopy_material = "woven";
  cloth.coefficients_n_m = {700, 80, 9};
  cloth.weft_coefficients_n_m = {};
  given.materials.insert_or_assign(cloth.name, cloth);
  given.parachute.tape.material = "none";
  given = checked(given);
  SweepAxis axis = linear_models(resolve(given));
  EXPECT_EQ(axis.name, "model");
  EXPECT_EQ(axis.values, (std::vector<std::string>{"nonlinear", "linear", "linear cloth", "linear lines"}));
  ASSERT_EQ(axis.settings.size(), 4u);
  EXPECT_TRUE(axis.settings[0].empty());
  ASSERT_EQ(axis.settings[1].size(), 1u);
  EXPECT_EQ(axis.settings[1][0].key, "coupling.linear");
  EXPECT_EQ(axis.settings[1][0].value, "true");
  ASSERT_EQ(axis.settings[2].size(), 1u);
  EXPECT_EQ(axis.settings[2][0].key, "materials.woven.coefficients_n_m");
  EXPECT_EQ(axis.settings[2][0].value, "[700]");

  cloth.weft_coefficients_n_m = {600, 70};
  given.materials.insert_or_assign(cloth.name, cloth);
  given.parachute.tape.material = "nylon-tape";
  given = checked(given);
  axis = linear_models(resolve(given));
  ASSERT_EQ(axis.settings[2].size(), 2u);
  EXPECT_EQ(axis.settings[2][1].key, "materials.woven.weft_coefficients_n_m");
  EXPECT_EQ(axis.settings[2][1].value, "[600]");
  ASSERT_EQ(axis.values.size(), 5u);
  EXPECT_EQ(axis.values[4], "linear tape");
  EXPECT_EQ(axis.settings.at(4).at(0).key, "materials.nylon-tape.coefficients_n_m");
  // One line above and below the confluence is one law.
  given.parachute.riser.material = given.parachute.lines.material;
  EXPECT_EQ(linear_models(resolve(checked(given))).settings[3].size(), 1u);

  given.coupling.linear = true;
  try {
    linear_models(resolve(given));
    ADD_FAILURE() << "a linear case was compared";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
  }
}

class ComparedModels : public testing::Test {
 protected:
  void SetUp() override {
    SteadyObserver quiet;
    for (const char* model : {"nonlinear", "linear"}) {
      Case given = square_law_case({{"flow.speed_basis", "nominal"}, {"flow.density_kg_m3", "1.2"}});
      given.coupling.linear = !points_.empty();
      points_.push_back({{model}, resolve(given), "", -1});
      solutions_.push_back(run_steady(points_.back().resolved, quiet));
      rows_.emplace_back();
      rows_.back().done = true;
      rows_.back().result = solutions_.back().result;
    }
    rows_[1].result.drag = 0.9 * rows_[0].result.drag;
    rows_[1].result.wall_time = 7;
    rows_[1].result.size.projected_diameter = 1.02 * rows_[0].result.size.projected_diameter;
  }
  Comparison compared() const {
    return compare_models(points_, rows_, [&](std::size_t i) { return solutions_[i].state; });
  }
  std::vector<SweepPoint> points_;
  std::vector<SteadySolution> solutions_;
  std::vector<SweepRow> rows_;
};

TEST_F(ComparedModels, HaveTheNumbersOfTheirRunsAndOfWhatWasMeasured) {
  const double speed = points_[0].resolved.flow().speed_m_s;
  points_[0].resolved = edited(points_[0].resolved, [&](Case& given) {
    given.measured = {{speed, 21, 1.2, 400.0, 390.0, 380.0}};
  });
  const Comparison c = compared();
  EXPECT_EQ(c.speed, speed);
  EXPECT_EQ(c.drag_tolerance, points_[0].resolved.coupling().drag_tolerance);
  EXPECT_EQ(c.measured_drag, 400);
  EXPECT_EQ(c.printed_nonlinear, 390);
  EXPECT_EQ(c.printed_linear, 380);
  ASSERT_EQ(c.models.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const ComparedModel& m = c.models[i];
    const SteadyResult& r = rows_[i].result;
    EXPECT_EQ(m.model, points_[i].values[0]);
    EXPECT_EQ(m.drag, r.drag);
    EXPECT_EQ(m.drag_area, r.drag_area);
    EXPECT_EQ(m.projected_diameter, r.size.projected_diameter);
    EXPECT_EQ(m.skirt_diameter, r.size.skirt_diameter);
    EXPECT_EQ(m.length, r.size.length);
    EXPECT_EQ(m.iterations, r.iterations);
    EXPECT_EQ(m.wall_time, r.wall_time);
    EXPECT_EQ(m.strain.size(),
              part_strains(parachute_mesh(points_[i].resolved), solutions_[i].state.shape).size());
    EXPECT_FALSE(m.strain.empty());
  }
  EXPECT_NEAR(c.models[1].drag_difference, -0.1, 1e-12);
  EXPECT_NEAR(c.beyond_sum, -0.1 * c.models[0].drag, 1e-9);  // no material by itself is here
  EXPECT_NEAR(c.by_projected_area, 2 * std::log(1.02), 1e-12);
  EXPECT_NEAR(c.by_projected_area + c.by_drag_per_area, std::log(0.9), 1e-12);
  double widest = 0;  // of all rings, in radius
  for (std::size_t i = 0; i < c.models[0].profile.size(); ++i)
    widest =
        std::max(widest, std::abs(c.models[1].profile[i].diameter - c.models[0].profile[i].diameter) / 2);
  EXPECT_GT(widest, 0);
  EXPECT_DOUBLE_EQ(c.models[1].profile_change, widest);
  points_[0].resolved = edited(points_[0].resolved, [](Case& given) { given.measured.clear(); });
  EXPECT_FALSE(compared().measured_drag);
}

TEST_F(ComparedModels, AreInAFoldersTableSideBySideAndInItsPictures) {
  const TemporaryFolder root("compared");
  const Comparison c = compared();
  const auto folder = root.path / "new";
  write_comparison(folder, c);
  const CsvTable table = read_csv(folder / "profile.csv");
  const std::vector<ProfileRing>&a = c.models[0].profile, &b = c.models[1].profile;
  ASSERT_EQ(table.rows.size(), a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_EQ(table.rows[i], (std::vector<double>{double(a[i].patch), double(a[i].row), a[i].z, a[i].diameter,
                                                  b[i].z, b[i].diameter}));
  EXPECT_EQ(read_file(folder / "result.json"), to_json(c));
  EXPECT_NEAR(nlohmann::json::parse(to_json(c)).at("models")[1].at("drag_difference").get<double>(), -0.1,
              1e-12);
  for (const char* name : {"profile.svg", "profile.png"})
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  Comparison flat = c;  // of sheets that do not go round
  for (ComparedModel& model : flat.models) model.profile.clear();
  write_comparison(root.path / "flat", flat);
  EXPECT_FALSE(std::filesystem::exists(root.path / "flat/profile.svg"));
  EXPECT_TRUE(read_csv(root.path / "flat/profile.csv").rows.empty());
}

}  // namespace
}  // namespace ripstop
