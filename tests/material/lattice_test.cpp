#include "ripstop/material/lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../f111_curve.h"
#include "../refusal.h"
#include "ripstop/core/error.h"

namespace ripstop {
namespace {

// Small-strain stiffness of a lattice of equal cells, summed spring by spring.
struct Stiffness {
  double xx, yy, xy, shear;
};
Stiffness stiffness(const LatticeLaws& laws, double a, double b, double xi, double eps) {
  const CellWidths w = cell_widths(a, b, xi, eps);
  const double area = a * b, diagonal = std::hypot(a, b);
  const double c = a / diagonal, s = b / diagonal;
  const double kx =
      2 * w.along_row * laws.axial.tangent(0) * a + 4 * w.bend_row * laws.bending.tangent(0) * 2 * a;
  const double ky =
      2 * w.along_column * laws.axial.tangent(0) * b + 4 * w.bend_column * laws.bending.tangent(0) * 2 * b;
  const double kd = 2 * w.shear * laws.shear.tangent(0) * diagonal;
  return {(kx + kd * c * c * c * c) / area, (ky + kd * s * s * s * s) / area, kd * c * c * s * s / area,
          kd * c * c * s * s / area};
}

TEST(Lattice, AUniaxialPullGivesTheMeasuredCurveBack) {
  struct Cloth {
    std::vector<double> coefficients;
    double xi, eps, compression, tested;
  };
  for (const Cloth& cloth : {Cloth{f111_curve, 0.2, 0.01, 1, 0.33}, Cloth{f111_curve, 0.2, 0.01, 0.1, 0.33},
                             Cloth{f111_curve, 0.3, 0.05, 1, 0.1}, Cloth{{20000}, 0.2, 0.01, 1, 0.2},
                             Cloth{{8000, 30000, -20000}, 0.1, 0.02, 1, 0.2}}) {
    const LatticeLaws laws =
        lattice_laws(cloth.coefficients, cloth.xi, cloth.eps, cloth.compression, cloth.tested);
    const SpringLaw curve{cloth.coefficients, 1};
    for (double part : {0.003, 0.01, 0.1, 0.37, 0.64, 0.9, 1.0}) {
      const double e = part * cloth.tested;
      EXPECT_NEAR(uniaxial_load(laws, e) / curve.tension(e), 1, 1e-3) << "strain " << e;
    }
  }
}

// Also where no lattice of the curves' own degree does.
TEST(Lattice, APullAlongEitherYarnGivesThatYarnsCurveBack) {
  for (const double shear : {0.1, 0.3})
    for (const double compression : {1.0, 0.1}) {
      Fabric fabric;
      fabric.coefficients_n_m = f111_curve;
      fabric.weft_coefficients_n_m = {20000, 100000};
      fabric.tested_strain = 0.33;
      fabric.shear_fraction = shear, fabric.bending_fraction = 0.01;
      fabric.compression = compression;
      const WovenLaws laws = woven_laws(fabric);
      for (const bool weft : {false, true}) {
        const SpringLaw curve{weft ? fabric.weft_coefficients_n_m : fabric.coefficients_n_m, 1};
        for (double part : {0.01, 0.1, 0.37, 0.64, 0.9, 1.0}) {
          const double e = part * fabric.tested_strain;
          EXPECT_NEAR(woven_uniaxial_load(laws, e, weft) / curve.tension(e), 1, 1.2e-3)
              << "strain " << e << " weft " << weft << " xi " << shear;
        }
      }
    }
}

TEST(Lattice, TheUnmendedLatticeCarriesOnly865ThousandthsOfItsCurve) {
  const double xi = 0.2, eps = 0.01;
  const SpringLaw whole{{30006}, 1};
  const LatticeLaws printed{whole.scaled(1 - xi - eps), whole.scaled(xi / 2), whole.scaled(eps / 2)};
  EXPECT_NEAR(uniaxial_load(printed, 1e-6) / (30006e-6), 0.865, 5e-4);
  const LatticeLaws mended = lattice_laws({30006}, xi, eps, 1, 1e-3);
  EXPECT_NEAR(mended.axial.coefficients[0] / printed.axial.coefficients[0], 1 / 0.865, 1e-3);
}

TEST(Lattice, EverySpacingHasTheSquareLatticesStiffness) {
  const double xi = 0.2, eps = 0.01;
  const LatticeLaws laws = lattice_laws(f111_curve, xi, eps, 1, 0.1);
  const Stiffness square = stiffness(laws, 1, 1, xi, eps);
  for (double aspect : {0.4, 0.7, 1.0, 1.5, 3.0}) {
    const Stiffness cell = stiffness(laws, 0.008 * aspect, 0.008, xi, eps);
    EXPECT_NEAR(cell.xx / square.xx, 1, 1e-12) << aspect;
    EXPECT_NEAR(cell.yy / square.yy, 1, 1e-12) << aspect;
    EXPECT_NEAR(cell.xy / square.xy, 1, 1e-12) << aspect;
    EXPECT_NEAR(cell.shear / square.shear, 1, 1e-12) << aspect;
  }
}

// Small strain stiffness of cells on the bias, from their springs: C = sum k n n n n.
struct Membrane {
  double xx = 0, yy = 0, xy = 0, xg = 0, yg = 0;  // xy is the shear modulus too

