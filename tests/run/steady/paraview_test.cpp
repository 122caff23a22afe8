// examples/paraview/show_run.py without ParaView: VTK finds everything that it would show, and its calls succeed with
// a substitute for paraview.simple that accepts anything.
#include <gtest/gtest.h>

#include "ripstop/core/process.h"
#include "tests/run/steady/finished_run.h"

namespace ripstop {
namespace {

struct Outcome {
  int code = -1;
  std::string output;
};

Outcome python(const std::vector<std::string>& arguments, const std::string& modules = "") {
  Outcome outcome;
  ProcessRequest request;
  request.arguments = {"/usr/bin/python3"};
  request.arguments.insert(request.arguments.end(), arguments.begin(), arguments.end());
  if (!modules.empty()) request.environment = {{"PYTHONPATH", modules}};
  request.time_limit_s = 120;
  request.on_line = [&](const std::string& line) {
    outcome.output += line + "\n";
    return true;
  };
  outcome.code = run_process(request).exit_code;
  return outcome;
}

const std::string script = RIPSTOP_SOURCE_DIR "/examples/paraview/show_run.py";

TEST(ParaView, EverythingThatTheScriptShowsIsInARun) {
  const TemporaryFolder folder("paraview");
  const auto run = folder.path / "run";
  fly_square_law(run);
  const Outcome found = python({script, "--check", run.string()});
  EXPECT_EQ(found.code, 0) << found.output;
  for (const char* part : {"canopy: ", "lines: ", "flow: "})
    EXPECT_NE(found.output.find(part), std::string::npos);

  std::filesystem::create_directories(folder.path / "paraview");
  write_file(folder.path / "paraview" / "__init__.py", "");
  write_file(folder.path / "paraview" / "simple.py", R"(
from unittest.mock import MagicMock
class Anything(MagicMock):
    def GetBounds(self): return (-1, 1, -1, 1, 0, 3)
_all = Anything()
def __getattr__(name):
    def call(*arguments, **keys):
        print(name, [a for a in arguments if isinstance(a, str)], {k: v for k, v in keys.items() if isinstance(v, (str, list))})
        made = Anything()
        made.GetDataInformation.return_value = made
        return made
    return call
)");
  const Outcome shown = python({script, run.string(), "--picture", "x.png"}, folder.path.string());
  EXPECT_EQ(shown.code, 0) << shown.output;
  for (const char* call : {"PVDReader", "StreamTracer", "SaveScreenshot ['x.png']"})
    EXPECT_NE(shown.output.find(call), std::string::npos) << call << "\n" << shown.output;
}

TEST(ParaView, AFolderWithoutARunIsReported) {
  const TemporaryFolder folder("paraview-empty");
  const Outcome outcome = python({script, "--check", folder.path.string()});
  EXPECT_NE(outcome.code, 0);
  EXPECT_NE(outcome.output.find("has no canopy.pvd"), std::string::npos) << outcome.output;
}

}  // namespace
}  // namespace ripstop
