// Parts sewn onto the cloth and attached to it: tape, suspension lines, vent lines, riser; the same for every
// family.
#pragma once

#include <vector>

#include "ripstop/mesh/builder.h"
#include "ripstop/parachute/build.h"

namespace ripstop::inline parachute {

/// Lines of equal length from the confluence to nodes on the edge of the vent, which they pull down.
struct ApexLines {
  double length = 0;  // [m]
  std::vector<int> ends;
};

/// A mesh while it becomes a canopy.
class CanopyBuilder : public MeshBuilder {
 public:
  Rigging rigging;

  /// The lower edge of a patch that goes round is the canopy's mouth.
  void set_skirt(int patch);

  /// The nodes along radial `part` of `parts`, which lies on a column of every patch, from the first patch's lower
  /// edge to the last one's upper edge. The patches follow one another edge to edge, each tied to the next, which
  /// contains the shared node.
  Path radial(const std::vector<int>& patches, int part, int parts) const;

  /// Index of the tape's law, for add_tape().
  int add_tape_law(const Tape& tape);
  void add_tape(const Path& path, const Tape& tape, int law, int part);

  /// Chooses the nodes of `path` (a smooth run of cloth nodes) that become nodes of a line, at least `segment` [m]
  /// apart: a short segment of so stiff a line would set the time step. The nodes between are tied to the straight
  /// segment, or remain free when not `straight`. Ends at `length` [m] along the path. The chosen nodes, with the
  /// lengths between.
  Path sew(const Path& path, double length, double segment, bool straight);

  /// Straight lines from the confluence on the axis to the first node of every path, which they follow from
  /// there; the apex lines, of the same material; and the riser. All suspension lines are `design.lines.length_m`
  /// long; the confluence lies where no line is stretched and one is taut. Call once.
  void add_lines(const Design& design, const PartMaterials& materials, const std::vector<Path>& sewn,
                 const ApexLines& apex = {});

  /// The next suspension line, along all of `path`. No node becomes the confluence.
  void add_line_along(const Path& path, const Line& material);

  /// Every line continues across the vent to the end of the opposite one: an even number of paths. A vent line
  /// is as long as the distance that it spans in the start shape.
  void add_vent_lines(const PartMaterials& materials, const std::vector<Path>& sewn);

  /// Call last.
  CanopyMesh finish();

 private:
  // Any cross-section of a chain is crossed by one axial and two bending springs: together
  // they are the line's law.
  struct ChainLaws {
    int axial, bending;
  };
  ChainLaws add_laws(const Line& line);
  /// Axial springs between neighbours, bending springs over two; the axial ones.
  std::vector<int> add_chain(const Path& path, const Line& line, ChainLaws laws, int part);
  void add_riser(const Design& design, const Line& riser);
  /// A line of the given length, straight from the confluence to the start of `onto`, which it follows from there.
  void add_line(LineRun line, const std::string& name, double length, const Path& onto, const Design& design,
                const Line& material, ChainLaws laws);
};

}  // namespace ripstop::inline parachute
