// The margins of a result, and the list of their members.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ripstop/canopy/margins.h"
#include "ripstop/canopy/stress.h"
#include "ripstop/case/settings.h"
#include "ripstop/core/members.h"

namespace ripstop::inline run {

template <Of<Margin> T, class Visit>
void each_member(T& m, Visit&& visit) {
  visit("member", m.member);
  visit("load", m.load);
  visit("load_from", m.load_from);
  visit("unit", m.unit);
  visit("strength", m.strength);
  visit("strength_from", m.strength_from);
  visit("knock_down", m.knock_down);
  visit("used", m.used);
  visit("margin_of_safety", m.margin);
}
template <Of<Margins> T, class Visit>
void each_member(T& m, Visit&& visit) {
  visit("members", m.members);
  visit("weakest_member", m.weakest);
}

template <Of<HardwareNeed> T, class Visit>
void each_member(T& n, Visit&& visit) {
  visit("rated_load_n", n.rated);
  visit("breaking_load_n", n.metal);
  visit("textile_breaking_load_n", n.textile);
}

/// `spring_tensions` of all springs outside the cloth, of a shape or the highest of an opening [N], and the highest
/// ones of the reefing lines of so many stages. The lines of an opening have their highest loads at different times:
/// the hardware then carries the `largest_load` at the confluence [N]; absent: the sum of the risers, or of the lines.
Margins case_margins(const Settings& resolved, const CanopyMesh& mesh,
                     const std::vector<double>& spring_tensions, const StressPeak& stress,
                     const std::vector<double>& reefing_tensions = {},
                     std::optional<double> largest_load = {});

/// The largest loads of the members of a computed opening over its load; 0: not known. A line of such an opening can
/// carry more than an equal share.
struct MemberShares {
  double cloth = 0;  // [1/m]
  double tape = 0, line = 0, riser = 0;
};

/// Of lines, tape or hem, riser and hardware under an opening load [N]. A line carries an equal share of it times the
/// family's line_load_factor, and the tape the load of one line, as in tape_for(); without one (null) a hem of the cloth.
/// Lines, riser and hardware carry a larger `snatch` load in its place; the edges of the packed canopy do not.
/// Members of a computed opening carry its `shares` of the load where these are larger, and the cloth is listed.
Margins load_margins(const Design& design, const MarginFactors& factors, const Fabric& cloth,
                     const Tape* tape, double load, const Line& line, const Line& riser,
                     const HardwareParts& hardware = {}, double snatch = 0, const MemberShares& shares = {});
Margins load_margins(const Settings& resolved, double load, double snatch = 0,
                     const MemberShares& shares = {});

/// One row a kind of member: of the lines the weakest.
std::vector<Margin> weakest_of_kinds(const Margins& margins);

/// With its sign; a margin just below 0 is never "-0.00".
std::string margin_text(double margin);
/// In words, every kind of member whose margin of safety is below 0.
std::vector<std::string> margin_warnings(const std::optional<Margins>& margins);

}  // namespace ripstop::inline run
