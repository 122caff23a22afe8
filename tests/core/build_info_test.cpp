// Which data an installed program and one of the build tree use.
#include "ripstop/core/build_info.h"

#include <gtest/gtest.h>

#include "ripstop/core/file.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

class DataDirectory : public testing::Test {
 protected:
  DataDirectory() {
    for (const fs::path& data : {source, usr / "share/ripstop", configured}) make_folder(data / "materials");
  }
  TemporaryFolder root{"data"};
  fs::path source = root.path / "checkout", usr = root.path / "usr",
           configured = root.path / "opt/share/ripstop";
  DataFolders folders{source / "build", source, configured};
};

TEST_F(DataDirectory, IsTheInstalledOneOfAnInstalledProgramWhileTheCheckoutExists) {
  EXPECT_EQ(find_data(usr / "bin/ripstop", folders), usr / "share/ripstop");
  EXPECT_EQ(find_data(usr / "lib/python3/dist-packages/ripstop/_ripstop.so", folders), usr / "share/ripstop");
}

TEST_F(DataDirectory, IsTheSourceTreeForAProgramOfTheBuildTree) {
  EXPECT_EQ(find_data(source / "build/bin/ripstop", folders), source);
  EXPECT_EQ(data_directory(), RIPSTOP_SOURCE_DIR);
}

TEST_F(DataDirectory, IsTheConfiguredOneWhereTheProgramHasNoneNear) {
  const fs::path program = root.path / "home/tool/bin/program";
  EXPECT_EQ(find_data(program, folders), configured);
  remove_path(configured);
  EXPECT_EQ(find_data(program, folders), source);
  remove_path(source);
  EXPECT_EQ(find_data(program, folders), fs::path());
}

}  // namespace
}  // namespace ripstop
