// Properties of a case that need no solver: `ripstop check`.
#pragma once

#include <string>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/case/summary.h"
#include "ripstop/core/members.h"
#include "ripstop/core/toml/problem.h"

namespace ripstop::inline run {

template <Of<Problem> T, class Visit>
void each_member(T& p, Visit&& visit) {
  visit("file", p.origin.file);
  visit("line", p.origin.line);
  visit("column", p.origin.column);
  visit("option", p.origin.option);
  visit("key", p.key);
  visit("value", p.value);
  visit("allowed", p.allowed);
  visit("message", p.message);
}

template <Of<PartMasses> T, class Visit>
void each_member(T& m, Visit&& visit) {
  visit("cloth", m.cloth);
  visit("tape", m.tape);
  visit("lines", m.lines);
  visit("riser", m.riser);
  visit("total", m.total);
}
template <Of<CaseSummary> T, class Visit>
void each_member(T& s, Visit&& visit) {
  visit("nominal_area_m2", s.nominal_area);
  visit("computed_area_m2", s.computed_area);
  visit("meshed_area_m2", s.cloth_area);
  visit("vent_area_m2", s.vent_area);
  visit("slot_area_m2", s.slot_area);
  visit("geometric_porosity", s.geometric_porosity);
  visit("mass_kg", s.mass);
  visit("nodes", s.nodes);
  visit("cloth_nodes", s.cloth_nodes);
  visit("resolved_cloth_nodes", s.resolved_cloth_nodes);
  visit("springs", s.springs);
  visit("smallest_spring_m", s.smallest_spring);
  visit("smallest_spring_part", s.smallest_part);
  visit("stable_step_s", s.step.stable_step);
  visit("stable_step_part", s.step.part);
  visit("printed_step_s", s.step.printed_step);
  visit("flow_cells", s.flow_cells);
  visit("flow_spacing_m", s.flow_spacing);
  visit("memory_bytes", s.memory);
  visit("core_time_s", s.core_time);
  visit("blockage", s.blockage);
  visit("speed_m_s", s.air.speed);
  visit("density_kg_m3", s.air.density);
  visit("air_from", s.air_source);
  visit("deployment_speed_m_s", s.deployment.speed);
  visit("deployment_speed_from", s.deployment.from);
}

struct CheckResult {
  CaseSummary summary;
  std::vector<Source> sources;        // of every key whose value follows from others
  std::vector<std::string> warnings;  // known before a run
  Settings resolved;
};

/// Throws as summarize().
CheckResult run_check(const Settings& resolved);

/// The report of `ripstop check --json`.
std::string to_json(const CheckResult& result);
/// The same of a case that InputError found wrong.
std::string to_json(const std::vector<Problem>& problems);

}  // namespace ripstop::inline run
