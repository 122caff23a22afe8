// The materials a parachute is made of: plain tables, one struct for each TOML table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ripstop/material/permeability.h"

namespace ripstop::inline material {

/// How cloth resists the air that passes it: `paper`, as porous cells; `sheet`, as a pressure drop across it.
enum class PorosityModel { paper, sheet };

/// Of the cells that the cloth cuts, -(mu d + rho |u| f / 2) u per volume (`paper`).
struct PorousCellLaw {
  double darcy = 0;        // d [1/m2]
  double forchheimer = 0;  // f [1/m]
};

/// The permeability of a cloth as its keys give it, in one of three forms.
struct ClothResistance {
  std::optional<double> pressure_drop_linear_pa_s_m, pressure_drop_quadratic_pa_s2_m2;
  std::optional<double> permeability_cfm;             // see law_of_cfm()
  std::optional<double> darcy_1_m2, forchheimer_1_m;  // of porous cells
};
/// That the keys are for; a case may use them with the other.
PorosityModel model_of(const ClothResistance& cloth);
/// The cloth's own pressure drop, and the resistance of the cells that it cuts. [NFM] types a and b of a pressure drop
/// as d and f of cells, as they are; keys of the other model are taken so too.
PressureDrop as_sheet(const ClothResistance& cloth);
PorousCellLaw as_cells(const ClothResistance& cloth);

/// Of cloth and tape in steady runs with the `sheet` model and in openings. Assumed: 0.03 N/m for F-111, Euler's load
/// pi^2 B / w^2 of a strip w = 36 mm wide with B = 4e-6 N m; any value well below the strains of use gives the same
/// shape.
inline constexpr double wrinkling_strain = 1e-6;

/// Canopy cloth. The coefficients are those of the cloth's own curve (load per width against strain,
/// [N/m]) as a uniaxial pull along a yarn gives it; the lattice's are derived from them so that a
/// virtual coupon returns it.
struct Fabric {
  std::string name;
  std::string source;
  std::string warning;                        // doubts about its fit; every run repeats them
  std::vector<double> coefficients_n_m;       // K_1..K_n along the warp [N/m]
  std::vector<double> weft_coefficients_n_m;  // the same along the weft; empty: as the warp
  double shear_fraction = 0.2;                // xi
  double bending_fraction = 0.01;             // eps
  double compression = 1;                     // stiffness for e < 0 relative to K_1; see SpringLaw
  std::optional<double> buckling_strain;      // absent: see wrinkling_strain
  double damping_n_s_m = 0;                   // C of the relative damping of one spring [N s/m]
  double areal_density_kg_m2 = 0;
  double thickness_m = 0;
  double tested_strain = 0;   // the fit is valid up to here; 0: unknown
  double break_load_n_m = 0;  // 0: unknown
  ClothResistance resistance;
};

/// Suspension or riser line: T(e) = sum K_k e^k with K_k in N.
struct Line {
  std::string name;
  std::string source;
  std::string warning;
  std::vector<double> coefficients_n;  // K_1..K_n [N]
  double bending_fraction = 0.01;      // eps of the +-2 springs
  double compression = 0;              // a line goes slack
  double damping_n_s_m = 0;
  double linear_density_kg_m = 0;
  double tested_strain = 0;
  double break_load_n = 0;
};

/// Reinforcement tape on seams and hems: coefficients per width, [N/m].
struct Tape {
  std::string name;
  std::string source;
  std::string warning;
  std::vector<double> coefficients_n_m;
  double width_m = 0;
  double linear_density_kg_m = 0;
  double thickness_m = 0;
  double compression = 1;
  std::optional<double> buckling_strain;  // absent: see wrinkling_strain
  double damping_n_s_m = 0;
  double tested_strain = 0;
  double break_load_n = 0;  // 0: unknown
};

}  // namespace ripstop::inline material
