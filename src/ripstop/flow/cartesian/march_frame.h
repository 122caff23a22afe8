// Axes in which a flow is solved: those of the problem, renamed and reversed such that the stream is nearest to +z, along
// which the iteration marches.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "ripstop/core/vec3.h"
#include "ripstop/flow/flow.h"

namespace ripstop::inline flow::cartesian {

class MarchFrame {
 public:
  /// The axes of the problem themselves, if the stream is nearest to +z or as near to it as to another axis.
  explicit MarchFrame(Vec3 stream);

  /// Whether these are the axes of the problem.
  bool same() const { return axis_[2] == 2 && sign_[2] > 0; }
  /// A number that only this frame has, for files.
  int number() const { return sign_[2] * (axis_[2] + 1); }
  /// Its axes in those of the problem, for messages: "x, y, z = y, z, x of the case".
  std::string text() const;

  /// From the axes of the problem to those of the frame.
  Vec3 into(Vec3 v) const;
  std::vector<Triangle> into(std::vector<Triangle> surface) const;
  SheetMotion into(SheetMotion motion) const;
  FlowProblem into(FlowProblem problem) const;

  /// From the axes of the frame to those of the problem, which has this grid.
  Vec3 back(Vec3 v) const;
  std::vector<SheetLoad> back(std::vector<SheetLoad> loads) const;
  FlowStep back(FlowStep step) const;
  FlowField back(FlowField field, const FlowGrid& grid) const;

 private:
  FlowGrid into(const FlowGrid& grid) const;
  void turn_back(BodyLoad& load) const;
  /// visit(cell of the frame, cell of the problem)
  template <class Visit>
  void each_cell(const FlowGrid& problem, const Visit& visit) const;

  // Axis a of the frame is axis_[a] of the problem, reversed where sign_[a] < 0. Always a rotation, no reflection.
  std::array<int, 3> axis_{0, 1, 2};
  std::array<int, 3> sign_{1, 1, 1};
};

}  // namespace ripstop::inline flow::cartesian
