#include "ripstop/flow/hems.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <set>
#include <utility>

namespace ripstop::inline flow {
namespace {

/// The corners of a surface: those at the same place have the same number.
struct Corners {
  std::vector<int> number;  // three of each triangle
  std::vector<Vec3> place;  // of each number
};

std::size_t hash_of(Vec3 v) {
  const auto bits = [](double value) {
    return std::bit_cast<std::uint64_t>(value + 0.0);
  };  // of -0 those of 0
  std::uint64_t h = bits(v.x) * 0x9e3779b97f4a7c15u;
  h = (std::rotl(h, 29) ^ bits(v.y)) * 0xbf58476d1ce4e5b9u;
  h = (std::rotl(h, 29) ^ bits(v.z)) * 0x94d049bb133111ebu;
  return h ^ (h >> 32);
}

Corners corners_of(const std::vector<Triangle>& surface) {
  Corners corners;
  corners.number.reserve(3 * surface.size());
  const std::size_t mask = std::bit_ceil(6 * surface.size() + 1) - 1;
  std::vector<int> table(mask + 1, -1);  // open addressing, at most half full
  for (const Triangle& t : surface) {
    for (const Vec3& v : {t.a, t.b, t.c}) {
      std::size_t at = hash_of(v) & mask;
      while (table[at] >= 0 && !(corners.place[table[at]] == v)) at = (at + 1) & mask;
      if (table[at] < 0) table[at] = static_cast<int>(corners.place.size()), corners.place.push_back(v);
      corners.number.push_back(table[at]);
    }
  }
  return corners;
}

using Edge = std::pair<int, int>;  // numbers of its corners, the lower one first

/// The edges of a surface, and of how many triangles each is.
class Edges {
 public:
  explicit Edges(const Corners& corners) : begin_(corners.place.size() + 1, 0) {
    const std::vector<int>& number = corners.number;
    for (std::size_t n = 0; n < number.size(); ++n)
      if (const Edge e = edge_of(number, n); e.first != e.second) ++begin_[e.first + 1];
    for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
    std::vector<int> end(begin_.begin(), begin_.end() - 1);
    all_.resize(begin_.back());
    uses_.resize(begin_.back());
    edge_.assign(number.size(), -1);
    for (std::size_t n = 0; n < number.size(); ++n) {
      const Edge e = edge_of(number, n);
      if (e.first == e.second) continue;
      int at = begin_[e.first];
      while (at < end[e.first] && all_[at].second != e.second) ++at;
      if (at == end[e.first]) all_[at] = e, ++end[e.first];
      ++uses_[at];
      edge_[n] = at;
    }
  }

  /// From corner n of all triangles to the next corner of its triangle.
  static Edge edge_of(const std::vector<int>& number, std::size_t n) {
    return std::minmax(number[n], number[n - n % 3 + (n + 1) % 3]);
  }
  /// Whether that edge belongs to one triangle only; one without length does not.
  bool single(std::size_t n) const { return edge_[n] >= 0 && uses_[edge_[n]] == 1; }

  std::vector<Edge> single() const {
    std::vector<Edge> result;
    for (std::size_t at = 0; at < all_.size(); ++at)
      if (uses_[at] == 1) result.push_back(all_[at]);
    return result;
  }

 private:
  std::vector<int> begin_;  // of the edges from each lower corner
  std::vector<Edge> all_;
  std::vector<int> uses_, edge_;
};

/// Of those that one triangle has alone, the long edges with two short ones along them, and those.
std::set<Edge> joined(const std::vector<Edge>& single, const std::vector<Vec3>& place) {
  std::vector<Edge> both;  // from either end
  for (const auto& [p, q] : single) both.emplace_back(p, q), both.emplace_back(q, p);
  std::sort(both.begin(), both.end());
  std::set<Edge> joined;
  for (const auto& [p, q] : single) {
    for (auto end = std::lower_bound(both.begin(), both.end(), Edge(p, 0));
         end != both.end() && end->first == p; ++end) {
      const int m = end->second;
      const Vec3 a = place[p], b = place[q], c = place[m];
      if (m == q || norm(c - 0.5 * (a + b)) > 0.3 * norm(b - a) ||
          !std::binary_search(both.begin(), both.end(), Edge(q, m))) {
        continue;
      }
      joined.insert({p, q});
      joined.insert(std::minmax(p, m));
      joined.insert(std::minmax(m, q));
    }
  }
  return joined;
}

}  // namespace

std::vector<Hem> hems(const std::vector<Triangle>& surface) {
  const Corners corners = corners_of(surface);
  const Edges edges(corners);
  const std::set<Edge> none = joined(edges.single(), corners.place);
  std::vector<Hem> hems;
  for (std::size_t n = 0; n < corners.number.size(); ++n) {
    if (!edges.single(n) || none.contains(Edges::edge_of(corners.number, n))) continue;
    const Triangle& t = surface[n / 3];
    const Vec3 v[] = {t.a, t.b, t.c};
    const Vec3 p = v[n % 3], q = v[(n + 1) % 3], third = v[(n + 2) % 3];
    const Vec3 inside = third - p, across = inside - dot(inside, q - p) / dot(q - p, q - p) * (q - p);
    hems.push_back({p, q, norm(across) > 0 ? across / norm(across) : Vec3{}});
  }
  return hems;
}

}  // namespace ripstop::inline flow
