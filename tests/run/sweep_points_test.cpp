#include <gtest/gtest.h>

#include <set>

#include "ripstop/core/error.h"
#include "ripstop/run/sweep.h"

namespace ripstop {
namespace {

const std::filesystem::path stratos =
    std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml";

TEST(SweepPoints, AreEveryCombinationEachOneStepFromItsNeighbour) {
  const std::vector<SweepAxis> axes = {
      sweep_axis("flow.speed_m_s", {"10", "15", "20", "25", "30"}, "--speeds"),
      sweep_axis("materials.f-111.darcy", {"50", "60"}, "--vary")};
  const std::vector<SweepPoint> points = sweep_points(stratos, {}, axes);
  ASSERT_EQ(points.size(), 10u);
  std::set<std::string> folders;
  int cold = 0;
  for (const SweepPoint& point : points) {
    folders.insert(point.folder);
    if (point.start < 0) {
      ++cold;
      EXPECT_EQ(point.values, (std::vector<std::string>{"20", "50"}));
      continue;
    }
    const SweepPoint& neighbour = points[point.start];
    const double step = std::abs(point.value.flow.speed_m_s - neighbour.value.flow.speed_m_s) / 5 +
                        std::abs(canopy_fabric(point.value).resistance.linear -
                                 canopy_fabric(neighbour.value).resistance.linear) /
                            10;
    EXPECT_DOUBLE_EQ(step, 1) << point.folder;
    EXPECT_LE(std::abs(neighbour.value.flow.speed_m_s - 20), std::abs(point.value.flow.speed_m_s - 20));
  }
  EXPECT_EQ(cold, 1);
  EXPECT_EQ(folders.size(), 10u);
}

TEST(SweepPoints, TakeTheDensityOfTheirOwnSpeed) {
  const auto points = sweep_points(stratos, {}, {sweep_axis("flow.speed_m_s", {"10", "25"}, "--speeds")});
  EXPECT_DOUBLE_EQ(air(points[0].value).density, 1.202);
  EXPECT_DOUBLE_EQ(air(points[1].value).density, 1.204);
}

TEST(SweepPoints, WithAValueTwiceAreRefused) {
  EXPECT_THROW(sweep_points(stratos, {}, {sweep_axis("flow.speed_m_s", {"10", "10"}, "--speeds")}), Error);
}

TEST(SweepRow, OfATextThatIsNoResultIsRefused) {
  EXPECT_THROW(sweep_row("{}"), Error);
  EXPECT_THROW(sweep_row("nonsense"), Error);
}

}  // namespace
}  // namespace ripstop
