#include "ripstop/flow/sheet_sides.h"

#include <algorithm>
#include <array>
#include <map>

#include "ripstop/flow/cartesian/sheet_faces.h"

namespace ripstop::inline flow {

double share_on_different_sides(const FlowGrid& grid, const std::vector<Triangle>& surface) {
  const auto axis = [&](int a) {
    return cartesian::make_axis(grid.edges(a), cartesian::End::zero_gradient, cartesian::End::zero_gradient);
  };
  std::map<std::array<int, 4>, int> crossings;
  for (const cartesian::SheetFace& face : cartesian::sheet_faces(axis(0), axis(1), axis(2), surface))
    ++crossings[{face.axis, face.i, face.j, face.k}];
  if (crossings.empty()) return 0;
  const auto odd = std::count_if(crossings.begin(), crossings.end(),
                                 [](const auto& pair) { return pair.second % 2 == 1; });
  return static_cast<double>(odd) / static_cast<double>(crossings.size());
}

}  // namespace ripstop::inline flow
