#include "ripstop/core/claimed_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

constexpr const char* records = ".ripstop";
constexpr const char* results_of = ".ripstop-command";  // the command that wrote the results
constexpr const char* released = "released";  // instead of the hash of a file that will be written again

fs::path lock_of(const fs::path& folder) {
  return folder / records / "lock";
}
fs::path list_of(const fs::path& folder) {
  return folder / records / "files";
}
fs::path seal_of(const fs::path& folder) {
  return folder / records / "seal";
}

std::string host_name() {
  char name[256] = "";
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "unknown host";
}

fs::path kept_of(const fs::path& folder) {
  return folder / records / "kept";
}

std::string line_of(const std::string& text) {
  return hash_bytes(text) + ' ' + text + '\n';
}

// Lines whose hash does not fit, as the last one after a kill, prove nothing and are left out.
std::vector<std::string> lines_of(const fs::path& file) {
  std::vector<std::string> texts;
  if (!fs::exists(file)) return texts;
  std::istringstream lines(read_file(file));
  for (std::string line; std::getline(lines, line);) {
    if (line.size() > 33 && line.substr(0, 32) == hash_bytes(line.substr(33)))
      texts.push_back(line.substr(33));
  }
  return texts;
}

// A line appended after an incomplete line would be lost with it.
void drop_broken_lines(const fs::path& file) {
  if (!fs::exists(file)) return;
  std::string whole;
  for (const std::string& text : lines_of(file)) whole += line_of(text);
  if (whole != read_file(file)) write_file(file, whole);
}

std::vector<std::string> listed(const fs::path& folder) {
  return lines_of(list_of(folder));
}

bool is_folder_name(const std::string& name) {
  return name.ends_with('/');
}

/// Whether one of the names is `name`, or a folder above it.
bool covers(const std::vector<std::string>& names, const std::string& name) {
  return std::any_of(names.begin(), names.end(), [&](const std::string& own) {
    return own == name || (is_folder_name(own) && name.starts_with(own));
  });
}

/// Hashes by the seal of all names on the list, in its order; empty for folders and for files that were not
/// written.
nlohmann::ordered_json sealed_contents(const fs::path& folder) {
  auto contents = nlohmann::ordered_json::parse(read_sealed(seal_of(folder)), nullptr, false);
  if (!contents.is_object())
    throw Error(ExitCode::bad_data, fmt::format("{}: is not a seal of Ripstop", seal_of(folder).string()));
  return contents;
}

/// The seal of a finished folder also contains the list: lost lines are restored from it.
std::vector<std::string> listed_or_sealed(const fs::path& folder) {
  const std::vector<std::string> names = listed(folder);
  if (!is_sealed(folder)) return names;
  std::vector<std::string> whole;
  try {
    const auto contents = sealed_contents(folder);
    for (const auto& [name, hash] : contents.items()) whole.push_back(name);
  } catch (const Error&) {  // reported by the function that checks for damage
    return names;
  }
  if (std::all_of(whole.begin(), whole.end(), [&](const auto& name) { return covers(names, name); }))
    return names;
  for (const std::string& name : names)
    if (!covers(whole, name)) whole.push_back(name);
  std::string lines;
  for (const std::string& name : whole) lines += line_of(name);
  write_file(list_of(folder), lines);
  return whole;
}

/// Files below the folder by their relative names, but for Ripstop's records.
std::vector<std::string> files_below(const fs::path& folder) {
  std::vector<std::string> files;
  std::error_code error;
  fs::recursive_directory_iterator entry(folder, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().lexically_relative(folder).generic_string();
    if (name == records) {
      entry.disable_recursion_pending();
    } else if (!entry->is_directory() || entry->is_symlink()) {
      files.push_back(name);
    }
  }
  if (error) {
    throw Error(ExitCode::io, fmt::format("cannot list folder {}: {}", folder.string(), error.message()));
  }
  return files;
}

