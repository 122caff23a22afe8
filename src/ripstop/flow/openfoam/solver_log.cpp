#include "ripstop/flow/openfoam/solver_log.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace ripstop::inline flow::openfoam {
namespace {

bool contains(const std::string& line, const char* text) {
  return line.find(text) != std::string::npos;
}

bool read_vector(const std::string& line, Vec3& value) {
  const std::size_t open = line.find('(');
  if (open == std::string::npos) return false;
  const char* at = line.c_str() + open + 1;
  for (double* part : {&value.x, &value.y, &value.z}) {
    char* end = nullptr;
    *part = std::strtod(at, &end);
    if (end == at) return false;
    at = end;
  }
  return true;
}

}  // namespace

void SolverLog::residual(const std::string& line) {
  const std::size_t name = line.find("Solving for ") + 12;
  field_ = line.substr(name, line.find(',', name) - name);
  const char* key = "Initial residual = ";
  const std::size_t at = line.find(key);
  if (at == std::string::npos) return;
  const double value = std::strtod(line.c_str() + at + std::char_traits<char>::length(key), nullptr);
  if (!std::isfinite(value)) not_a_number_ = true;
  if (field_ == "Ux") now_.residual_u = value;
  if (field_ == "Uy" || field_ == "Uz") now_.residual_u = std::max(now_.residual_u, value);
  if (field_ == "p") now_.residual_p = value;
  if (field_ == "k") now_.residual_k = value;
  if (field_ == "omega") now_.residual_omega = value;
  if (field_ == "e") now_.residual_e = value;
}

bool SolverLog::feed(const std::string& line) {
  if (fatal_lines_ > 0) {
    --fatal_lines_;
    if (!line.empty()) fatal_ += (fatal_.empty() ? "" : " | ") + line;
  }
  if (contains(line, "FOAM FATAL")) fatal_lines_ = 8;
  if (contains(line, "sigFpe::sigHandler")) trap_ = true;
  if (contains(line, "bad_alloc") || contains(line, "Cannot allocate memory")) out_of_memory_ = true;
  if (contains(line, "SIMPLE solution converged")) converged_ = true;

  if (line.starts_with("Time = ")) {
    ++now_.iteration;
    iterating_ = true;
    in_forces_ = false;
  }
  if (contains(line, "Solving for ")) residual(line);
  if (contains(line, "Sum of forces")) in_forces_ = true;
  if (contains(line, "Sum of moments")) in_forces_ = false;

  bool complete = false;
  if (in_forces_ && contains(line, forces_ == Forces::pressure ? "Pressure" : "Porous")) {
    if (!read_vector(line, force_) || !is_finite(force_)) not_a_number_ = true;
    now_.drag = parts_ * force_.z;
    complete = true;
  }
  if (forces_ == Forces::none && line.starts_with("ExecutionTime")) complete = true;
  if (!complete || !iterating_) return false;
  iterating_ = false;
  done_ = now_;
  return true;
}

}  // namespace ripstop::inline flow::openfoam
