#include "ripstop/run/parity.h"

#include <gtest/gtest.h>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

// The box reaches from (-1, -1, 0) to (1, 1, 4) m.
TEST(FlowParity, ASurfaceThatLeavesTheBoxOnAnySideIsRefused) {
  const Vec3 beyond[] = {{-1.1, 0, 2}, {1.1, 0, 2}, {0, -1.1, 2}, {0, 1.1, 2}, {0, 0, -0.1}, {0, 0, 4.1}};
  for (const Vec3 corner : beyond) {
    ParitySettings settings;
    settings.surface = {{{0.1, 0, 2}, {0, 0.1, 2.1}, corner}};
    try {
      flow_parity(settings);
      ADD_FAILURE() << corner.x << ", " << corner.y << ", " << corner.z << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data);
      EXPECT_NE(std::string(error.what()).find("inside the box"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace ripstop