/// Temporary files that write_file() had not yet renamed.
bool is_leftover(const std::vector<std::string>& names, const std::string& file) {
  const fs::path path = file;
  const std::string target = written_as(path.filename());
  return !target.empty() && covers(names, (path.parent_path() / target).generic_string());
}

/// Lustre without its flock option, NFS without a lock service, some FUSE file systems.
bool has_no_locks(int reason) {
  return reason == ENOLCK || reason == ENOSYS || reason == EOPNOTSUPP;
}

[[noreturn]] void refuse_claimed(const fs::path& folder) {
  std::string holder = read_file(lock_of(folder));
  if (!holder.empty() && holder.back() == '\n') holder.pop_back();
  throw Error(ExitCode::usage,
              fmt::format("{}: {} is using this folder; wait until it ends, or choose another --out",
                          folder.string(), holder.empty() ? "another run" : holder));
}

}  // namespace

ClaimedFolder::ClaimedFolder(fs::path folder) : ClaimedFolder(std::move(folder), ::flock) {}

ClaimedFolder::ClaimedFolder(fs::path folder, LockCall lock) : folder_(std::move(folder)) {
  make_folder(folder_);
  make_folder(folder_ / records);
  lock_ = ::open(lock_of(folder_).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock_ < 0) {
    throw Error(ExitCode::io, fmt::format("cannot write {}: {}", lock_of(folder_).string(),
                                          std::generic_category().message(errno)));
  }
  if (const int reason = lock(lock_, LOCK_EX | LOCK_NB) == 0 ? 0 : errno; has_no_locks(reason)) {
    warning_ = fmt::format(
        "{}: cannot be locked, because its file system does not support locks ({}); make sure that no other "
        "run uses this folder",
        folder_.string(), std::generic_category().message(reason));
  } else if (reason != 0) {
    ::close(lock_);
    if (reason != EWOULDBLOCK) {
      throw Error(ExitCode::io, fmt::format("cannot lock {}: {}", lock_of(folder_).string(),
                                            std::generic_category().message(reason)));
    }
    refuse_claimed(folder_);
  }
  const std::string text = fmt::format("process {} on {}\n", ::getpid(), host_name());
  if (::ftruncate(lock_, 0) != 0 || ::pwrite(lock_, text.data(), text.size(), 0) < 0) {
    ::close(lock_);
    throw Error(ExitCode::io, fmt::format("cannot write {}: {}", lock_of(folder_).string(),
                                          std::generic_category().message(errno)));
  }
  drop_broken_lines(list_of(folder_));
  names_ = listed_or_sealed(folder_);
  if (is_sealed(folder_)) {
    remove_path(kept_of(folder_));  // the seal has taken its place
  } else {
    drop_broken_lines(kept_of(folder_));
    for (const std::string& line : lines_of(kept_of(folder_)))
      kept_[line.substr(line.find(' ') + 1)] = line.substr(0, line.find(' '));
    for (const auto& [name, hash] : kept_)
      if (!covers(names_, name)) add(name);  // its line was lost
    std::erase_if(kept_, [](const auto& entry) { return entry.second == released; });
  }
  drop_leftovers();
}

void make_results_folder(const fs::path& folder, const std::string& command) {
  const std::vector<std::string> files = listed(folder);
  if (!files.empty())
    throw Error(
        ExitCode::usage,
        fmt::format("{}: contains a run with {} files, which must not be changed; choose another --out",
                    folder.string(), files.size()));
  const fs::path written_by = folder / results_of;
  if (const std::string other = fs::is_regular_file(written_by) ? read_file(written_by) : command;
      other != command && fs::exists(folder / "result.json"))
    throw Error(ExitCode::usage, fmt::format("{}: contains results of ripstop {}, which ripstop {} would "
                                             "replace; choose another --out",
                                             folder.string(), other, command));
  make_folder(folder);
  write_file(written_by, command);
}

