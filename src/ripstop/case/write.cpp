// A case as text: resolved case, schema, reference.
#include "ripstop/core/toml/write.h"

#include "ripstop/case/case.h"
#include "ripstop/core/build_info.h"

namespace ripstop {
namespace {

Fields fields_of(Case& value) {
  Fields fields;
  describe(fields, value);
  return fields;
}

}  // namespace

Case resolved(const Case& value) {
  Case full = value;
  full.parachute.nominal_area_m2 = nominal_area(value.parachute);
  full.parachute.lines.onto_disk_m = line_length_on_disk(value.parachute);
  full.flow.density_kg_m3 = air(value).density;
  full.flow.canopy_position_m = canopy_position(value);
  return full;
}

std::string case_toml(const Case& value) {
  Case full = resolved(value);
  return "# A case with every default written out, by Ripstop " + version() + ".\n" +
         to_toml(fields_of(full));
}

std::string case_json(const Case& value) {
  Case full = resolved(value);
  return to_json(fields_of(full));
}

std::string case_schema() {
  Case scratch;
  return json_schema(fields_of(scratch), "Ripstop case file");
}

std::string case_reference() {
  Case scratch;
  return reference_tables(fields_of(scratch));
}

}  // namespace ripstop
