// materials(), material(): the material library.
#include "ripstop/run/material/materials.h"

#include "members.h"
#include "module.h"

namespace ripstop::python {

void add_materials(py::module_& module) {
  add_class<MaterialLoad>(module, "MaterialLoad", "Load of a material at a strain.");
  add_class<MaterialFlow>(module, "MaterialFlow", "Air through a cloth under a pressure difference.");
  add_class<MaterialEntry>(module, "Material", "A cloth, line or tape of the material library.");
  module.def(
      "materials", [] { return library_materials().materials; },
      "Returns the materials of the library: ripstop materials. Cloth comes first, then lines and tapes.");
  module.def("material", py::overload_cast<const std::string&>(&material_entry), py::arg("name"),
             "Returns a material of the library, or of a material file (.toml): ripstop materials NAME.");
}

}  // namespace ripstop::python