  /// Young's modulus of a pull at `angle` to x.
  double modulus(double angle) const {
    const double c = std::cos(angle), s = std::sin(angle);
    const double pull[3] = {c * c, s * s, c * s};
    const double m[3][3] = {{xx, xy, xg}, {xy, yy, yg}, {xg, yg, xy}};
    const auto minor = [&](int i, int j) {
      const int a = (i + 1) % 3, b = (i + 2) % 3, d = (j + 1) % 3, e = (j + 2) % 3;
      return m[a][d] * m[b][e] - m[a][e] * m[b][d];
    };
    const double determinant = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
    double compliance = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) compliance += pull[i] * minor(i, j) / determinant * pull[j];
    return 1 / compliance;
  }
};

Membrane bias_membrane(const WovenLaws& laws, double a, double b) {
  const CellWidths w = bias_widths(a, b, laws);
  Membrane m;
  const auto add = [&](double stiffness, double dx, double dy) {
    const double length = std::hypot(dx, dy), c = dx / length, s = dy / length,
                 k = stiffness * length / (a * b);
    m.xx += k * c * c * c * c, m.yy += k * s * s * s * s, m.xy += k * c * c * s * s;
    m.xg += k * c * c * c * s, m.yg += k * c * s * s * s;
  };
  add(2 * w.along_row * laws.shear.tangent(0), a, 0);
  add(2 * w.along_column * laws.shear.tangent(0), 0, b);
  add(w.shear * whole_yarn(laws.warp, laws.warp_bending).tangent(0), a, b);
  add(w.shear * whole_yarn(laws.weft, laws.weft_bending).tangent(0), -a, b);
  return m;
}

Fabric woven(bool balanced) {
  Fabric fabric;
  fabric.coefficients_n_m = f111_curve;
  fabric.tested_strain = 0.2;
  if (!balanced) fabric.weft_coefficients_n_m = {18000, 5000};
  return fabric;
}

// 1/E = cos^4/E1 + (1/G - 2 nu/E1) cos^2 sin^2 + sin^4/E2 of an orthotropic sheet, with the constants of the
// lattice along its yarns.
TEST(Lattice, OnTheBiasTheModulusOffTheYarnsIsTheOrthotropicSheets) {
  for (const bool balanced : {true, false}) {
    const WovenLaws laws = woven_laws(woven(balanced));
    const double coupling = laws.shear.tangent(0) / std::sqrt(2);  // C_12 = G
    const double c11 = whole_yarn(laws.warp, laws.warp_bending).tangent(0) + coupling;
    const double c22 = whole_yarn(laws.weft, laws.weft_bending).tangent(0) + coupling;
    const double e1 = c11 - coupling * coupling / c22, e2 = c22 - coupling * coupling / c11,
                 nu = coupling / c22;
    for (const double aspect : {1.0, 0.9, 1.1}) {
      const Membrane cell = bias_membrane(laws, 0.008 * aspect, 0.008);
      // Off the square the shear coupling of unequal yarns slants with the diagonals.
      const double tolerance = aspect == 1 ? 1e-12 : balanced ? 1e-12 : 0.1;
      for (int degrees = 0; degrees < 180; degrees += 15) {
        const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
        const double expected =
            1 / (c * c * c * c / e1 + (1 / coupling - 2 * nu / e1) * c * c * s * s + s * s * s * s / e2);
        EXPECT_NEAR(cell.modulus(angle + std::numbers::pi / 4) / expected, 1, tolerance)
            << degrees << " deg to the warp, sides 1 : " << aspect;
      }
    }
  }
}

/// A square cell with inclined columns, as next to the seam of a gore: widths are those of the lengths of its
/// sides.
Membrane leaning_membrane(const WovenLaws& laws, bool bias, double lean) {
  const double tilt = std::tan(lean), column = std::hypot(1, tilt);
  const CellWidths w = bias ? bias_widths(1, column, laws) : cell_widths(1, column, laws);
  Membrane m;
  const auto add = [&](double stiffness, double dx, double dy) {
    const double length = std::hypot(dx, dy), c = dx / length, s = dy / length, k = stiffness * length;
    m.xx += k * c * c * c * c, m.yy += k * s * s * s * s, m.xy += k * c * c * s * s;
    m.xg += k * c * c * c * s, m.yg += k * c * s * s * s;
  };
  const double yarn = whole_yarn(laws.warp, laws.warp_bending).tangent(0), shear = laws.shear.tangent(0);
  const double bending = 8 * laws.warp_bending.tangent(0);  // four springs over two cells
  add(bias ? 2 * w.along_row * shear : 2 * w.along_row * laws.weft.tangent(0) + w.bend_row * bending, 1, 0);
  add(bias ? 2 * w.along_column * shear : 2 * w.along_column * laws.warp.tangent(0) + w.bend_column * bending,
      tilt, 1);
  add(w.shear * (bias ? yarn : shear), 1 + tilt, 1);
  add(w.shear * (bias ? yarn : shear), -1 + tilt, 1);
  return m;
}

// The error of a gore: compared with cloth whose yarns keep the direction of the rows.
TEST(Lattice, WhereColumnsAreInclinedTheModulusHasTheErrorOfTheGuide) {
  const WovenLaws laws = woven_laws(woven(true));
  struct Stated {
    bool bias;
    double lean, low, high;
  };
  for (const Stated stated : {Stated{false, 7.5, -0.33, 0.49}, Stated{false, 15, -0.54, 1.14},
                              Stated{true, 7.5, -0.19, 0.26}, Stated{true, 15, -0.38, 0.63}}) {
    const Membrane upright = leaning_membrane(laws, stated.bias, 0);
    const Membrane cell = leaning_membrane(laws, stated.bias, stated.lean * std::numbers::pi / 180);
    double low = 0, high = 0;
    for (int degrees = 0; degrees < 180; degrees += 5) {
      const double angle = degrees * std::numbers::pi / 180,
                   off = cell.modulus(angle) / upright.modulus(angle) - 1;
      low = std::min(low, off), high = std::max(high, off);
    }
    EXPECT_NEAR(low, stated.low, 0.02) << stated.bias << " " << stated.lean;
    EXPECT_NEAR(high, stated.high, 0.02) << stated.bias << " " << stated.lean;
  }
}

TEST(Lattice, OnTheBiasOblongCellsKeepPositiveWidthsAndTheStatedSidesTheirStiffness) {
  const WovenLaws laws = woven_laws(woven(true));
  const Membrane square = bias_membrane(laws, 1, 1);
  for (const double aspect : {1.14, 1 / 1.14}) {
    const Membrane cell = bias_membrane(laws, aspect, 1);
    EXPECT_NEAR(cell.xx / square.xx, 1, 1e-12);
    EXPECT_NEAR(cell.yy / square.yy, 1, 1e-12);
    EXPECT_NEAR(cell.xy / square.xy, 1, 1e-12);
  }
  for (const double aspect : {0.1, 0.7, 1.4, 10.0}) {
    const CellWidths w = bias_widths(aspect, 1, laws);
    EXPECT_GT(w.along_row, 0);
    EXPECT_GT(w.along_column, 0);
    EXPECT_GT(w.shear, 0);
    EXPECT_LE(bias_membrane(laws, aspect, 1).xy, square.xy);
  }
}

TEST(Lattice, ASquareCellHasTheSpacingAsWidth) {
  const CellWidths w = cell_widths(0.01, 0.01, 0.2, 0.01);
  EXPECT_NEAR(2 * w.along_row, 0.01, 1e-15);
  EXPECT_NEAR(2 * w.along_column, 0.01, 1e-15);
  EXPECT_NEAR(w.shear, 0.01, 1e-15);
  EXPECT_NEAR(4 * w.bend_row, 0.01, 1e-15);
}

TEST(Lattice, SliversKeepPositiveWidths) {
  for (double aspect : {0.05, 20.0}) {
    const CellWidths w = cell_widths(aspect, 1, 0.3, 0.05);
    EXPECT_GT(w.along_row, 0);
    EXPECT_GT(w.along_column, 0);
    EXPECT_GT(w.shear, 0);
  }
}

TEST(Lattice, EverySpringOfAClothThatBucklesDoes) {
  Fabric fabric;
  fabric.coefficients_n_m = f111_curve, fabric.tested_strain = 0.3;
  fabric.shear_fraction = 0.2, fabric.bending_fraction = 0.01;
  const auto each = [](WovenLaws& laws) {
    return std::vector<SpringLaw*>{&laws.warp, &laws.weft, &laws.shear, &laws.warp_bending,
                                   &laws.weft_bending};
  };
  WovenLaws stiff = woven_laws(fabric);
  fabric.buckling_strain = 2e-5;
  WovenLaws buckling = woven_laws(fabric);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(each(buckling)[i]->buckling_strain, 2e-5) << i;
    EXPECT_NE(each(stiff)[i]->buckling_strain, 2e-5) << i;
    EXPECT_EQ(each(buckling)[i]->coefficients, each(stiff)[i]->coefficients) << i;
  }
}

TEST(Lattice, ImpossibleClothIsRefused) {
  EXPECT_THROW(lattice_laws(f111_curve, 0.6, 0.5, 1, 0.1), Error);
  EXPECT_THROW(lattice_laws({30006, -200000}, 0.2, 0.01, 1, 0.33), Error);
}

// Nearly all of the load would be that of the diagonals.
TEST(Lattice, ACurveThatNoLatticeFollowsIsRefused) {
  EXPECT_NE(refusal_of([] { lattice_laws(f111_curve, 0.999, 0, 1, 0.33); }, ExitCode::bad_data)
                .find("no lattice reproduces the curve"),
            std::string::npos);
}

}  // namespace
}  // namespace ripstop
