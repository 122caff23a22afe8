#include "ripstop/core/reasons.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace ripstop {
namespace {

TEST(Reasons, OfAJsonLibraryDoNotNameItsExceptions) {
  try {
    nlohmann::json::parse("{}").at("drag_n");
    FAIL();
  } catch (const nlohmann::json::exception& error) {
    EXPECT_EQ(json_reason(error), "key 'drag_n' not found");
  }
}

TEST(Reasons, OfAFileSystemNameThePathAndTheRemedy) {
  const std::filesystem::filesystem_error error("cannot rename", "here/x",
                                                std::make_error_code(std::errc::permission_denied));
  EXPECT_EQ(file_reason(error),
            "here/x: Permission denied; check the path, its permissions and the free space");
}

}  // namespace
}  // namespace ripstop
