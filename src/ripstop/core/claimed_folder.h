// A folder that one process at a time works in, and that knows which of its files Ripstop wrote.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ripstop {

/// The folder keeps its records in `.ripstop/`: `lock` (who works in it), `files` (what Ripstop wrote, one line a
/// name with the line's own hash), notes and `kept`, the hashes of files while it runs, or of a finished run `seal`.
class ClaimedFolder {
 public:
  using LockCall = int (*)(int descriptor, int operation);  // flock()

  /// Makes the folder if need be and locks it for as long as this object, or its process, lives. Removes what
  /// a kill left of files being written; what was lost of the list comes back from the seal or what keep() wrote.
  /// Throws Error(usage) saying who holds it, Error(io). On a file system without locks the folder is used unlocked,
  /// and warning() states this.
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
  /// What is on the list, in its order.
  const std::vector<std::string>& names() const { return names_; }

  /// Removes all that is on the list, and folders that are then empty; everything else stays. Throws Error(io).
  void clear();

  /// All files on the list, folders with '/' left out, are now as the run will find them when it goes on; their
  /// hashes stand in `.ripstop/kept` when this returns. own() of one releases it: it is about to be written
  /// again. Throws Error(io).
  void keep();
  /// Names of files that are lost or changed since keep().
  std::vector<std::string> lost() const;

  /// A sealed word about the folder, kept beside the list. Throws Error(io).
  void note(const std::string& name, const std::string& text) const;
  /// Seals the list and the contents of all files on it, folders with '/' left out: the work here is
  /// done. Throws Error(io).
  void seal() const;
  /// The work goes on. Throws Error(io).
  void unseal() const;

 private:
  void add(const std::string& name);
  void drop_leftovers() const;

  std::filesystem::path folder_;
  int lock_ = -1;
  std::string warning_;
  std::vector<std::string> names_;
  std::map<std::string, std::string> kept_;  // name -> hash of what is in it
};

/// Makes a folder for the results of a command that is no run, and checks that files can be written there. Throws
/// Error(usage) where a run has written, whose files would be replaced, Error(io).
void make_results_folder(const std::filesystem::path& folder);
/// Throws what ClaimedFolder would throw where another process works in the folder; makes nothing.
void require_unclaimed(const std::filesystem::path& folder);
/// What note() left. Throws Error(bad_data) when it is damaged.
std::optional<std::string> noted(const std::filesystem::path& folder, const std::string& name);
/// Whether seal() was the last word.
bool is_sealed(const std::filesystem::path& folder);
/// Names of files that are lost or changed since seal(). Throws Error(bad_data) when the seal itself is.
std::vector<std::string> damaged_files(const std::filesystem::path& folder);
/// What is in a folder beside Ripstop's files and records, by name; nothing where the folder is not
/// there. Throws Error(io).
std::vector<std::string> foreign_files(const std::filesystem::path& folder);

}  // namespace ripstop
