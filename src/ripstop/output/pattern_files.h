// Cutting patterns as files for plotter, laser cutter and printer: DXF and SVG to scale.
#pragma once

#include <filesystem>
#include <string>

#include "ripstop/parachute/cut.h"

namespace ripstop {

/// Unit of the coordinates of a DXF file, which its header states ($MEASUREMENT and $INSUNITS).
enum class DxfUnit { millimetres, inches };

/// AutoCAD R12 (AC1009) text: the outline to cut on layer CUT, the finished edge on layer SEAM, an arrow along the
/// warp on layer GRAIN, name and count on layer TEXT. Throws Error(io).
void write_pattern_dxf(const std::filesystem::path& path, const Piece& piece, const Allowances& allowances,
                       DxfUnit unit = DxfUnit::millimetres);

/// The same as an SVG that prints at true size, with a 100 mm bar to check the scale. Throws Error(io).
void write_pattern_svg(const std::filesystem::path& path, const Piece& piece, const Allowances& allowances);

/// The bill of materials as a table: part, material, count, finished and cut amount, unit,
/// mass. Throws Error(io).
void write_bill_csv(const std::filesystem::path& path, const Bill& bill);

}  // namespace ripstop
