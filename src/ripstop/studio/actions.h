// Actions of the page on a folder. Each action is a command of this program in a child process, or a change of a case
// file; answers are JSON for the page's scripts.
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/core/error.h"
#include "ripstop/studio/jobs.h"
#include "ripstop/studio/live_shape.h"

namespace ripstop::inline studio {

/// A case file has changed since the page read it.
struct Conflict : Error {
  explicit Conflict(const std::string& message) : Error(ExitCode::usage, message) {}
};

class Actions {
 public:
  /// Throws Error(usage) if `folder` is none, or another server uses it.
  Actions(const std::filesystem::path& folder, std::string program);

  /// Case files and runs of the folder.
  std::string folder();
  /// A case file: text, its values as written, and the report of `ripstop check`.
  std::string read(const std::string& file);
  /// Sets and removes keys: `changes` is an object of JSON values, null for a key to remove. `version` is the hash of
  /// the text that the page has; throws Error(usage) if the file has another.
  std::string change(const std::string& file, const std::string& version, const std::string& changes);
  /// Replaces the whole text, for undo, redo and editing by hand.
  std::string write(const std::string& file, const std::string& version, const std::string& text);
  /// A new case file: a copy of the family's example.
  std::string create(const std::string& file, const std::string& family);
  /// A new case file: a copy of the case `from`.
  std::string copy(const std::string& file, const std::string& from);
  /// A new case file by `ripstop size`.
  std::string size(const std::string& file, const std::string& family, const std::string& mass,
                   const std::string& rate, const std::string& speed, const std::string& height);

  /// Shape of a view under a pressure [Pa], empty: the dynamic pressure of the case; first with at most `nodes` nodes
  /// of cloth. Ends an earlier call of the view.
  std::string shape(const std::string& view, const std::string& file, const std::string& pressure, int nodes);
  /// Of a shape that was not done yet: the next answer of its computation.
  std::string later_shape(const std::string& view, int number);
  /// `drag`: the drag coefficient; empty: that of the family.
  std::string load(const std::string& file, const std::string& mass, const std::string& speed,
                   const std::string& drag);
  /// Bill of materials and the pieces as SVG.
  std::string pattern(const std::string& file);

  std::string jobs() const;
  /// `request`: {"command", "case", "name", "options": {"--speed": 20, ...}}.
  void start(const std::string& request);
  void stop(const std::string& name) { queue_.stop(name); }
  void resume(const std::string& name) { queue_.resume(name); }
  std::string log(const std::string& name) const;

  /// Plots of the tables that a run has written so far, and its last shape unless that is `known`.
  std::string progress(const std::string& name, const std::string& known) const;

  /// A material from tensile records by `ripstop fit`. `request`: {"bench": {key: value}, "records": [{"name", "base64",
  /// key: value}], "coupons", "save"}. With "save" campaign and material remain in materials/NAME.
  std::string fit(const std::string& request) const;

  /// Of a run as text: "rocketpy", "openrocket" and "json" of a finished steady one, "report", "toml".
  std::string exported(const std::string& run, const std::string& format);
  /// DXF, SVG and PDF of the pieces in a new folder; its name.
  std::string export_pattern(const std::string& file);

  /// report.html of a run, or the comparison of several. Throws Error(usage) if there is none.
  std::string report(const std::vector<std::string>& runs) const;

 private:
  struct Call {
    int code = 0;
    std::string output;
  };
  Call call(std::vector<std::string> arguments, const std::function<bool()>& keep_going = {}) const;
  /// A call whose failure is an Error with its message.
  void must(std::vector<std::string> arguments) const;
  std::filesystem::path case_path(const std::string& file) const;
  std::filesystem::path new_case_path(const std::string& file) const;
  std::filesystem::path run_path(const std::string& run) const;
  std::vector<std::string> arguments_of(const std::string& command, const std::string& options) const;
  std::filesystem::path report_path(const std::string& run) const;
  /// Throws Error(usage) for a path that leaves the folder, as by a symbolic link.
  void require_inside(const std::filesystem::path& path) const;
  std::string replace(const std::string& file, const std::string& version, const std::string& text);

  std::filesystem::path folder_;
  std::string program_;
  JobQueue queue_;
  LiveShapes shapes_;
  std::mutex writing_;  // of case files
};

/// JSON of a request. Throws Error(usage).
nlohmann::ordered_json parsed(const std::string& text);
/// Throws Error(usage) for a text that is no name of a file or run.
void require_name(const std::string& name);

/// JSON {"error": ...} of a message.
std::string error_json(const std::string& message);

}  // namespace ripstop::inline studio
