// A case with a payload in place of its speed, on a flow whose drag area is fixed: the answer is a closed form.
#include "ripstop/case/payload.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ripstop/flight/atmosphere.h"
#include "tests/run/steady/finished_run.h"

namespace ripstop {
namespace {

std::vector<Setting> falling(const std::string& mass, std::vector<Setting> more = {}) {
  more.push_back({"payload.mass_kg", mass});
  more.push_back({"flow.speed_basis", "nominal"});
  more.push_back({"flow.density_kg_m3", "1.1"});
  return more;
}

double closed_form(const Case& given) {
  return std::sqrt(2 * suspended_weight(resolve(given), *given.payload.mass_kg) /
                   (1.1 * (SquareLawEngine::area + given.payload.drag_area_m2)));
}

TEST(Payload, TheRunFindsTheSpeedAtWhichDragIsWeight) {
  for (const char* mass : {"3", "40"}) {
    const Case given = square_law_case(falling(mass));
    SteadyObserver nobody;
    const SteadyResult r = run_steady(given, nobody).result;
    EXPECT_TRUE(r.converged);
    ASSERT_TRUE(r.payload);
    EXPECT_NEAR(r.drag / r.payload->weight, 1, payload_tolerance);
    EXPECT_NEAR(r.speed / closed_form(given), 1, payload_tolerance) << mass;
    EXPECT_NEAR(r.drag_area, 2 * r.drag / (1.1 * r.speed * r.speed), 1e-9);
    EXPECT_NEAR(r.payload->weight, (r.payload->mass + r.payload->parachute_mass) * standard_gravity, 1e-9);
    EXPECT_GE(r.payload->speeds, 2);
  }
}

// A body that is wide for its weight falls slower, and the canopy carries the less.
TEST(Payload, ItsOwnDragCarriesItsPartOfTheWeight) {
  const Case given =
      square_law_case(falling("3", {{"payload.drag_area_m2", std::to_string(SquareLawEngine::area / 2)}}));
  SteadyObserver nobody;
  const SteadyResult r = run_steady(given, nobody).result;
  EXPECT_TRUE(r.converged);
  ASSERT_TRUE(r.payload);
  EXPECT_NEAR(r.speed / closed_form(given), 1, payload_tolerance);
  EXPECT_NEAR(r.drag / r.payload->weight, 2.0 / 3, payload_tolerance);
  EXPECT_NEAR(r.payload->own_drag / r.payload->weight, 1.0 / 3, payload_tolerance);
}

// An engine that cannot continue from its flow at another speed begins anew at each.
TEST(Payload, AFlowThatCannotBeScaledStartsAfreshAtEverySpeed) {
  static int started = 0;
  static const bool added = [] {
    struct Counted : SquareLawEngine {
      std::unique_ptr<Flow> start(const FlowProblem& problem) override {
        ++started;
        return SquareLawEngine::start(problem);
      }
    };
    add_engine({"square-law-afresh",
                "a fixed drag area, one speed",
                {},
                [](const EngineOptions&) { return std::string("square law 1"); },
                [](const EngineOptions&) { return std::make_unique<Counted>(); }});
    return true;
  }();
  ASSERT_TRUE(added);
  Case given = square_law_case(falling("3"));
  given.flow.engine = "square-law-afresh";
  SteadyObserver nobody;
  const SteadyResult r = run_steady(given, nobody).result;
  EXPECT_TRUE(r.converged);
  EXPECT_NEAR(r.speed / closed_form(given), 1, payload_tolerance);
  ASSERT_TRUE(r.payload);
  EXPECT_EQ(started, r.payload->speeds);
}

// The whole load of the riser acts on its fixed end, whose force is in the force balance. One piece of it has no spring
// against bending over it, two have one each, more of them two but at the ends: with a tenth of the law in them, the
// axial spring over 1 - 0.1 would be 5 to 11 % too much. That the end is stretched a little more than its neighbour
// leaves eps^2 / 8 (to second order, of a straight curve; 0.00135 in full).
TEST(RunMargins, TheRisersLoadIsIndependentOfItsNumberOfPieces) {
  SteadyObserver nobody;
  for (const char* length : {"0.06", "0.12", "0.5"}) {
    Case given = square_law_case({{"parachute.riser.length_m", length}});
    Line line = riser_line(given);
    line.bending_fraction = 0.1;
    given.parachute.riser.material = line.name = "stiff line";
    given.materials.insert_or_assign(line.name, line);
    const SteadyResult r = run_steady(given, nobody).result;
    ASSERT_TRUE(r.converged && r.margins);
    double riser = 0, lines = 0, cloth = 0;
    for (const Margin& m : r.margins->members) {
      if (m.member == "riser") riser = m.load;
      if (m.member == "cloth") cloth = m.load;
      if (m.member.starts_with("line ")) lines += m.load;
    }
    EXPECT_NEAR(riser / r.ledger.line_tension, 1, std::string(length) == "0.5" ? 1.5e-3 : 1e-5) << length;
    EXPECT_GT(lines, r.drag);  // they are aslant
    EXPECT_LT(lines, 1.2 * r.drag);
    EXPECT_EQ(cloth, std::max(r.stress.warp, r.stress.weft));
  }
}

TEST(Payload, WithoutASpeedTheIterationBeginsAtTheFamilysUsualDrag) {
  Case given = square_law_case(falling("3"));
  given.flow.speed_m_s.reset();
  struct First : SteadyObserver {
    double speed = 0;
    void begin(const SteadyRun& run, SteadyState&) override { speed = run.resolved.flow().speed_m_s; }
  } first;
  const SteadyResult r = run_steady(given, first).result;
  EXPECT_DOUBLE_EQ(first.speed, payload_first_speed(given, 1.1));
  EXPECT_TRUE(r.converged);
  EXPECT_NEAR(r.speed / closed_form(given), 1, payload_tolerance);
}

TEST(Payload, WhereTheSearchBeginsDoesNotMatter) {
  SteadyObserver nobody;
  const auto from = [&](const char* speed) {
    return run_steady(square_law_case(falling("10", {{"flow.speed_m_s", speed}})), nobody).result.speed;
  };
  EXPECT_NEAR(from("5") / from("40"), 1, 2 * payload_tolerance);
}

TEST(Payload, ItsFolderIsAFinishedRunAndIsFoundAgain) {
  const TemporaryFolder folder("payload");
  const SteadyResult first = fly_square_law(folder.path / "run", falling("5"));
  EXPECT_TRUE(first.converged);
  const SteadyResult again = fly_square_law(folder.path / "run", falling("5"));
  EXPECT_EQ(again.speed, first.speed);
  ASSERT_TRUE(again.payload);
  EXPECT_EQ(again.payload->weight, first.payload->weight);
  EXPECT_EQ(final_state(folder.path / "run").speed, first.speed);
}

/// Ends as a killed process does: by leaving.
struct KilledInTime : SteadyObserver {
  int left = 0;
  void iterated(const SteadyRun&, const SteadyState&, const FlowField&) override {
    if (--left == 0) throw std::runtime_error("killed");
  }
};

TEST(Payload, AKilledRunResumesAtItsSpeed) {
  const TemporaryFolder folder("payload-killed");
  const Case given = square_law_case(falling("5"));
  const auto settings = [&](const char* name) {
    return SteadyFolderSettings{{folder.path / name, false}, 1, {}, {}};
  };
  SteadyObserver nobody;
  const SteadyResult whole = run_steady_in(settings("whole"), resolve(given), nobody).result;
  KilledInTime killed;
  killed.left = 2;
  EXPECT_THROW(run_steady_in(settings("killed"), resolve(given), killed), std::runtime_error);
  const SteadyResult resumed = run_steady_in(settings("killed"), resolve(given), nobody).result;
  EXPECT_TRUE(resumed.converged);
  EXPECT_NEAR(resumed.speed / whole.speed, 1, 1e-9);
  EXPECT_EQ(resumed.iterations, whole.iterations);
}

TEST(Payload, ARunThatEndsBeforeTheDragIsTheWeightHasNotConverged) {
  SteadyObserver nobody;
  const SteadyResult r =
      run_steady(square_law_case(falling("3", {{"coupling.max_iterations", "1"}, {"flow.speed_m_s", "40"}})),
                 nobody)
          .result;
  EXPECT_FALSE(r.converged);
  EXPECT_GT(std::abs(r.payload->drag_over_weight - 1), payload_tolerance);
}

}  // namespace
}  // namespace ripstop
