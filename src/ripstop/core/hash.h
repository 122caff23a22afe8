// Content hashes that identify inputs, and files and folders that notice when they were damaged.
//
// The hash is XXH3 with 128 bits (xxHash, Y. Collet): it finds damage, not forgery.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace ripstop {

std::string hash_bytes(std::string_view bytes);  // 32 lower-case hexadecimal digits
/// Throws Error(io).
std::string hash_file(const std::filesystem::path& path);
/// Of the names (relative, sorted) and contents of all files below `folder`: the same for a copy elsewhere.
/// Throws Error(io), also for anything that is neither file nor folder.
std::string hash_folder(const std::filesystem::path& folder);

/// `bytes` under a first line with their size and hash, written in one step. Throws Error(io).
void write_sealed(const std::filesystem::path& path, std::string_view bytes);
/// The same for the bytes of these pieces, one after the other, without a copy of them.
void write_sealed(const std::filesystem::path& path, std::span<const std::string_view> pieces);
/// The bytes given to write_sealed(). Throws Error(bad_data) if one of them, or the
/// seal, was lost or changed.
std::string read_sealed(const std::filesystem::path& path);

/// Name of the list of sizes and hashes that seal_folder() leaves in a folder.
inline constexpr const char* seal_name = "contents.seal";
/// Lists every file below `folder`; write it last, then the folder is complete. Throws Error(io).
void seal_folder(const std::filesystem::path& folder);
/// Throws Error(bad_data) naming the file that is missing, new or changed since
/// seal_folder(), or the missing seal.
void check_folder(const std::filesystem::path& folder);

}  // namespace ripstop
