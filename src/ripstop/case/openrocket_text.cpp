#include "ripstop/case/openrocket_text.h"

#include <fmt/format.h>
#include <minizip/unzip.h>
#include <zlib.h>

#include <array>
#include <memory>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"

namespace ripstop::inline cases {
namespace {

[[noreturn]] void refuse_archive(const std::filesystem::path& path, const std::string& reason) {
  throw Error(ExitCode::bad_data, fmt::format("{}: {}", path.string(), reason));
}

/// Calls `read(buffer, size)` until it returns 0; a negative value means damaged data.
template <class Read>
std::string unpack(const std::filesystem::path& path, std::size_t limit, const Read& read) {
  std::string text;
  std::array<char, 1 << 16> buffer;
  while (true) {
    const int count = read(buffer.data(), static_cast<unsigned>(buffer.size()));
    if (count < 0) refuse_archive(path, "the compressed data are damaged");
    if (count == 0) return text;
    if (text.size() + static_cast<std::size_t>(count) > limit)
      refuse_archive(
          path, fmt::format("unpacks to more than {} MiB; a design of OpenRocket is smaller", limit >> 20));
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

/// Makes the design the current entry: rocket.ork, else the first entry of that kind.
bool find_design(unzFile archive) {
  constexpr int any_case = 2;
  if (unzLocateFile(archive, "rocket.ork", any_case) == UNZ_OK) return true;
  std::array<char, 256> name;
  unz_file_info info;  // required: minizip 1.1 writes to it
  for (int found = unzGoToFirstFile(archive); found == UNZ_OK; found = unzGoToNextFile(archive)) {
    if (unzGetCurrentFileInfo(archive, &info, name.data(), name.size(), nullptr, 0, nullptr, 0) != UNZ_OK)
      return false;
    name.back() = 0;
    if (std::string(name.data()).ends_with(".ork")) return true;
  }
  return false;
}

std::string unzip(const std::filesystem::path& path, std::size_t limit) {
  const std::unique_ptr<void, int (*)(unzFile)> archive(unzOpen64(path.c_str()), unzClose);
  if (!archive) refuse_archive(path, "the ZIP archive is damaged");
  if (!find_design(archive.get())) refuse_archive(path, "the ZIP archive has no entry rocket.ork");
  if (unzOpenCurrentFile(archive.get()) != UNZ_OK)
    refuse_archive(path, "the entry rocket.ork cannot be unpacked: it is damaged or encrypted");
  std::string text = unpack(path, limit, [&](char* buffer, unsigned size) {
    return unzReadCurrentFile(archive.get(), buffer, size);
  });
  if (unzCloseCurrentFile(archive.get()) != UNZ_OK)
    refuse_archive(path, "the entry rocket.ork is damaged: its checksum does not agree");
  return text;
}

std::string gunzip(const std::filesystem::path& path, std::size_t limit) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), gzclose);
  if (!file) refuse_archive(path, "cannot be opened");
  return unpack(path, limit, [&](char* buffer, unsigned size) { return gzread(file.get(), buffer, size); });
}

}  // namespace

std::string openrocket_text_of(const std::filesystem::path& path, std::size_t limit) {
  std::error_code unknown;
  const auto size = std::filesystem::file_size(path, unknown);
  if (!unknown && size > limit)
    refuse_archive(path, fmt::format("has more than {} MiB; a design of OpenRocket is smaller", limit >> 20));
  std::string bytes = read_file(path);
  if (bytes.starts_with("PK\x03\x04")) return unzip(path, limit);
  if (bytes.starts_with("\x1f\x8b")) return gunzip(path, limit);
  return bytes;
}

}  // namespace ripstop::inline cases
