// Text of users in a shell's script.
#include "ripstop/core/shell.h"

#include <gtest/gtest.h>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/process.h"

namespace ripstop {
namespace {

const std::vector<std::string> hostile = {"",
                                          "plain",
                                          "two words",
                                          "it's",
                                          "''",
                                          "\"",
                                          "$HOME",
                                          "$(touch harm)",
                                          "`touch harm`",
                                          "; touch harm",
                                          "& harm",
                                          "a\nb",
                                          "\n",
                                          "\\",
                                          "a\\'",
                                          "#",
                                          "--x=$(id)\n",
                                          "*",
                                          "~",
                                          "\xff\x01",
                                          "é\t\r !",
                                          "%j",
                                          "|",
                                          "<x>",
                                          "{a,b}",
                                          "-n",
                                          "'\n#SBATCH --wrap='touch harm'\n'"};

TEST(Shell, AQuotedTextIsOneWordOfAnyShellWithEveryByteAsItWas) {
  const TemporaryFolder folder("shell");
  for (const char* interpreter : {"/bin/bash", "/bin/sh"}) {
    std::string script = "printf '%s\\0'", wanted;
    for (const std::string& text : hostile) {
      script += " " + shell_quoted(text);
      wanted += text + '\0';
    }
    write_file(folder.path / "script", script + " > words\n");
    ProcessRequest request;
    request.arguments = {interpreter, "script"};
    request.working_folder = folder.path;
    EXPECT_TRUE(run_process(request).succeeded());
    EXPECT_EQ(read_file(folder.path / "words"), wanted) << interpreter;
    EXPECT_FALSE(std::filesystem::exists(folder.path / "harm"));
  }
}

TEST(Shell, ANulByteIsRefused) {
  EXPECT_THROW(shell_quoted(std::string("a\0b", 3)), Error);
}

TEST(Shell, APlainNameNeedsNoQuotes) {
  for (const std::string& text : hostile)
    for (const char c : plain_name(text))
      EXPECT_TRUE(std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '_' ||
                  c == '+');
  EXPECT_EQ(plain_name("Stratos IV, 30 m/s"), "Stratos-IV-30-m-s");
  EXPECT_EQ(plain_name(std::string(200, 'a')).size(), 80u);
}

}  // namespace
}  // namespace ripstop
