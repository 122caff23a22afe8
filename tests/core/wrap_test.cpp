// Long lines of printed text.
#include "ripstop/core/wrap.h"

#include <gtest/gtest.h>

namespace ripstop {
namespace {

TEST(Wrap, IndentsTheTextOfARowBelowItsText) {
  EXPECT_EQ(wrapped("  name      one two three four\n  next      five\n", 24),
            "  name      one two\n            three four\n  next      five\n");
}

TEST(Wrap, IndentsASentenceByTwo) {
  EXPECT_EQ(wrapped("warning: the mouth closes at once", 20), "warning: the mouth\n  closes at once");
}

TEST(Wrap, DoesNotBreakAWordThatIsLongerThanALine) {
  EXPECT_EQ(wrapped("  file  /a/long/path/to/a/file here", 16),
            "  file  /a/long/path/to/a/file\n        here");
}

TEST(Wrap, KeepsTextOutsideOfATerminal) {
  const std::string text = "  name      one two three four five six seven\n";
  EXPECT_EQ(wrapped(text, 0), text);
  EXPECT_EQ(wrap_width(-1), 0u);
}

}  // namespace
}  // namespace ripstop
