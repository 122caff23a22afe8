// From a .chute file of openchute to a case of Ripstop.
#pragma once

#include <optional>
#include <string>

#include "ripstop/case/chute_file.h"
#include "ripstop/case/imported_case.h"

namespace ripstop::inline cases {

/// Assumed: lines of a cross, and the vent over the widest diameter where gores end in a point.
constexpr int cross_line_count = 16;
constexpr double chute_vent_share = 0.04;

/// Data that the file does not contain.
struct ChuteImportOptions {
  std::optional<int> line_count;        // absent: one a gore, or cross_line_count
  std::optional<double> line_length;    // [m]; absent: the nominal diameter (assumed)
  std::optional<double> vent_diameter;  // [m]; absent: the file's, or by chute_vent_share
};

/// A flat disk with or without a cylindrical band below, or a cone, of circular sections becomes `disk-gap-band`,
/// `flat-circular`, `conical`; a single cylinder of 2 gores, which represents a cross in openchute, becomes `cross`.
/// Everything else becomes a `profile` that is cut as openchute cuts it: gores 2 pi r / N wide. `source` names the
/// file in the case. Throws Error(bad_data) with the place for shapes that cannot be converted: polygonal sections of
/// different numbers of gores, two gores, no room for a vent.
ImportedCase import_chute(const ChuteFile& file, const ChuteImportOptions& options,
                          const std::string& source);

}  // namespace ripstop::inline cases
