// Porous cloth as a sheet without thickness: the pressure that drops across it, on the faces that it parts.
//
// The jump of a face occurs together with the pressure difference of its cells, in the momentum of the cells, in the
// flux through the face and in the pressure correction, so that a jump balanced by the pressure has no effect on the
// velocity on either side ("balanced force", Francois et al. 2006).
#pragma once

#include <array>
#include <vector>

#include "ripstop/flow/cartesian/grid.h"
#include "ripstop/flow/cartesian/quarter.h"
#include "ripstop/flow/cartesian/sheet_faces.h"
#include "ripstop/flow/flow.h"

namespace ripstop::inline flow::cartesian {

struct State;

/// Dense rows for kernels: data of the low faces of the cells of a row, zeros without a sheet. The jumps in the flow,
/// `held` and `change`, are in its State, in rows of the same layout.
class SheetRows {
 public:
  SheetRows() = default;
  /// Throws Error(bad_data) for coefficients that are negative or not finite, or a number of velocities that
  /// is not that of the triangles. `quarter`: the axes are those of a quarter (quarter.h), the bodies are whole.
  /// `team` shares the work; the rows do not depend on it.
  SheetRows(const Axis& x, const Axis& y, const Axis& z, const std::vector<FlowBody>& bodies,
            bool quarter = false, ThreadTeam* team = nullptr);

  bool empty() const { return faces_.empty(); }
  /// Whether the sheets leave next to nothing of the box's cross-section open.
  bool shut() const { return shut_; }
  /// Whether a face of row (j, k) has a jump.
  bool touches(int j, int k) const { return !touched_.empty() && touched_[row(j, k)] != 0; }
  /// Where row (j, k) of the faces across `axis` begins, n + 1 values; it has the low faces of its cells. 0:
  /// the row of zeros, not to be written.
  std::size_t offset(int axis, int j, int k) const { return offset_.empty() ? 0 : offset_[axis][row(j, k)]; }
  /// Difference of the law from the present jump [Pa], and its slope over the velocity of the face [Pa s/m].
  const std::vector<double>& excess() const { return excess_; }
  const std::vector<double>& stiffness() const { return stiffness_; }

  /// Gives the state its jumps: on every face the pressure's own difference.
  void begin(State& state, const Layout& layout) const;
  /// The same after the cloth has moved from `before`: faces that were there keep theirs.
  void begin(State& state, const Layout& layout, const SheetRows& before) const;
  /// The law at the present velocities. `momentum` is rho U of the free stream [kg/(m2 s)]; `step` [s] that of a
  /// march, in which sheets that move hold in its middle.
  void update(State& state, const Layout& layout, double momentum, double step = 0);
  /// The drop on every face with its last change, into State::drop.
  void settle(State& state) const;

  /// Distance of each cell's centre to the nearest face that a sheet parts [m], no less
  /// than half the least cell.
  Array<double> distance(const Axis& x, const Axis& y, const Axis& z, const Layout& layout,
                         ThreadTeam* team = nullptr) const;
  /// Loads of the air on the sheets, face by face; of a quarter those of the mirror images too.
  std::vector<SheetLoad> loads(const State& state, const Layout& layout) const;

 private:
  std::size_t row(int j, int k) const { return static_cast<std::size_t>(k) * (ny_ + 1) + j; }

  struct Face {
    SheetFace geometry;
    int body = 0;
    PressureDrop law;
    Vec3 velocity;  // of the sheet [m/s]
    bool moves = false;
    double yields = 0;  // by which it is faster along its normal for every pascal beyond ... [m/(s Pa)]
    double known = 0;   // ... this drop along the normal [Pa]
    double beyond = 0;  // how far the sheet lies from the face towards the next one, signed, in cells
    double apart = 0;   // the centres on its two sides [m]
    double drop = 0, slope = 0;            // by the law at the last update [Pa], [Pa s/m]
    double area = 0;                       // of the face [m2]
    double spread = 1;                     // its area over that of the sheet that it represents
    double cover = 1;                      // the part of it that the sheet covers
    double layer = 1;                      // its part of the face's drop
    bool lowest = false, highest = false;  // of the layers that part the same two centres
    bool in_plane = false;                 // of symmetry: no air passes, and nothing drops
    std::array<int, images> triangle{};    // of each mirror image, in a quarter
    std::size_t at = 0;                    // in the dense rows
  };
  void hold_in_the_middle(const State& state, const Layout& layout, double step);
  void add_faces(const Axis& x, const Axis& y, const Axis& z, const std::vector<FlowBody>& bodies,
                 ThreadTeam* team);
  Face face_of(const SheetFace& geometry, int body, const FlowBody& sheet,
               const std::array<const Axis*, 3>& axes) const;
  void lay_out();
  SheetLoad load_on(const Face& face, double drop, const State& state, const Layout& layout) const;

  int nx_ = 0, ny_ = 0, nz_ = 0;
  bool quarter_ = false;
  std::vector<Face> faces_;
  std::vector<std::vector<std::size_t>> offset_;  // one table an axis; 0: the row of zeros
  std::vector<char> touched_;
  std::vector<double> law_, excess_, stiffness_, middle_;
  bool shut_ = false;
};

}  // namespace ripstop::inline flow::cartesian
