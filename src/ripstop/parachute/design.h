// The parachute as its case file describes it: one struct for each TOML table, the canopy of any family.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ripstop/material/lattice.h"
#include "ripstop/parachute/family.h"

namespace ripstop {
class Fields;
class Findings;
}  // namespace ripstop

namespace ripstop::inline parachute {

/// [parachute.lines]
struct LineSet {
  int count = 0;
  double length_m = 0;  // from the confluence to the skirt
  std::string material = "spectra-line";
  std::optional<double> onto_disk_m;  // from the disk's edge inward; absent: to the vent's edge (assumed)
};

inline constexpr const char* no_tape = "none";
/// [parachute.tape]: sewn along gore seams, and along the hems of vent, disk edge and both edges of the band.
struct TapeLayout {
  std::optional<std::string> material;  // a name or no_tape; absent: follows from the load, case/tape.h
  bool seams = true;
  bool hems = true;
  bool inner_hems = true;  // of gored canopies: also on edges between the skirt and the vent
};

/// [parachute.riser]: from the fixed point to the confluence.
struct Riser {
  double length_m = 0;  // 0: the confluence is the fixed point
  std::string material = "spectra-line";
};

/// [parachute.mesh]
struct MeshSettings {
  int cloth_nodes = 25600;       // aimed at; [NFM] used 25,600 for Stratos IV
  double line_segment_m = 0.05;  // rest length of one spring of a line, aimed at
  bool sewn_straight = true;     // cloth between two nodes of a line on a gore's seam keeps to their chord
  int folds = 0;                 // every ring has a multiple of twice as many columns, so that they fit
};

/// [parachute]
struct Design {
  Canopy canopy;
  std::optional<double> nominal_area_m2;  // reference area S0; absent: the type's own
  int gores = 0;
  std::string canopy_material = "f-111-physical";
  FabricCut cut = FabricCut::block;  // of every piece of cloth, against its centre line
  LineSet lines;
  TapeLayout tape;
  Riser riser;
  MeshSettings mesh;
};

void describe(Fields& fields, LineSet& lines);
void describe(Fields& fields, TapeLayout& tape);
void describe(Fields& fields, Riser& riser);
void describe(Fields& fields, MeshSettings& mesh);
/// `type`, the keys of that type, and the keys of all families.
void describe(Fields& fields, Design& design, const Families& types = families());

/// Keys that most families share.
void describe_nominal_diameter(Fields& fields, double& diameter);
void describe_vent(Fields& fields, double& diameter, bool& lines);
/// A vent smaller than the canopy of `diameter` [m], and an even number of lines if they continue across it.
void check_vent(double vent, double diameter, bool lines, const Design& design, Findings& findings);
/// A vent at least as wide as a cell of the mesh: a finer rim than that would set the time step. Call when
/// the shape is otherwise sound. The key contains `of_diameter` times the diameter `vent`: 0.5 where it is a radius.
void check_vent_cells(double vent, const std::string& key, const Design& design, Findings& findings,
                      double of_diameter = 1);
void check_vent_lines(bool lines, const Design& design, Findings& findings);
/// For families whose tape is all there or not at all: no edge between skirt and vent without it.
void check_inner_hems(const Design& design, Findings& findings);

/// Reports mistakes that single ranges do not show: a vent wider than the disk, lines that cannot meet on the
/// axis.
void check_design(const Design& design, Findings& findings);
/// Refuses springs of lines and riser so short that they make more nodes than a mesh may have; `key` is their
/// key.
void check_line_nodes(const Design& design, const std::string& key, double line_segment, Findings& findings);

/// Sizes of the canopy, by its family's own definitions.
CanopyFacts facts(const Design& design);
Experience experience(const Design& design);
/// Area of the cloth as cut, without gaps, slots and vent [m2].
double computed_area(const Design& design);
/// Reference area S0 of the coefficients: as given, else by the type's definition [m2].
double nominal_area(const Design& design);
/// Of the circle with that area, D0 [m].
double nominal_diameter(const Design& design);
/// How far the lines run onto the canopy, as given, else up to the vent's edge [m]: from the disk's edge
/// (disk-gap-band) or from the skirt.
double line_length_on_disk(const Design& design);
/// Of the circle through the points where the lines leave the canopy, start shape [m].
double skirt_circumference(const Design& design);
/// Largest diameter of the start shape [m], and its length from the skirt downstream [m].
double start_diameter(const Design& design);
double start_depth(const Design& design);
/// The keys that decide the size of the canopy: for Findings::sound(), whatever the family.
std::vector<std::string> shape_keys(const Design& design);

}  // namespace ripstop::inline parachute
