// A case as text: resolved case, schema, reference page.
#include "ripstop/core/toml/write.h"

#include "ripstop/case/settings.h"
#include "ripstop/core/build_info.h"

namespace ripstop::inline cases {
namespace {

Fields fields_of(Case& bound) {
  Fields fields;
  describe(fields, bound);
  return fields;
}

}  // namespace

std::string case_toml(const Settings& resolved) {
  Case written = resolved.written();
  return "# A case with all defaults filled in, by Ripstop " + version() + ".\n" +
         to_toml(fields_of(written));
}

std::string case_json(const Settings& resolved) {
  Case written = resolved.written();
  return to_json(fields_of(written));
}

std::string case_schema() {
  Case scratch;
  return json_schema(fields_of(scratch), "Ripstop case file");
}

std::string case_reference() {
  Case scratch;
  return "# All keys of a case file\n\n"
         "`ripstop schema --reference` prints this page. [The case file](../guide/case-file.md) explains\n"
         "the use of the keys and the source of the default values. All values are in SI units.\n\n" +
         reference_tables(fields_of(scratch));
}

}  // namespace ripstop::inline cases
