// The XML text of a file of OpenRocket, unpacked in memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace ripstop::inline cases {

inline constexpr std::size_t largest_openrocket_text = std::size_t{64} << 20;

/// Throws Error(io), Error(bad_data) for a damaged archive, one without a design, and for more than `limit` bytes.
std::string openrocket_text_of(const std::filesystem::path& path,
                               std::size_t limit = largest_openrocket_text);

}  // namespace ripstop::inline cases
