// A mesh that no cloth can be made of is refused with what is wrong with it.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "../refusal.h"
#include "builders.h"

namespace ripstop {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct BadMesh {
  const char* message;
  std::function<void(Mesh&)> spoil;
};

const SpringLaw& long_law() {
  static const SpringLaw law{std::vector<double>(9, 1.0)};
  return law;
}

TEST(BadMesh, IsRefusedWithWhatIsWrong) {
  const Mesh sound = testing::medley(0.01, true);
  ASSERT_GE(sound.patches.size(), 2u);
  ASSERT_GE(sound.ties.size(), 2u);
  ASSERT_EQ(sound.ties.back().masters.size(), 2u);
  ASSERT_FALSE(sound.springs.empty());
  make_cloth(sound);
  Mesh of_eight = sound;
  of_eight.laws[0].coefficients.assign(8, 100);  // as many as the kernels have
  make_cloth(of_eight);
  const int count = sound.node_count(), tied = sound.ties.back().node;
  const BadMesh bad_meshes[] = {
      {"masses for", [](Mesh& m) { m.mass.pop_back(); }},
      {"node 1 has no finite position", [](Mesh& m) { m.start[1].y = not_a_number; }},
      {"node 2 has mass -1 kg", [](Mesh& m) { m.mass[2] = -1; }},
      {"has no mass", [](Mesh& m) { m.mass.assign(m.mass.size(), 0.0); }},
      {"a spring law of degree", [](Mesh& m) { m.laws[0] = long_law(); }},
      {"a spring law with buckling strain", [](Mesh& m) { m.laws[0].buckling_strain = -1e-9; }},
      {": a spring law of degree", [](Mesh& m) { m.patches[1].law[0] = long_law(); }},
      {": a spring law with buckling strain",
       [](Mesh& m) { m.patches[1].law[3].buckling_strain = not_a_number; }},
      {"0 rows", [](Mesh& m) { m.patches[0].rows = 0; }},
      {"and 0 columns", [](Mesh& m) { m.patches[0].periodic = false, m.patches[0].columns = 0; }},
      {"and 2 columns", [](Mesh& m) { m.patches[0].periodic = true, m.patches[0].columns = 2; }},
      {"extends beyond the last node", [&](Mesh& m) { m.patches[1].first_node = count; }},
      {"extends beyond the last node", [](Mesh& m) { m.patches[1].first_node = -1; }},
      {"cell areas, needs", [](Mesh& m) { m.patches[0].cell_area.resize(1); }},
      {"must be rows x columns", [](Mesh& m) { m.patches[0].width[1].pop_back(); }},
      {"must be rows x columns", [](Mesh& m) { m.patches[0].rest_length[2].push_back(1); }},
      {"spring 0 has width -1 m", [](Mesh& m) { m.patches[0].width[0][0] = -1; }},
      {"rest length 0 m", [](Mesh& m) { m.patches[0].width[0][0] = 1, m.patches[0].rest_length[0][0] = 0; }},
      {"and leaves the patch",
       [](Mesh& m) {
         m.patches[0].width[1].back() = m.patches[0].width[0].back() = 1;
         m.patches[0].rest_length[1].back() = m.patches[0].rest_length[0].back() = 1;
       }},
      {"is in two patches", [](Mesh& m) { m.patches[1].first_node = m.patches[0].first_node + 1; }},
      {"is tied twice", [](Mesh& m) { m.ties.push_back(m.ties[0]); }},
      {"is tied twice", [&](Mesh& m) { m.ties[0].node = count; }},
      {"is tied twice", [](Mesh& m) { m.ties[0].node = -1; }},
      {"which is itself tied", [&](Mesh& m) { m.ties[0].masters[0].node = tied; }},
      {"which is itself tied", [&](Mesh& m) { m.ties[0].masters[0].node = count; }},
      {"which is itself tied", [](Mesh& m) { m.ties[0].masters[0].node = -1; }},
      {"with the negative weight -1",
       [](Mesh& m) { m.ties.back().masters[0].weight = -1, m.ties.back().masters[1].weight = 2; }},
      {"add up to", [](Mesh& m) { m.ties.back().masters[0].weight += 1e-6; }},
      {"is tied or absent", [&](Mesh& m) { m.fixed.push_back(tied); }},
      {"is tied or absent", [&](Mesh& m) { m.fixed.push_back(count); }},
      {"is tied or absent", [](Mesh& m) { m.fixed.push_back(-1); }},
      {"spring -1 - ", [](Mesh& m) { m.springs[0].a = -1; }},
      {" has rest length", [&](Mesh& m) { m.springs[0].b = count; }},
      {" has rest length", [&](Mesh& m) { m.springs[0].a = count; }},
      {" has rest length", [](Mesh& m) { m.springs[0].b = -1; }},
      {" has rest length", [](Mesh& m) { m.springs[0].b = m.springs[0].a; }},
      {"rest length 0 m", [](Mesh& m) { m.springs[0].rest_length = 0; }},
      {"scale -1", [](Mesh& m) { m.springs[0].scale = -1; }},
      {"law -1", [](Mesh& m) { m.springs[0].law = -1; }},
      {"law ", [](Mesh& m) { m.springs[0].law = static_cast<int>(m.laws.size()); }},
  };
  int number = 0;
  for (const BadMesh& bad : bad_meshes) {
    Mesh mesh = sound;
    bad.spoil(mesh);
    const std::string message = refusal_of([&] { make_cloth(mesh); }, ExitCode::bad_data);
    EXPECT_NE(message.find(bad.message), std::string::npos) << number << ": " << message;
    ++number;
  }
}

}  // namespace
}  // namespace ripstop
