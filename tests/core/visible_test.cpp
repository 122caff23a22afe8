#include "ripstop/core/visible.h"

#include <gtest/gtest.h>

namespace ripstop {
namespace {

TEST(Visible, WordsOfAnyLanguageStayAndControlCharactersShow) {
  const std::string words = "Größe 1 µm\tund 降落伞\n🪂";
  EXPECT_EQ(visible(words), words);
  EXPECT_EQ(visible("\x1b[31mred\x07"), "\\x1b[31mred\\x07");
  EXPECT_EQ(visible("\xc2\x9b"
                    "2J"),
            "\\xc2\\x9b2J");  // CSI in one character
  EXPECT_EQ(visible("a\xe2\x80\xae"
                    "b"),
            "a\\xe2\\x80\\xae"
            "b");  // right to left from here
  EXPECT_EQ(visible("\x9b\xff\xc0\xaf\xed\xa0\x80\xc3"),
            "\\x9b\\xff\\xc0\\xaf\\xed\\xa0\\x80\\xc3");  // no UTF-8
  EXPECT_EQ(visible(std::string("\0\r", 2)), "\\x00\\x0d");
}

// Embeddings, overrides and isolates, U+202A to U+202E and U+2066 to U+2069, and no neighbour of theirs.
TEST(Visible, EveryMarkThatTurnsTheDirectionOfWritingShows) {
  for (const char* mark :
       {"\u202a", "\u202b", "\u202c", "\u202d", "\u202e", "\u2066", "\u2067", "\u2068", "\u2069"}) {
    EXPECT_TRUE(has_control(mark)) << visible(mark);
    EXPECT_EQ(visible(mark).substr(0, 4), "\\xe2");
  }
  for (const char* beside : {"\u2029", "\u202f", "\u2065", "\u206a"}) EXPECT_EQ(visible(beside), beside);
}

TEST(Visible, TextForOneLineHasNoControlCharacter) {
  EXPECT_FALSE(has_control("Größe 降落伞"));
  for (const char* text : {"a\nb", "a\tb", "\x7f", "\xc2\x85", "\xff"}) EXPECT_TRUE(has_control(text));
}

}  // namespace
}  // namespace ripstop
