#include "ripstop/run/used_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "ripstop/core/error.h"
#include "ripstop/run/quality.h"
#include "ripstop/run/run_folder.h"

namespace ripstop::inline run {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* not_converged_text = "the coupling has not converged";

bool flag(const json& result, const char* key) {
  const auto found = result.find(key);
  return found == result.end() || !found->is_boolean() || found->get<bool>();
}

RunEnd end_of(const json& result, const std::string& name) {
  RunEnd end{name, {}, flag(result, "usable") && flag(result, "converged")};
  if (!flag(result, "converged")) end.texts.emplace_back(not_converged_text);
  // The speed of a payload decreases until the end, so its opening has no steady load.
  if (!flag(result, "settled") && !result.contains("speed_at_end_m_s"))
    end.texts.emplace_back(
        "the load had not settled at the end of the opening; increase inflation.duration_s");
  if (const auto found = result.find("warnings"); found != result.end() && found->is_array())
    for (const json& text : *found)
      if (text.is_string()) end.texts.push_back(text.get<std::string>());
  return end;
}

}  // namespace

std::vector<std::string> RunEnd::warnings() const {
  std::vector<std::string> all;
  if (!usable) all.push_back(fmt::format("{}: the result of this run {} (exit code 4)", name, refused_text));
  for (const std::string& text : texts) all.push_back(fmt::format("{}: {}", name, text));
  return all;
}

RunEnd end_of_run(const std::string& result_json, const std::string& name) {
  const json result = json::parse(result_json, nullptr, false);
  if (!result.is_object()) return {name, {}};
  RunEnd end = end_of(result, name);
  const auto runs = result.find("runs");
  if (runs == result.end() || !runs->is_array()) return end;
  std::vector<RunEnd> parts;
  for (const json& row : *runs)
    if (row.is_object() && row.contains("result"))
      parts.push_back(end_of(row["result"], row.value("folder", std::string())));
  if (end.texts.empty()) end.texts = grouped_warnings(parts);
  for (const RunEnd& part : parts) end.usable = end.usable && part.usable;
  return end;
}

RunEnd end_of_run(const fs::path& folder) {
  return end_of_run(finished_result(folder).value_or(""), folder.string());
}

std::vector<std::string> warnings_if_usable(const RunEnd& end) {
  if (end.usable) return end.warnings();
  std::vector<std::string> reasons;
  for (const std::string& text : end.texts)
    if (text == not_converged_text || !reason_of_refusal(text).empty())
      reasons.push_back(without_refusal(text));
  throw Error(ExitCode::bad_data,
              fmt::format("{}: the result of this run {} (it ended with exit code 4): {}; compute a run "
                          "within its limits of quality (docs/theory/quality.md)",
                          end.name, refused_text, fmt::join(reasons.empty() ? end.texts : reasons, "; ")));
}

std::vector<std::string> warnings_of_used(const std::vector<fs::path>& folders) {
  std::vector<std::string> all;
  for (const fs::path& folder : folders) {
    if (folder.empty()) continue;
    for (std::string& text : warnings_if_usable(end_of_run(folder))) all.push_back(std::move(text));
  }
  return all;
}

std::vector<std::string> warnings_of_shown(const std::vector<fs::path>& folders) {
  std::vector<std::string> all;
  for (const fs::path& folder : folders)
    for (std::string& text : end_of_run(folder).warnings()) all.push_back(std::move(text));
  return all;
}

void add_warnings_of(const RunEnd& end, std::vector<std::string>& warnings) {
  RunEnd others = end;
  std::erase_if(others.texts, [&](const std::string& text) {
    return std::find(warnings.begin(), warnings.end(), text) != warnings.end();
  });
  for (std::string& text : others.warnings()) warnings.push_back(std::move(text));
}

std::vector<std::string> grouped_warnings(const std::vector<RunEnd>& ends) {
  std::vector<std::pair<std::string, std::vector<std::string>>> groups;  // text, names
  const auto add = [&](const std::string& text, const std::string& name) {
    const auto known =
        std::find_if(groups.begin(), groups.end(), [&](const auto& group) { return group.first == text; });
    if (known == groups.end())
      groups.emplace_back(text, std::vector{name});
    else if (known->second.back() != name)
      known->second.push_back(name);
  };
  for (const RunEnd& end : ends) {
    if (!end.usable) add(fmt::format("the result {} (exit code 4)", refused_text), end.name);
    for (const std::string& text : end.texts) add(text, end.name);
  }
  std::vector<std::string> all;
  for (const auto& [text, names] : groups) {
    const bool each = names.size() == ends.size() && names.size() > 1;
    all.push_back(fmt::format(
        "{}: {}", each ? fmt::format("all {} runs", names.size()) : fmt::format("{}", fmt::join(names, ", ")),
        text));
  }
  return all;
}

}  // namespace ripstop::inline run