void require_unclaimed(const fs::path& folder) {
  const int lock = ::open(lock_of(folder).c_str(), O_RDWR | O_CLOEXEC);
  if (lock < 0) return;  // the folder was not used before, or the claim below reports why it cannot be read
  const bool held = ::flock(lock, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(lock);
  if (held) refuse_claimed(folder);
}

ClaimedFolder::~ClaimedFolder() {
  if (lock_ >= 0) ::close(lock_);
}

fs::path ClaimedFolder::own(const std::string& name) {
  const fs::path path = folder_ / name;
  if (kept_.erase(name)) append_to_file(kept_of(folder_), line_of(std::string(released) + ' ' + name));
  if (covers(names_, name)) return path;
  if (fs::exists(path)) {
    throw Error(
        ExitCode::usage,
        fmt::format("{}: exists and was not written by Ripstop; choose another --out", path.string()));
  }
  add(name);
  return path;
}

void ClaimedFolder::add(const std::string& name) {
  append_to_file(list_of(folder_), line_of(name));
  names_.push_back(name);
}

void ClaimedFolder::clear() {
  remove_path(
      seal_of(folder_));  // first, so that a folder which is only partly removed does not count as finished
  for (const std::string& name : names_) {
    remove_path(folder_ / name);
    std::error_code full;  // a folder with anything else in it stays
    for (fs::path above = fs::path(name).parent_path(); !above.empty(); above = above.parent_path())
      if (!fs::remove(folder_ / above, full)) break;
  }
  for (const fs::directory_entry& record : fs::directory_iterator(folder_ / records))
    if (record.path() != lock_of(folder_)) remove_path(record.path());
  names_.clear();
  kept_.clear();
}

void ClaimedFolder::keep() {
  std::string lines;
  for (const std::string& name : names_) {
    if (is_folder_name(name) || kept_.contains(name) || !fs::exists(folder_ / name)) continue;
    kept_[name] = hash_file(folder_ / name);
    lines += line_of(kept_[name] + ' ' + name);
  }
  if (!lines.empty()) append_to_file(kept_of(folder_), lines);
}

std::vector<std::string> ClaimedFolder::lost() const {
  std::vector<std::string> names;
  for (const auto& [name, hash] : kept_)
    if (!fs::exists(folder_ / name) || hash_file(folder_ / name) != hash) names.push_back(name);
  return names;
}

void ClaimedFolder::seal() const {
  nlohmann::ordered_json contents = nlohmann::ordered_json::object();
  for (const std::string& name : names_) {
    auto& hash = contents[name];
    if (!is_folder_name(name) && fs::exists(folder_ / name)) hash = hash_file(folder_ / name);
  }
  write_sealed(seal_of(folder_), contents.dump(2) + "\n");
  remove_path(kept_of(folder_));
}

void ClaimedFolder::unseal() const {
  remove_path(seal_of(folder_));
}

void ClaimedFolder::note(const std::string& name, const std::string& text) const {
  write_sealed(folder_ / records / name, text);
}

void ClaimedFolder::drop_leftovers() const {
  for (const std::string& file : files_below(folder_)) {
    if (is_leftover(names_, file)) remove_path(folder_ / file);
  }
}

std::optional<std::string> noted(const fs::path& folder, const std::string& name) {
  const fs::path file = folder / records / name;
  if (!fs::exists(file)) return std::nullopt;
  return read_sealed(file);
}

bool is_sealed(const fs::path& folder) {
  return fs::exists(seal_of(folder));
}

std::vector<std::string> damaged_files(const fs::path& folder) {
  const auto contents = sealed_contents(folder);
  std::vector<std::string> names;
  for (const auto& [name, hash] : contents.items()) {
    if (hash.is_null()) continue;
    if (!fs::exists(folder / name) || hash != nlohmann::ordered_json(hash_file(folder / name)))
      names.push_back(name);
  }
  return names;
}

std::vector<std::string> foreign_files(const fs::path& folder) {
  if (!fs::exists(folder)) return {};
  const std::vector<std::string> names = listed(folder);
  std::vector<std::string> foreign;
  for (const std::string& file : files_below(folder))
    if (!covers(names, file) && !is_leftover(names, file)) foreign.push_back(file);
  return foreign;
}

}  // namespace ripstop
