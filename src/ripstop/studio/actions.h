// Actions of the page on a folder. Each action is a command of this program in a child process, or a change of a case
// file; answers are JSON for the page's scripts.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/studio/jobs.h"

namespace ripstop {

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
  /// A new case file by `ripstop size`.
  std::string size(const std::string& file, const std::string& family, double mass, double rate,
                   double height);

  /// Shape under a pressure [Pa], empty: the dynamic pressure of the case. Ends an earlier call, whose answer is
  /// empty.
  std::string shape(const std::string& file, const std::string& pressure, const std::string& nodes);
  std::string load(const std::string& file, const std::string& mass, const std::string& speed);
  /// Bill of materials and the pieces as SVG.
  std::string pattern(const std::string& file);

  std::string jobs() const;
  /// `request`: {"command", "case", "name", "options": {"--speed": 20, ...}}.
  void start(const std::string& request);
  void stop(const std::string& name) { queue_.stop(name); }
  void resume(const std::string& name) { queue_.resume(name); }
  std::string log(const std::string& name) const;

  /// "rocketpy" or "openrocket" of a finished steady run, as text.
  std::string exported(const std::string& run, const std::string& format);
  /// DXF, SVG and PDF of the pieces in a new folder; its name.
  std::string export_pattern(const std::string& file);

  /// report.html of a run. Throws Error(usage) if there is none.
  std::string report(const std::string& run) const;

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
  std::string replace(const std::string& file, const std::string& version, const std::string& text);

  std::filesystem::path folder_;
  std::string program_;
  JobQueue queue_;
  std::atomic<unsigned> newest_shape_{0};
  std::mutex writing_;  // of case files
};

/// JSON {"error": ...} of a message.
std::string error_json(const std::string& message);

}  // namespace ripstop
