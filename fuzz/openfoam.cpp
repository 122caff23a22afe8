// What OpenFOAM wrote: fields, label lists, patches, a mesh's points, faces and zones.
#include "reader.h"
#include "ripstop/flow/openfoam/field_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ripstop;
  const fuzz::InMemory file(data, size);
  for (const int components : {1, 3})
    for (const std::size_t count : {2, 3})
      fuzz::told([&] { openfoam::read_field(file.path(), components, count); });
  fuzz::told([&] { openfoam::read_labels(file.path()); });
  fuzz::told([&] { openfoam::read_boundary(file.path()); });
  fuzz::told([&] { openfoam::read_points(file.path()); });
  fuzz::told([&] { openfoam::read_faces(file.path()); });
  fuzz::told([&] { openfoam::read_face_zones(file.path()); });
  return 0;
}
