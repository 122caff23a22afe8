// Reasons of failures that other libraries report, in the words of this program.
#pragma once

#include <exception>
#include <filesystem>
#include <string>

namespace ripstop {

/// Of a JSON library: "[json.exception.out_of_range.403] key 'drag_n' not found" without the name of the exception.
inline std::string json_reason(const std::exception& error) {
  const std::string text = error.what();
  const std::size_t end = text.starts_with('[') ? text.find("] ") : std::string::npos;
  return end == std::string::npos ? text : text.substr(end + 2);
}

/// "PATH: Permission denied; check the path, its permissions and the free space"
inline std::string file_reason(const std::filesystem::filesystem_error& error) {
  return error.path1().string() + ": " + error.code().message() +
         "; check the path, its permissions and the free space";
}

}  // namespace ripstop
