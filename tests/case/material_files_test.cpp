// Materials named by a path, and those in a folder next to the case.
#include <gtest/gtest.h>

#include <filesystem>

#include "../refusal.h"
#include "fixture.h"
#include "ripstop/case/case.h"
#include "ripstop/core/file.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

class MaterialFilesTest : public testing::Test {
 protected:
  MaterialFilesTest() {
    Material cloth = canopy_fabric(parse_case(valid_case, "small.toml"));
    std::get<Fabric>(cloth).areal_density_kg_m2 = 0.0987;
    text = material_to_toml(cloth);
    make_folder(root.path / "cases/materials");
    write_file(root.path / "cases/case.toml", valid_case);
  }
  static Overrides with(const std::string& setting) {
    Overrides overrides;
    overrides.set = {parse_setting(setting, "--set")};
    return overrides;
  }
  Case read(const std::string& material) const {
    return read_case(root.path / "cases/case.toml", with("parachute.canopy_material=" + material));
  }
  TemporaryFolder root{"material-files"};
  std::string text;
};

TEST_F(MaterialFilesTest, APathIsRelativeToTheCase) {
  write_file(root.path / "my-cloth.toml", text);
  const Case given = read("../my-cloth.toml");
  EXPECT_EQ(given.parachute.canopy_material, "my-cloth");
  EXPECT_EQ(canopy_fabric(given).areal_density_kg_m2, 0.0987);
  EXPECT_EQ(canopy_fabric(read((root.path / "my-cloth.toml").string())).areal_density_kg_m2, 0.0987);
}

TEST_F(MaterialFilesTest, AMaterialInTheFolderNextToTheCaseHasPriorityOverTheLibrary) {
  write_file(root.path / "cases/materials/f-111.toml", text);
  EXPECT_EQ(canopy_fabric(read("f-111")).areal_density_kg_m2, 0.0987);
  EXPECT_NE(canopy_fabric(read("f-111-physical")).areal_density_kg_m2, 0.0987);
}

TEST_F(MaterialFilesTest, RejectAPathWithoutAFileAndANameThatIsTaken) {
  EXPECT_NE(refusal_of([&] { read("nothing.toml"); }, ExitCode::usage).find("not found; give the path"),
            std::string::npos);
  write_file(root.path / "cases/cloth.toml", "kind = \"fabric\"\n");
  EXPECT_NE(refusal_of([&] { read("cloth.toml"); }, ExitCode::bad_data).find("cloth.toml"),
            std::string::npos);
  make_folder(root.path / "other");
  for (const char* file : {"cases/line.toml", "other/line.toml"}) write_file(root.path / file, text);
  Overrides two = with("parachute.canopy_material=line.toml");
  two.set.push_back(parse_setting("parachute.lines.material=../other/line.toml", "--set"));
  EXPECT_NE(refusal_of([&] { read_case(root.path / "cases/case.toml", two); }, ExitCode::usage)
                .find("two materials \"line\""),
            std::string::npos);
}

}  // namespace
}  // namespace ripstop
