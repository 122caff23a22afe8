// Results without a run folder contain their inputs.
#include <gtest/gtest.h>

#include "ripstop/core/thread_team.h"
#include "ripstop/material/library.h"
#include "ripstop/run/material/coupon.h"
#include "ripstop/run/material/fit.h"
#include "ripstop/run/sizing/fabric.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

TEST(ResultsNameTheirInputs, OtherInputsHaveAnotherHash) {
  Case given = read_case(fs::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml");
  given.parachute.mesh.cloth_nodes = 600;
  given.coupling.cloth_tolerance = 0.1;
  given.coupling.threads = 1;
  const auto fabric = [&](double pressure) {
    return run_fabric(resolve(given), pressure).result.inputs_hash.value();
  };
  EXPECT_EQ(fabric(100), fabric(100));
  EXPECT_NE(fabric(100), fabric(101));

  ThreadTeam team(1);
  const auto cloth = std::get<Fabric>(library_material("f-111"));
  CouponShape shape;
  shape.cells = 4;
  const auto coupon = [&] { return run_coupon(cloth, shape, 0.02, 1, team).inputs_hash.value(); };
  const std::string four = coupon();
  EXPECT_EQ(coupon(), four);
  shape.cells = 5;
  EXPECT_NE(coupon(), four);

  const Bench bench = read_bench(fs::path(RIPSTOP_SOURCE_DIR) / "examples/fit-ripstop/bench.toml");
  Bench other = bench;
  other.degree = 3;
  const auto hash_in = [](const std::string& json) { return json.substr(json.find("inputs_hash") + 15, 32); };
  const std::string fit = hash_in(to_json(run_fit(bench, false, team)));
  EXPECT_EQ(fit.find_first_not_of("0123456789abcdef"), std::string::npos) << fit;
  EXPECT_EQ(hash_in(to_json(run_fit(bench, false, team))), fit);
  EXPECT_NE(hash_in(to_json(run_fit(other, false, team))), fit);
}

}  // namespace
}  // namespace ripstop
