// Every listed struct as JSON and back, for the files of run/: results as text, checkpoints as CBOR. Only for
// sources; public headers contain no JSON library.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>

#include "ripstop/core/error.h"
#include "ripstop/core/members.h"
#include "ripstop/core/reasons.h"
#include "ripstop/core/vec3.h"

namespace ripstop::inline run::detail {
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
}  // namespace ripstop::inline run::detail

template <>
struct nlohmann::adl_serializer<ripstop::Vec3> {
  template <class Json>
  static void to_json(Json& j, const ripstop::Vec3& v) {
    j = {v.x, v.y, v.z};
  }
  template <class Json>
  static void from_json(const Json& j, ripstop::Vec3& v) {
    v = {j.at(0).template get<double>(), j.at(1).template get<double>(), j.at(2).template get<double>()};
  }
};

template <ripstop::Listed T>
struct nlohmann::adl_serializer<T> {
  template <class Json>
  static void to_json(Json& j, const T& value) {
    j = Json::object();
    each_member(value, [&](const char* name, const auto& member, [[maybe_unused]] auto... how) {
      if constexpr (!ripstop::detail::is_optional<std::decay_t<decltype(member)>>) {
        j[name] = member;
      } else if (member) {
        j[name] = *member;
      } else if constexpr ((std::is_same_v<decltype(how), ripstop::OrNull> || ...)) {
        j[name] = nullptr;
      }
    });
  }
  template <class Json>
  static void from_json(const Json& j, T& value) {
    each_member(value, [&](const char* name, auto& member, auto&&...) {
      using Member = std::decay_t<decltype(member)>;
      if constexpr (!ripstop::detail::is_optional<Member>) {
        j.at(name).get_to(member);
      } else if (j.contains(name) && !j.at(name).is_null()) {
        member = j.at(name).template get<typename Member::value_type>();
      }
    });
  }
};

namespace ripstop::inline run {

/// Where a case as JSON has the value of a key: "flow.core.size_m" is /flow/core/size_m.
inline nlohmann::ordered_json::json_pointer pointer_of(const std::string& key) {
  std::string pointer = "/" + key;
  std::replace(pointer.begin(), pointer.end(), '.', '/');
  return nlohmann::ordered_json::json_pointer(pointer);
}

/// A result.json.
template <Listed T>
std::string json_text(const T& result) {
  return nlohmann::ordered_json(result).dump(2) + "\n";
}
/// Throws Error(bad_data) for a text that lacks a member; `what` is the name of the expected object.
template <Listed T>
T from_json_text(const std::string& text, const char* what) {
  try {
    return nlohmann::json::parse(text).get<T>();
  } catch (const nlohmann::json::exception& error) {
    throw Error(ExitCode::bad_data, fmt::format("not {}: {}; the file is damaged or of another version", what,
                                                json_reason(error)));
  }
}

/// Every double bit for bit. `format` is the number of the list's version.
template <Listed T>
std::string to_cbor(const T& state, int format) {
  nlohmann::json j = state;
  j["format"] = format;
  const std::vector<std::uint8_t> bytes = nlohmann::json::to_cbor(j);
  return {bytes.begin(), bytes.end()};
}
/// Throws Error(bad_data) for anything that to_cbor() of this format did not write.
template <Listed T>
T from_cbor(const std::string& bytes, int format, const char* what) {
  try {
    const nlohmann::json j = nlohmann::json::from_cbor(bytes);
    if (j.at("format") != format)
      throw Error(ExitCode::bad_data, fmt::format("{} of a different version of Ripstop; compute the run "
                                                  "again: the command that made it, with --fresh",
                                                  what));
    return j.get<T>();
  } catch (const nlohmann::json::exception& error) {
    throw Error(ExitCode::bad_data, fmt::format("not {}: {}; the file is damaged or of another version", what,
                                                json_reason(error)));
  }
}

}  // namespace ripstop::inline run
