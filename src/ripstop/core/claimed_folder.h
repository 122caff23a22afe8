// A folder that one process at a time uses, with a list of the files that Ripstop wrote into it.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ripstop {

/// The folder keeps its records in `.ripstop/`: `lock` (the process that uses it), `files` (the files written
/// by Ripstop, one line per name with the hash of the line), notes, and `kept`, the hashes of files during a
/// run, or `seal`, those of a finished run.
class ClaimedFolder {
 public:
  using LockCall = int (*)(int descriptor, int operation);  // flock()

  /// Makes the folder if necessary and locks it for the life of this object or its process. Removes temporary
  /// files of a killed process; lost parts of the list are restored from the seal or the record of keep().
  /// Throws Error(usage) that names the process with the lock, Error(io). On a file system without locks the
  /// folder is used unlocked, and warning() states this.
  explicit ClaimedFolder(std::filesystem::path folder);
  /// With another call in place of flock().
  ClaimedFolder(std::filesystem::path folder, LockCall lock);
  ~ClaimedFolder();
  ClaimedFolder(const ClaimedFolder&) = delete;
  ClaimedFolder& operator=(const ClaimedFolder&) = delete;

  const std::filesystem::path& path() const { return folder_; }
  /// Empty where the folder is locked.
  const std::string& warning() const { return warning_; }

  /// Where Ripstop writes `name`, which is on the list when this returns. A name that ends in '/' is a folder all
  /// of whose files are Ripstop's; one that was there already is not taken. Throws Error(usage) for such a one and
  /// for a file that is there and not on the list, Error(io).
  std::filesystem::path own(const std::string& name);
  /// Names on the list, in its order.
  const std::vector<std::string>& names() const { return names_; }

  /// Removes all that is on the list, and folders that are then empty; everything else stays. Throws Error(io).
  void clear();

  /// Declares that all files on the list, except folders with '/', have the state from which the run resumes;
  /// their hashes are in `.ripstop/kept` when this returns. own() of a file releases it before it is written
  /// again. Throws Error(io).
  void keep();
  /// Names of files that are lost or changed since keep().
  std::vector<std::string> lost() const;

  /// A sealed note about the folder, kept next to the list. Throws Error(io).
  void note(const std::string& name, const std::string& text) const;
  /// Seals the list and the contents of all files on it, folders with '/' left out: the work here is
  /// done. Throws Error(io).
  void seal() const;
  /// The work continues. Throws Error(io).
  void unseal() const;

 private:
  void add(const std::string& name);
  void drop_leftovers() const;

  std::filesystem::path folder_;
  int lock_ = -1;
  std::string warning_;
  std::vector<std::string> names_;
  std::map<std::string, std::string> kept_;  // name -> hash of the content
};

/// Makes a folder for the results of a `command` that is no run, and checks that files can be written there. Throws
/// Error(usage) where a run or another command has written, whose files would be replaced, Error(io).
void make_results_folder(const std::filesystem::path& folder, const std::string& command);
/// Throws the same error as ClaimedFolder if another process uses the folder; creates nothing.
void require_unclaimed(const std::filesystem::path& folder);
/// Text of note(). Throws Error(bad_data) when it is damaged.
std::optional<std::string> noted(const std::filesystem::path& folder, const std::string& name);
/// Whether seal() was the last word.
bool is_sealed(const std::filesystem::path& folder);
/// Names of files that are lost or changed since seal(). Throws Error(bad_data) when the seal itself is.
std::vector<std::string> damaged_files(const std::filesystem::path& folder);
/// Names in a folder other than the files and records of Ripstop; empty if the folder does not exist. Throws
/// Error(io).
std::vector<std::string> foreign_files(const std::filesystem::path& folder);

}  // namespace ripstop
