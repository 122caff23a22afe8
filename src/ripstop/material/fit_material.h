// A whole test campaign fitted: curves of every direction, coefficients, and the material they make.
#pragma once

#include <string>
#include <vector>

#include "ripstop/material/bench.h"
#include "ripstop/material/clean.h"
#include "ripstop/material/curve_fit.h"
#include "ripstop/material/library.h"
#include "ripstop/material/permeability.h"

namespace ripstop::inline material {

/// The records of one direction of pull.
struct DirectionFit {
  std::string name;  // "warp", "weft", "bias", "line", "tape"
  double orientation = 0;
  std::vector<CleanRecord> samples;
  MeanCurve curve;
  CurveFit fit;
};

struct RecordOrigin {
  std::string file, hash;
};

struct MaterialFit {
  Material material;
  std::vector<DirectionFit> directions;
  bool weft_differs = false;
  PermeabilityFit permeability;  // when the campaign has readings
  bool has_permeability = false;
  std::vector<std::string> notes;     // decisions and their reasons
  std::vector<std::string> warnings;  // also kept in the material, for the solver to repeat
  std::vector<RecordOrigin> inputs;
  std::vector<std::string> understood;  // how each column of the records was read

  const DirectionFit* direction(const std::string& name) const;  // null: none
};

/// Reads, cleans and fits every record of the campaign. xi and eps are those of the campaign or the defaults;
/// calibration/coupon_fit.h finds them. Throws Error(bad_data) for inconsistent records: see read_record(),
/// clean_record(), mean_curve(); for one sample only; for a record that is a copy of another; for a strength per mass
/// that no fibre has or a density that no cloth has, which indicates units wrong by a factor of 1000.
MaterialFit fit_material(const Bench& bench);

/// As a material keeps them: no longer than its file takes.
std::string joined_warnings(const std::vector<std::string>& warnings);

/// Warnings of a run that reaches `largest_strain` in this material: those of the fit, a strain beyond the tests, and a
/// strength that no fibre has.
std::vector<std::string> material_warnings(const Material& material, double largest_strain);

}  // namespace ripstop::inline material
