#include "ripstop/core/hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <map>
#include <memory>
#include <new>
#include <sstream>
#include <vector>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"

namespace ripstop {
namespace {

constexpr const char* damage_advice = "; it is damaged or incomplete: delete it and use an older one";

std::string hash_pieces(std::span<const std::string_view> pieces) {
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), XXH3_freeState);
  if (!state) throw std::bad_alloc();
  XXH3_128bits_reset(state.get());
  for (const std::string_view piece : pieces) XXH3_128bits_update(state.get(), piece.data(), piece.size());
  const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string seal_line(std::span<const std::string_view> pieces) {
  std::size_t size = 0;
  for (const std::string_view piece : pieces) size += piece.size();
  return fmt::format("ripstop sealed file 1, {} bytes, xxh3-128 {}\n", size, hash_pieces(pieces));
}

/// Relative name -> hash, of every file below `folder` but the seal.
std::map<std::string, std::string> contents(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  std::error_code error;
  auto entry = std::filesystem::recursive_directory_iterator(folder, error);
  for (; !error && entry != std::filesystem::recursive_directory_iterator(); entry.increment(error)) {
    if (entry->is_directory()) continue;
    if (!entry->is_regular_file()) {
      throw Error(ExitCode::io, fmt::format("{} is neither a file nor a folder", entry->path().string()));
    }
    const std::string name = entry->path().lexically_relative(folder).generic_string();
    if (name != seal_name) files[name] = hash_file(entry->path());
  }
  if (error) {
    throw Error(ExitCode::io, fmt::format("cannot list folder {}: {}", folder.string(), error.message()));
  }
  return files;
}

/// One line a file, "hash name". A line break inside a name is escaped so that the list stays unambiguous.
std::string list(const std::map<std::string, std::string>& files) {
  std::string text;
  for (const auto& [name, hash] : files) {
    text += hash + ' ';
    for (char c : name) {
      if (c == '\n') {
        text += "\\n";
      } else {
        text += (c == '\\') ? std::string("\\\\") : std::string(1, c);
      }
    }
    text += '\n';
  }
  return text;
}

/// The names in list()'s text that `other` does not hold with the same hash.
std::string first_difference(const std::string& text, const std::string& other) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (("\n" + other).find("\n" + line + "\n") == std::string::npos) return line.substr(33);
  }
  return {};
}

}  // namespace

std::string hash_bytes(std::string_view bytes) {
  return hash_pieces(std::span(&bytes, 1));
}

std::string hash_file(const std::filesystem::path& path) {
  return hash_bytes(read_file(path));
}

std::string hash_folder(const std::filesystem::path& folder) {
  return hash_bytes(list(contents(folder)));
}

void write_sealed(const std::filesystem::path& path, std::string_view bytes) {
  write_sealed(path, std::span(&bytes, 1));
}

void write_sealed(const std::filesystem::path& path, std::span<const std::string_view> pieces) {
  const std::string seal = seal_line(pieces);
  std::vector<std::string_view> all{seal};
  all.insert(all.end(), pieces.begin(), pieces.end());
  write_file(path, all);
}

std::string read_sealed(const std::filesystem::path& path) {
  std::string text = read_file(path);
  const size_t end = text.find('\n');
  if (end != std::string::npos) {
    const std::string_view bytes = std::string_view(text).substr(end + 1);
    if (text.compare(0, end + 1, seal_line(std::span(&bytes, 1))) == 0) return text.erase(0, end + 1);
  }
  throw Error(ExitCode::bad_data, fmt::format("{} does not match its seal{}", path.string(), damage_advice));
}

void seal_folder(const std::filesystem::path& folder) {
  write_sealed(folder / seal_name, list(contents(folder)));
}

void check_folder(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (!std::filesystem::exists(folder / seal_name, ignored)) {
    throw Error(ExitCode::bad_data, fmt::format("{} has no {}{}", folder.string(), seal_name, damage_advice));
  }
  const std::string sealed = read_sealed(folder / seal_name);
  const std::string present = list(contents(folder));
  if (sealed == present) return;
  std::string name = first_difference(sealed, present);
  if (name.empty()) name = first_difference(present, sealed);
  throw Error(ExitCode::bad_data,
              fmt::format("{}: {} is missing, new or changed after the folder was sealed{}", folder.string(),
                          name, damage_advice));
}

}  // namespace ripstop
