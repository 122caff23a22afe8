#include "ripstop/material/lattice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ripstop/core/error.h"

namespace ripstop {
namespace {

const std::vector<double> f111{30006, -18936};  // [NFM] Table 3

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
  for (const Cloth& cloth :
       {Cloth{f111, 0.2, 0.01, 1, 0.33}, Cloth{f111, 0.2, 0.01, 0.1, 0.33}, Cloth{f111, 0.3, 0.05, 1, 0.1},
        Cloth{{20000}, 0.2, 0.01, 1, 0.2}, Cloth{{8000, 30000, -20000}, 0.1, 0.02, 1, 0.2}}) {
    const LatticeLaws laws =
        lattice_laws(cloth.coefficients, cloth.xi, cloth.eps, cloth.compression, cloth.tested);
    const SpringLaw curve{cloth.coefficients, 1};
    for (double part : {0.003, 0.01, 0.1, 0.37, 0.64, 0.9, 1.0}) {
      const double e = part * cloth.tested;
      EXPECT_NEAR(uniaxial_load(laws, e) / curve.tension(e), 1, 1e-3) << "strain " << e;
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
  const LatticeLaws laws = lattice_laws(f111, xi, eps, 1, 0.1);
  const Stiffness square = stiffness(laws, 1, 1, xi, eps);
  for (double aspect : {0.4, 0.7, 1.0, 1.5, 3.0}) {
    const Stiffness cell = stiffness(laws, 0.008 * aspect, 0.008, xi, eps);
    EXPECT_NEAR(cell.xx / square.xx, 1, 1e-12) << aspect;
    EXPECT_NEAR(cell.yy / square.yy, 1, 1e-12) << aspect;
    EXPECT_NEAR(cell.xy / square.xy, 1, 1e-12) << aspect;
    EXPECT_NEAR(cell.shear / square.shear, 1, 1e-12) << aspect;
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

TEST(Lattice, ImpossibleClothIsRefused) {
  EXPECT_THROW(lattice_laws(f111, 0.6, 0.5, 1, 0.1), Error);
  EXPECT_THROW(lattice_laws({30006, -200000}, 0.2, 0.01, 1, 0.33), Error);
}

}  // namespace
}  // namespace ripstop
