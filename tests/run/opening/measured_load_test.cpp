// A measured load over time beside that of an opening, from a folder that a test wrote.
#include "ripstop/run/opening/measured_load.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/run_folder.h"
#include "tests/refusal.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

/// An opening with a peak of 500 N at 0.3 s.
double load_at(double t) {
  return 500 * std::exp(-std::pow((t - 0.3) / 0.1, 2));
}

struct MeasuredLoads : testing::Test {
  TemporaryFolder root{"measured-load"};
  std::filesystem::path folder = root.path / "opened", file = root.path / "cell.csv";

  void SetUp() override {
    const auto claimed =
        open_run_folder({folder}, resolve(checked(flat_circular_case(2, 600, 10))), "inflation", 1);
    CsvTable history{{"time_s", "load_mean_n", "load_largest_n"}, {}};
    for (int i = 0; i <= 1000; ++i)
      history.rows.push_back({1e-3 * i, load_at(1e-3 * i), load_at(1e-3 * i) + 1});
    write_csv(claimed->own("history.csv"), history);
    write_file(claimed->own("result.json"), "{\"title\": \"An opening\", \"peak_load_n\": 500}");
    claimed->seal();
  }
  /// The same load `late` seconds later on the instrument's clock, times `factor`, in kN with decimal commas.
  void measure(double late, double factor) const {
    std::string text = "Zeit [ms];Kraft [kN]\n";
    for (int i = 0; i < 400; ++i) {
      const double t = 0.1 + 2e-3 * i;
      std::string row = fmt::format("{:.2f};{:.6f}\n", 1000 * (t + late), factor * load_at(t) / 1000);
      for (char& c : row)
        if (c == '.') c = ',';
      text += row;
    }
    write_file(file, text);
  }
};

TEST_F(MeasuredLoads, AreShiftedToTheComputedOneAndCompared) {
  measure(12.5, 0.8);
  const MeasuredLoad m = compare_load({folder, file, {}, {}, {}});
  EXPECT_NEAR(m.shift, -12.5, 1e-3);
  EXPECT_EQ(m.shift_from, "least mean square difference");
  EXPECT_EQ(m.title, "An opening");
  EXPECT_NEAR(m.computed_peak, 500, 1e-9);
  EXPECT_NEAR(m.measured_peak, 400, 1e-9);
  EXPECT_NEAR(m.measured_peak_time, 0.3, 1e-3);
  EXPECT_NEAR(m.peak_difference, 0.25, 1e-9);
  EXPECT_NEAR(m.computed_impulse / m.measured_impulse, 1.25, 1e-3);
  EXPECT_NEAR(m.overlap, 0.798, 2e-3);
  // The square of a Gaussian has the integral s sqrt(pi / 2).
  EXPECT_NEAR(m.rms_difference, 100 * std::sqrt(0.1 * std::sqrt(std::acos(-1) / 2) / m.overlap), 0.3);
}

TEST_F(MeasuredLoads, KeepAShiftThatIsGivenAndWriteTheirPlots) {
  measure(0, 1);
  const MeasuredLoad m = compare_load({folder, file, {}, {}, 0.05});
  EXPECT_EQ(m.shift, 0.05);
  EXPECT_NEAR(m.measured_peak_time, 0.35, 1e-9);
  EXPECT_GT(m.rms_difference, 30);
  write_measured_load(root.path / "out", m);
  EXPECT_EQ(read_file(root.path / "out/result.json"), to_json(m));
  EXPECT_TRUE(std::filesystem::exists(root.path / "out/load.svg"));
}

TEST_F(MeasuredLoads, WithoutACommonTimeAnOrderOrARunAreRefused) {
  measure(0, 1);
  const auto refused = [&](const MeasuredLoadRequest& request, ExitCode code) {
    return refusal_of([&] { compare_load(request); }, code);
  };
  EXPECT_NE(refused({folder, file, {}, {}, 100}, ExitCode::usage).find("no time in common"),
            std::string::npos);
  EXPECT_NE(refused({root.path, file, {}, {}, {}}, ExitCode::usage).find("no finished run"),
            std::string::npos);
  write_file(file, "Time (s),Load (N)\n0,1\n2,3\n1,2\n");
  EXPECT_NE(refused({folder, file, {}, {}, {}}, ExitCode::bad_data)
                .find("cell.csv:4: the time of 1 s is not after 2 s"),
            std::string::npos);
}

}  // namespace
}  // namespace ripstop
