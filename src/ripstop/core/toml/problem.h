// Mistakes in an input file, one entry each, so that all of them are reported together.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "ripstop/core/error.h"

namespace ripstop {

/// Where a value came from: a place in a file, or an option of the command line.
struct Origin {
  std::string file;
  int line = 0, column = 0;  // counted from 1; 0: no single place
  std::string option;        // "--speed"; empty for a file
};

/// Origin of every key that was given, by its full name ("parachute.lines.count", "flow.cells[2]").
using Origins = std::map<std::string, Origin>;

struct Problem {
  Origin origin;
  std::string key;      // full name; empty for a mistake in the file's syntax
  std::string value;    // as understood; empty when there is none
  std::string allowed;  // "above 0 and at most 200"; empty when that is not a range or a list
  std::string message;  // the mistake and its remedy
};

/// "case.toml:12:9: flow.speed_m_s = -3: must be above 0 and at most 200".
std::string to_text(const Problem& problem);

/// Where checks over several keys report; a key that already has a problem is not looked at again.
class Findings {
 public:
  Findings(const Origins& origins, std::vector<Problem>& problems) : origins_(origins), problems_(problems) {}
  /// Whether no problem is recorded for these keys, their tables, or anything below them. "table.*" means all
  /// keys of a table without those of its tables.
  bool sound(const std::vector<std::string>& keys) const;
  /// At the place of `key`, or of its table when it was not given.
  void add(const std::string& key, std::string value, std::string allowed, std::string message);
  void add(const std::string& key, double value, std::string allowed, std::string message);

 private:
  const Origins& origins_;
  std::vector<Problem>& problems_;
};

/// All problems of one input, sorted by place. The message lists them, one per line.
class InputError : public Error {
 public:
  InputError(ExitCode code, std::vector<Problem> problems);
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// The candidate that a misspelt word most likely means, or "" when none is near.
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace ripstop
