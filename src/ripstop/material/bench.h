// A test campaign: its records, the tested material, and its other known properties.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/core/table/table.h"
#include "ripstop/material/curve_fit.h"

namespace ripstop {
class Fields;
}

namespace ripstop::inline material {

enum class BenchKind { fabric, line, tape };
enum class WeftChoice { automatic, same, separate };

/// [[coupon]]: one record, and the data that its header does not contain.
struct BenchCoupon {
  std::string file;      // relative to the campaign's file
  std::string specimen;  // its name or number in a file with several; empty: all of them
  std::optional<double> orientation_deg, length_m, width_m;
  std::string force_column, displacement_column, force_unit, displacement_unit;
};

/// [[flow]]: one reading of an air permeability tester, velocity or CFM per square foot.
struct BenchFlow {
  double pressure_pa = 124.5;
  std::optional<double> velocity_m_s, cfm;
};

struct Bench {
  std::filesystem::path file;
  BenchKind kind = BenchKind::fabric;
  std::string name, source;
  std::optional<double> areal_density_kg_m2, linear_density_kg_m, thickness_m, width_m;
  int degree = 0;  // 0: degree_rule chooses
  DegreeRule degree_rule = DegreeRule::cross_validation;
  double wanted_r2 = 0.95;
  double working_strain = 0.05;
  double confidence = 0.95;
  bool zero_offset = true;
  bool single_samples = false;
  WeftChoice weft = WeftChoice::automatic;
  double compression = 1;
  std::optional<double> shear_fraction, bending_fraction;
  std::string columns;  // as --columns of the command line, for all records
  table::Decimal decimal = table::Decimal::automatic;
  std::vector<BenchCoupon> coupons;
  std::vector<BenchFlow> flows;
};

void describe(Fields& fields, BenchCoupon& coupon);
void describe(Fields& fields, BenchFlow& flow);
void describe(Fields& fields, Bench& bench);

/// Throws InputError(usage) with every problem in the file, Error(io).
Bench read_bench(const std::filesystem::path& file);

}  // namespace ripstop::inline material
