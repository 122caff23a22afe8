// Small meshes by hand, and the scalar kernel that the vector one is held against.
#pragma once

#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "../f111_curve.h"
#include "ripstop/cloth/cloth.h"
#include "ripstop/material/lattice.h"

namespace ripstop::testing {

inline constexpr double gravity = 9.81;  // [m/s2]

struct FabricSpec {
  std::vector<double> coefficients = f111_curve;  // of the axial springs, [N/m]
  double xi = 0.2, eps = 0.01;
  double compression = 1;
  double buckling_strain = std::numeric_limits<double>::infinity();
  double damping = 0;
  double areal_density = 0.0407;
};

/// rows x columns nodes; position(row, column) is where a node starts, rest(row, column) where it has no
/// tension (absent: the start). Widths by cell_widths from the rest shape, laws split by xi and eps.
struct PatchSpec {
  std::string name = "patch";
  int rows = 0, columns = 0;
  bool periodic = false;
  std::function<Vec3(int row, int column)> position;
  std::function<Vec3(int row, int column)> rest;
  std::function<bool(int row, int column)> has_cell = [](int, int) { return true; };
};
/// Adds the patch with its nodes at the end of the mesh; returns its index.
int add_patch(Mesh& mesh, const PatchSpec& spec, const FabricSpec& fabric);

/// Flat, in the plane z = 0, rows along y.
Mesh rectangle(int rows, int columns, double spacing, const FabricSpec& fabric = {});

/// Chain of `segments` springs from `a` to `b` in line, the first node fixed; law in N.
Mesh chain(int segments, Vec3 a, Vec3 b, double rest_length, const SpringLaw& law, double linear_density);

/// Flat: a finer strip tied to the edge of a coarser one, as where a canopy's columns are halved.
Mesh tied_strips(const FabricSpec& fabric);

/// Two patches of different fabric joined by ties, with a hole, irregular springs across and a line:
/// everything a canopy has. Nothing is fixed unless `fixed`.
Mesh medley(double damping, bool fixed, int degree = 2);

std::vector<Vec3> shaken(std::vector<Vec3> positions, double amount, unsigned seed);

/// Force on every node from springs, dampers and loads, in the plainest scalar code; tied nodes' forces
/// handed to their masters, where they are then 0.
std::vector<Vec3> reference_forces(const Mesh& mesh, const ClothOptions& options, const Loads& loads,
                                   const std::vector<Vec3>& x, const std::vector<Vec3>& v);
/// Total masses with the tied nodes' handed on.
std::vector<double> reference_masses(const Mesh& mesh);

}  // namespace ripstop::testing
