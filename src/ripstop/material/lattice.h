// From the cloth's own curve to the springs of the lattice: [NFM] section 2, mended so that a homogeneous
// pull along a yarn gives back the curve for any spacing of the lattice.
#pragma once

#include <vector>

#include "ripstop/material/material.h"
#include "ripstop/material/spring_law.h"

namespace ripstop::inline material {

/// Laws of the three spring families, per width [N/m].
struct LatticeLaws {
  SpringLaw axial, shear, bending;
};

/// Laws for which a homogeneous uniaxial pull along a yarn (load across it zero) returns the measured curve
/// sum K_k e^k [N/m] within 0.1 % for 0 <= e <= tested_strain. `coefficients` are K_1..K_n of that curve,
/// `xi` and `eps` the fractions of [NFM] Eq. 11, `compression` as in SpringLaw; a tested strain of 0
/// (unknown) is taken as 0.1. A degree is added where the measured one is not enough. Throws Error(bad_data)
/// when the curve is not positive up to the tested strain, when xi + eps >= 1, or when no law within two more
/// degrees returns it.
LatticeLaws lattice_laws(const std::vector<double>& coefficients, double xi, double eps, double compression,
                         double tested_strain);

/// Nominal stress resultants [N/m] per undeformed width.
struct Resultants {
  double along = 0, across = 0;
};
/// Laws of a cloth whose warp and weft differ. Warp yarns lie along the columns (row + 1),
/// weft yarns along the rows.
struct WovenLaws {
  SpringLaw warp, weft, shear, warp_bending, weft_bending;
};

/// As lattice_laws(), for both directions at once; the diagonals carry xi/2 of the mean of warp and weft. The
/// same laws as lattice_laws() when the fabric has no curve of its own for the weft.
WovenLaws woven_laws(const Fabric& fabric);

/// As lattice_resultants() and uniaxial_load(); `along_weft` turns the pull by 90 deg.
Resultants woven_resultants(const WovenLaws& laws, double strain_warp, double strain_weft);
double woven_uniaxial_load(const WovenLaws& laws, double strain, bool along_weft);

/// Widths [m] that ONE cell gives to EACH spring it touches. A spring's width is the sum over its cells:
///   along_row     each of the cell's two edges along the row     (an inner edge touches 2 cells)
///   along_column  each of its two edges along the column         (2 cells)
///   shear         each of its two diagonals                      (1 cell)
///   bend_row      each spring over two edges in a row, one of them of this cell     (4 cells)
///   bend_column   likewise along the column                      (4 cells)
struct CellWidths {
  double along_row = 0, along_column = 0, shear = 0, bend_row = 0, bend_column = 0;
};

/// Cell of spacing h_row along the row and h_column across it [m]. The shear width gives the square lattice's shear
/// modulus and Poisson coupling, L^3 / (2 sqrt2 h_row h_column) with L the diagonal; the axial widths compensate the
/// excess or deficit of the slanted diagonals along either side, so that the small-strain stiffness is that of the
/// square lattice. In a sliver (sides beyond about 1 : 3.4 for xi = 0.2) the shear width is reduced so that the axial
/// springs keep a tenth of their width.
CellWidths cell_widths(double h_row, double h_column, double xi, double eps);

/// The same where warp (along the column) and weft (along the row) differ.
CellWidths cell_widths(double h_row, double h_column, const WovenLaws& laws);

/// How cloth is cut: `block` has the warp along the columns of the lattice, `across` along its rows, `bias`
/// at 45 deg to both, from (row, column) toward (row + 1, column + 1).
enum class FabricCut { block, across, bias };

/// Warp and weft exchanged: the laws of a lattice whose rows are the warp.
WovenLaws exchanged(const WovenLaws& laws);

/// One law for the load of an axial and two bending springs through any section.
SpringLaw whole_yarn(const SpringLaw& axial, const SpringLaw& bending);

/// Widths of a cell cut on the bias: its diagonals are the yarns (whole_yarn, warp up), rows and columns the
/// shear springs (the law `shear`); there are no bending springs. A square cell stores exactly the energy of
/// the cloth turned by 45 deg in any homogeneous stretch. In an oblong one the small strain stiffness is the
/// same up to sides of about 1 : 1.14 for xi = 0.2; beyond, the yarns' width is reduced so that the longer side's
/// springs keep a tenth of their width, and the cell is too soft.
CellWidths bias_widths(double h_row, double h_column, const WovenLaws& laws);

/// Of the square lattice under homogeneous stretch (strains along the two yarns).
Resultants lattice_resultants(const LatticeLaws& laws, double strain_along, double strain_across);

/// The load per width [N/m] at `strain` along a yarn when nothing pulls across it.
double uniaxial_load(const LatticeLaws& laws, double strain);

}  // namespace ripstop::inline material
