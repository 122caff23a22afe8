// Reads files of OpenFOAM: fields and label lists, binary or ASCII.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "ripstop/core/vec3.h"

namespace ripstop::inline flow::openfoam {

/// Values of one field on cells (or inner faces) and patches, `components` numbers a value. A uniform list is
/// kept as one value: see at().
struct FieldData {
  int components = 1;
  std::vector<double> inner;
  std::map<std::string, std::vector<double>> patches;  // those that store a value

  /// Number `component` of value `index` in a list that may be uniform.
  double at(const std::vector<double>& list, std::size_t index, int component = 0) const {
    const std::size_t count = static_cast<std::size_t>(components);
    return list[(list.size() == count ? 0 : index * count) + static_cast<std::size_t>(component)];
  }
};

/// Throws Error(io) that names the file when it is missing, incomplete, or inconsistent with its header.
/// `count`: the number of inner values that must be there (or one uniform value).
FieldData read_field(const std::filesystem::path& path, int components, std::size_t count);
/// A polyMesh/owner or cellProcAddressing file.
std::vector<int> read_labels(const std::filesystem::path& path);

/// polyMesh/points.
std::vector<Vec3> read_points(const std::filesystem::path& path);

/// Face n has the corners from begins[n] to begins[n + 1].
struct FaceList {
  std::vector<int> begins, corners;
};
/// polyMesh/faces in binary.
FaceList read_faces(const std::filesystem::path& path);

struct FaceZone {
  std::string name;
  std::vector<int> faces;
};
/// polyMesh/faceZones; which way the faces look is left out.
std::vector<FaceZone> read_face_zones(const std::filesystem::path& path);

struct Patch {
  std::string name;
  int start = 0;  // first face
  int faces = 0;
};
/// polyMesh/boundary.
std::vector<Patch> read_boundary(const std::filesystem::path& path);

}  // namespace ripstop::inline flow::openfoam
