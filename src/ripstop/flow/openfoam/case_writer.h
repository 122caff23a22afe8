// Writes every dictionary of an OpenFOAM case from checked numbers; no user text goes into one.
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "ripstop/flow/flow.h"
#include "ripstop/flow/openfoam/openfoam.h"

namespace ripstop::inline flow::openfoam {

/// Static pressure at the outlet of a compressible case [Pa].
double outlet_pressure(const Freestream& air);

struct RunControl {
  double start = 0;    // time (iteration) the run starts from
  int iterations = 0;  // at most
};

/// Throws Error(usage) that names the number outside its range, or the feature of the built-in engine. Of a quarter
/// the problem of the whole box is checked; all else takes that of the part that is solved.
void check(const FlowProblem& problem);
void check_run(int iterations, double residual);

/// Throws Error(io) when not all that was written is in the file.
void close_written(std::ofstream& out, const std::filesystem::path& path);

/// One of OpenFOAM's files, with its header. Note for writers: a keyword directly before "(" reads as one word, so
/// there is always a space. Throws Error(io).
void write_dictionary(const std::filesystem::path& path, const std::string& kind, const std::string& body,
                      const std::string& format = "ascii");

/// system/ (without controlDict), constant/, and a README that describes the case and how to run it.
void write_case(const std::filesystem::path& folder, const FlowProblem& problem,
                const OpenFoamSettings& settings);
/// Text of a field by its name: cell values, "nonuniform List<scalar> ...", or values on the patches of
/// cloth, "cloth_low { ... }"; nothing if there are none.
using FieldText = std::function<std::string(const std::string& field)>;
/// The fields in `folder` of a time: the uniform stream where `cells` returns nothing.
void write_fields(const std::filesystem::path& folder, const FlowProblem& problem, bool incompressible,
                  const FieldText& cells = {}, const FieldText& cloth = {});
/// system/controlDict. A file named kStopFile in the case folder makes the solver write and end.
void write_control(const std::filesystem::path& folder, const FlowProblem& problem, bool incompressible,
                   const RunControl& control);
/// system/fvSolution contains the required residual, constant/porosityProperties the resistances. `corrections`:
/// non-orthogonal corrections of the pressure per iteration.
void write_solution(const std::filesystem::path& folder, double residual, int corrections = 0);
void write_resistance(const std::filesystem::path& folder, const std::vector<FlowBody>& bodies);
/// cellZones with one zone a list.
void write_zones(const std::filesystem::path& folder, const std::vector<std::vector<int>>& zones);

/// Patches of a quarter in the planes x = 0 and y = 0.
inline constexpr const char* symmetry_planes[] = {"symmetryX", "symmetryY"};

/// The solver clips the pressure to these multiples of the outlet's while it starts up.
inline constexpr double kLowestPressure = 0.5, kHighestPressure = 2;
inline constexpr const char* kStopFile = "stop";
inline constexpr const char* kReadme = "README.txt";  // its presence marks a case as ours

}  // namespace ripstop::inline flow::openfoam
