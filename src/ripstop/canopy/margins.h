// Margin of safety of every part: its maximum load and its allowable load.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/material/material.h"

namespace ripstop::inline canopy {

/// [margins] of a case file; sources are given with the keys (case/flight_keys.cpp).
struct MarginFactors {
  double safety_factor = 1.5;          // on the load
  double seam_efficiency = 0.8;        // of cloth and tape, shares of the strength from here on
  double line_joint_efficiency = 0.8;  // of lines and riser
  double abrasion = 0.95, moisture = 0.95, fatigue = 0.95, temperature = 1;
};

/// [hardware.NAME]: a part in the chain from the riser to the payload, such as a swivel, a link, a harness or a shock
/// cord. It carries the whole load of the riser.
struct Hardware {
  enum class Kind { metal, textile };
  std::optional<Kind> kind;                             // absent: metal; a part that stretches needs it
  std::optional<double> breaking_load_n, rated_load_n;  // of one strand; one of them is given
  int strands = 1;                                      // that share the load equally
  std::optional<double> length_m, stiffness_n;          // of one strand; stiffness: tension over strain
};
using HardwareParts = std::map<std::string, Hardware>;  // by name

/// The highest loads of a shape or of an opening.
struct MemberLoads {
  double cloth = 0;           // along either yarn [N/m]
  double tape = 0;            // [N]
  std::vector<double> lines;  // [N]
  double riser = 0;           // [N]; 0: there is none
  /// Lines of another material each.
  struct OtherLine {
    std::string member;
    double load = 0;  // [N]
    Line material;
  };
  std::vector<OtherLine> others = {};
  double hardware = 0;  // of every part of it [N]
  std::optional<std::string> hardware_from = {};
};

/// Loads of skirt, vent and seams, which carry the load of one line [N]: the tape, or without one (null) a hem of the
/// cloth.
MemberLoads edge_loads(double line_load, const Tape* tape);

struct Margin {
  std::string member;  // "cloth", "tape", "line 3", "riser", "reefing line 1"
  double load = 0;     // [N/m] of cloth, else [N]
  std::string unit;
  std::optional<std::string> load_from;  // of hardware in an opening
  std::optional<double> strength;        // of the material as it is sold; absent: not known
  std::string strength_from;
  double knock_down = 1;  // share of it that is left
  std::optional<double>
      used;  // utilisation: safety factor times load over the allowable load; above 1 it is exceeded
  std::optional<double> margin;  // of safety: 1 / used - 1
};

struct Margins {
  std::vector<Margin> members;
  std::string weakest;  // of those whose strength is known; empty: none
};

/// Strengths are those of strength_of(). `tape` is null where there is none. A rated load of hardware includes its
/// maker's safety factor: the load alone is compared with it. The knock-down factors apply to the breaking load of
/// textile hardware, as to a line.
Margins margins_of(const MemberLoads& loads, const MarginFactors& factors, const Fabric& cloth,
                   const Tape* tape, const Line& line, const Line& riser, const HardwareParts& hardware = {});

/// Strength that every part of the hardware needs under a load [N]: a rated load, or the breaking load of a metal or a
/// textile part.
struct HardwareNeed {
  double rated = 0, metal = 0, textile = 0;
};
HardwareNeed hardware_need(double load, const MarginFactors& factors);

/// The weakest member; null when no strength is known.
const Margin* weakest(const Margins& margins);
/// Names it in `margins`, after a change of the members.
void take_weakest(Margins& margins);

}  // namespace ripstop::inline canopy
