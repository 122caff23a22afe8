// Whole files, read and written so that nobody ever sees half of one.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace ripstop {

/// Replaces `path` by `bytes` in one step: a temporary file in the same folder, fsync, rename, fsync of the folder. A
/// reader of `path` finds the old or the new content, also after a kill or a power failure. Temporary files for
/// `path` of killed processes are removed. Throws Error(io) with the path and the system's reason; the old file is
/// then untouched.
void write_file(const std::filesystem::path& path, std::string_view bytes);
/// The same for the bytes of these pieces, one after the other.
void write_file(const std::filesystem::path& path, std::span<const std::string_view> pieces);

/// NAME for ".NAME.PID-N.tmp", the form of the temporary files of write_file(); else nothing.
std::string written_as(const std::string& file);

/// The whole file. Throws Error(io).
std::string read_file(const std::filesystem::path& path);

/// Creates the folder and those above it; it may exist. Throws Error(io).
void make_folder(const std::filesystem::path& folder);

/// Removes a file, or a folder with its content; it need not exist. Throws Error(io).
void remove_path(const std::filesystem::path& path);

/// Adds `bytes` at the end of a file, which is created if need be, and waits until they are on the disk. A
/// kill may leave a part of them: for formats that can drop a broken tail. Throws Error(io).
void append_to_file(const std::filesystem::path& path, std::string_view bytes);

/// A new folder where the system keeps such, removed with all that is in it.
struct TemporaryFolder {
  std::filesystem::path path;

  /// Throws Error(io).
  explicit TemporaryFolder(const std::string& name);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
};

}  // namespace ripstop
