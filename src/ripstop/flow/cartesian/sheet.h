// Porous cloth as a sheet without thickness: the pressure that drops across it, on the faces that it parts.
//
// A face's jump stands wherever the two cells' pressure difference does, in the momentum of the cells, in the
// flux through the face and in the pressure correction, so that a jump that the pressure takes up leaves no
// trace in the velocity on either side ("balanced force", Francois et al. 2006).
#pragma once

#include <vector>

#include "ripstop/flow/cartesian/grid.h"
#include "ripstop/flow/cartesian/sheet_faces.h"
#include "ripstop/flow/flow.h"

namespace ripstop::cartesian {

struct Fields;

/// Dense rows for kernels: what lies on the low faces of a row's cells, zeros where no sheet passes.
class SheetRows {
 public:
  SheetRows() = default;
  /// Throws Error(bad_data) for coefficients that are negative or not finite.
  SheetRows(const Axis& x, const Axis& y, const Axis& z, const std::vector<Sheet>& sheets);

  bool empty() const { return faces_.empty(); }
  /// Whether the sheets leave next to nothing of the box's cross-section open.
  bool shut() const { return shut_; }
  /// Whether a face of row (j, k) has a jump.
  bool touches(int j, int k) const { return !touched_.empty() && touched_[row(j, k)] != 0; }
  /// Rows of n + 1 values; `axis` is that of the faces. Row (j, k) has the low faces of its cells.
  const double* held(int axis, int j, int k) const { return held_.data() + offset(axis, j, k); }
  const double* excess(int axis, int j, int k) const { return excess_.data() + offset(axis, j, k); }
  const double* stiffness(int axis, int j, int k) const { return stiffness_.data() + offset(axis, j, k); }
  const double* change(int axis, int j, int k) const { return change_.data() + offset(axis, j, k); }
  /// The row to write to, or null if it has no face with a jump.
  double* change_to_write(int axis, int j, int k) {
    const std::size_t at = offset(axis, j, k);
    return at == 0 ? nullptr : change_.data() + at;
  }

  /// Jump [Pa] of the law at the present velocities, and its slope over the face's own velocity [Pa s/m].
  /// `momentum` is rho U of the free stream [kg/(m2 s)].
  void update(const Fields& fields, const Layout& layout, double momentum);
  /// Distance of each cell's centre to the nearest face that a sheet parts [m], no less than half the least
  /// cell.
  Array<double> distance(const Axis& x, const Axis& y, const Axis& z, const Layout& layout) const;
  /// Force of the air on the sheets [N], from the jumps with their last changes.
  Vec3 force() const;
  /// The same, face by face.
  std::vector<SheetLoad> loads() const;

 private:
  std::size_t row(int j, int k) const { return static_cast<std::size_t>(k) * (ny_ + 1) + j; }
  std::size_t offset(int axis, int j, int k) const { return offset_.empty() ? 0 : offset_[axis][row(j, k)]; }

  struct Face {
    SheetFace geometry;
    int sheet = 0;
    double a = 0, b = 0;  // of the law
    double area = 0;      // of the face [m2]
    double spread = 1;    // its area over that of the sheet it stands for
    double cover = 1;     // the part of it that the sheet covers
    std::size_t at = 0;   // in the dense rows
    double jump = 0, stiffness = 0;
  };
  int nx_ = 0, ny_ = 0, nz_ = 0;
  std::vector<Face> faces_;
  std::vector<std::vector<std::size_t>> offset_;  // one table an axis; 0: the row of zeros
  std::vector<char> touched_;
  std::vector<double> held_, law_, excess_, stiffness_, change_;
  bool shut_ = false;
  bool updated_ = false;
};

}  // namespace ripstop::cartesian
