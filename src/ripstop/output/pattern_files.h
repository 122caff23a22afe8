// Cutting patterns as files for plotter, laser cutter and printer: DXF, SVG and tiled PDF, to scale.
#pragma once

#include <filesystem>
#include <string>

#include "ripstop/parachute/cut.h"

namespace ripstop::inline output {

/// Unit of the coordinates of a DXF file, which its header states ($MEASUREMENT and $INSUNITS).
enum class DxfUnit { millimetres, inches };

/// Paper of a home printer.
enum class Paper { a4, letter };

/// Text of the title block of a drawing in addition to the piece; empty parts are omitted.
struct PatternHead {
  std::string title, case_file, date;
};

/// AutoCAD R12 (AC1009) text, one layer for each kind of line: CUT, the outline to cut; SEAM, the finished edge;
/// FOLD, where hems are turned; NOTCH, slits that meet those of the neighbour; LINES, where suspension lines are sewn
/// on; GRAIN, an arrow along the warp; TEXT, title block and names of the edges. Throws Error(io).
void write_pattern_dxf(const std::filesystem::path& path, const Piece& piece, const Allowances& allowances,
                       DxfUnit unit = DxfUnit::millimetres, const PatternHead& head = {});

/// The same as an SVG that prints at true size, with a 100 mm bar to check the scale. Throws Error(io).
void write_pattern_svg(const std::filesystem::path& path, const Piece& piece, const Allowances& allowances,
                       const PatternHead& head = {});

/// The same at true size on sheets of paper: first an overview of the sheets with a control square of 100 mm, then
/// every sheet that a line crosses, with registration marks at its corners. Throws Error(usage) where more than 300
/// sheets would be needed, Error(io).
void write_pattern_pdf(const std::filesystem::path& path, const Piece& piece, const Allowances& allowances,
                       Paper paper, const PatternHead& head = {});

/// The bill of materials as a table: part, material, count, finished and cut amount, unit,
/// mass. Throws Error(io).
void write_bill_csv(const std::filesystem::path& path, const Bill& bill);

}  // namespace ripstop::inline output
