#include "ripstop/run/report/shape_files.h"

#include <algorithm>
#include <string>

#include "ripstop/output/csv.h"

namespace ripstop::inline run {
namespace {

namespace fs = std::filesystem;

// Points of all frames together in a page of `largest_page`: 6 bytes for each point and frame, measured.
constexpr std::size_t most_points = 1'200'000;
constexpr std::size_t least_frames = 12;

}  // namespace

std::vector<ShapeFiles> shape_files(const fs::path& folder) {
  std::vector<ShapeFiles> files;
  if (!fs::is_directory(folder / "vtk")) return files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "vtk")) {
    const std::string name = entry.path().filename();
    if (!name.starts_with("canopy_") || !name.ends_with(".vtp")) continue;
    const fs::path lines = folder / "vtk" / ("lines" + name.substr(6));
    if (fs::exists(lines)) files.push_back({0, entry.path(), lines});
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.canopy < b.canopy; });
  return files;
}

std::vector<ShapeFiles> opening_shapes(const fs::path& folder) {
  std::vector<ShapeFiles> all = shape_files(folder);
  if (all.size() < 2) return all;
  std::vector<double> times = read_csv(folder / "balance.csv").column("time_s");
  times.insert(times.begin(), 0.0);  // the folded start
  for (std::size_t i = 0; i < all.size(); ++i) all[i].time = i < times.size() ? times[i] : times.back();
  return all;
}

std::vector<ShapeFiles> thinned_out(std::vector<ShapeFiles> all) {
  if (all.size() < 2) return all;
  const std::size_t points = read_shape({all.front()}).frames.front().points.size() / 3;
  const std::size_t fit = std::max(least_frames, most_points / std::max<std::size_t>(points, 1));
  if (all.size() <= fit) return all;
  std::vector<ShapeFiles> kept;
  for (std::size_t i = 0; i < fit; ++i) kept.push_back(all[i * (all.size() - 1) / (fit - 1)]);
  return kept;
}

}  // namespace ripstop::inline run
