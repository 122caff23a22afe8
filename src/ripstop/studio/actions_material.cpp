// A material from tensile records that the page sends: `ripstop fit` on a campaign made of them.
#include <fmt/format.h>

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/reasons.h"
#include "ripstop/core/toml/read.h"
#include "ripstop/output/csv.h"
#include "ripstop/studio/actions.h"

namespace ripstop::inline studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t most_records = 100;

/// Throws Error(usage) for characters outside of the alphabet of RFC 4648.
std::string decoded(const std::string& base64) {
  static const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned held = 0;
  int bits = 0;
  for (const char c : base64.substr(0, base64.find_last_not_of('=') + 1)) {
    const std::size_t value = alphabet.find(c);
    if (value == std::string::npos) throw Error(ExitCode::usage, "a record is not in base64");
    held = (held << 6 | static_cast<unsigned>(value)) & 0xffff;
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(held >> bits & 0xff);
  }
  return bytes;
}

/// "key = value" of the allowed keys; JSON and TOML write texts and numbers alike.
std::string lines_of(const Json& table, const std::set<std::string>& allowed) {
  std::string text;
  for (const auto& [key, value] : table.items()) {
    if (!allowed.contains(key))
      throw Error(ExitCode::usage, fmt::format("{} is not a key here", quoted(key)));
    if (!value.is_number() && !value.is_string() && !value.is_boolean())
      throw Error(ExitCode::usage, fmt::format("{} needs a number, a text, or yes or no", key));
    text += fmt::format("{} = {}\n", key, value.dump());
  }
  return text;
}

/// Writes bench.toml and its records/ into `folder`. Returns the name of the material.
std::string write_campaign(const Json& request, const fs::path& folder) {
  static const std::set<std::string> bench_keys = {
      "kind",   "name",    "source",  "areal_density_kg_m2", "linear_density_kg_m", "thickness_m", "width_m",
      "degree", "columns", "decimal", "single_samples",      "shear_fraction"};
  static const std::set<std::string> record_keys = {"orientation_deg", "length_m", "width_m", "specimen"};
  const Json& bench = request.at("bench");
  const std::string name = bench.at("name");
  require_name(name);
  std::string text = lines_of(bench, bench_keys);
  const Json& records = request.at("records");
  if (!records.is_array() || records.empty() || records.size() > most_records)
    throw Error(ExitCode::usage, fmt::format("a campaign has 1 to {} records", most_records));
  make_folder(folder / "records");
  std::set<std::string> names;
  for (Json record : records) {
    const std::string file = record.at("name");
    require_name(file);
    if (!names.insert(file).second)
      throw Error(ExitCode::usage, fmt::format("there are two records with the name {}", file));
    write_file(folder / "records" / file, decoded(record.at("base64").get<std::string>()));
    record.erase("name");
    record.erase("base64");
    text += fmt::format("\n[[coupon]]\nfile = \"records/{}\"\n{}", file, lines_of(record, record_keys));
  }
  if (request.contains("cfm"))
    text +=
        fmt::format("\n[[flow]]\npressure_pa = 124.5\n{}", lines_of({{"cfm", request.at("cfm")}}, {"cfm"}));
  write_file(folder / "bench.toml", text);
  return name;
}

Json curve_of(const fs::path& file) {
  const CsvTable table = read_csv(file);
  Json columns;
  for (const std::string& column : table.columns) columns[column] = table.column(column);
  return columns;
}

}  // namespace

std::string Actions::fit(const std::string& request) const {
  const Json j = parsed(request);
  const TemporaryFolder work("ripstop-studio");
  try {
    const std::string name = write_campaign(j, work.path / "campaign");
    const bool save = j.value("save", false);
    const fs::path kept = folder_ / "materials", file = kept / (name + ".toml"), campaign = kept / name;
    if (save)
      for (const fs::path& path : {file, campaign})
        if (fs::exists(fs::symlink_status(path)))
          throw Error(ExitCode::usage, fmt::format("{} exists already; take another name", path.string()));
    require_inside(kept);
    const fs::path out = work.path / "fit";
    std::vector<std::string> arguments = {"fit", (work.path / "campaign/bench.toml").string(),
                                          "--out=" + out.string()};
    if (!j.value("coupons", true)) arguments.push_back("--no-coupons");
    must(arguments);
    Json answer = {{"result", parsed(read_file(out / "result.json"))}, {"curves", Json::object()}};
    for (const Json& direction : answer["result"]["directions"]) {
      const std::string of = direction.at("name");
      answer["curves"][of] = curve_of(out / fmt::format("curve-{}.csv", of));
    }
    const std::string material = read_file(out / (name + ".toml"));
    answer["material"] = material;
    if (save) {
      make_folder(campaign / "records");
      fs::copy(work.path / "campaign", campaign, fs::copy_options::recursive);
      write_file(file, material);
      answer["saved"] = "materials/" + name + ".toml";
    }
    return answer.dump(-1, ' ', true, Json::error_handler_t::replace);
  } catch (const Json::exception& error) {
    throw Error(ExitCode::usage, fmt::format("no request of a fit: {}", error.what()));
  } catch (const fs::filesystem_error& error) {
    throw Error(ExitCode::io, file_reason(error));
  }
}

}  // namespace ripstop::inline studio
