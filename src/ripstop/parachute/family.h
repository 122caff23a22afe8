// A canopy family is one record: its word in the case file and all functions that the program needs. How to
// add one: CONTRIBUTING.md.
#pragma once

#include <any>
#include <concepts>
#include <utility>
#include <vector>

#include "ripstop/parachute/experience.h"
#include "ripstop/parachute/facts.h"

namespace ripstop {
class Fields;
class Findings;
}  // namespace ripstop

namespace ripstop::inline parachute {

class Canopy;
struct CanopyMesh;
struct CutPattern;
struct Design;
struct PartMaterials;

struct CanopyFamily {
  const char* type;     // its word in [parachute]
  const char* example;  // a folder of examples/
  Canopy (*make)();     // with the defaults of its keys
  void (*describe)(Fields& fields, Canopy& canopy);
  void (*check_shape)(const Canopy& canopy, const Design& design, Findings& findings);
  CanopyFacts (*facts)(const Canopy& canopy, int gores);
  Experience (*experience)(const Canopy& canopy);
  CutPattern (*cut_pattern)(const Canopy& canopy, const Design& design);
  CanopyMesh (*build)(const Canopy& canopy, const Design& design, const PartMaterials& materials);
};

/// The struct of the keys of a family names its family: `static const CanopyFamily family;`.
template <class T>
concept CanopyKeys = std::same_as<decltype((T::family)), const CanopyFamily&>;

/// A canopy of any family.
class Canopy {
 public:
  Canopy();  // of the first family of the list
  template <CanopyKeys T>
  Canopy(T keys) : family_(&T::family), keys_(std::move(keys)) {}

  const CanopyFamily& family() const { return *family_; }
  /// The family's own keys; null when T is those of another family.
  template <CanopyKeys T>
  const T* as() const {
    return std::any_cast<T>(&keys_);
  }
  template <CanopyKeys T>
  T* as() {
    return std::any_cast<T>(&keys_);
  }

 private:
  const CanopyFamily* family_;
  std::any keys_;
};

/// The record of the family with the keys T, from the functions of the same names that take a T.
template <class T>
constexpr CanopyFamily family_of(const char* type, const char* example) {
  return {type,
          example,
          [] { return Canopy(T{}); },
          [](Fields& fields, Canopy& canopy) { describe(fields, *canopy.as<T>()); },
          [](const Canopy& canopy, const Design& design, Findings& findings) {
            check_shape(*canopy.as<T>(), design, findings);
          },
          [](const Canopy& canopy, int gores) { return facts(*canopy.as<T>(), gores); },
          [](const Canopy& canopy) { return experience(*canopy.as<T>()); },
          [](const Canopy& canopy, const Design& design) { return cut_pattern(*canopy.as<T>(), design); },
          [](const Canopy& canopy, const Design& design, const PartMaterials& materials) {
            return build_canopy(*canopy.as<T>(), design, materials);
          }};
}

using Families = std::vector<const CanopyFamily*>;
/// The list: families.cpp.
const Families& families();

}  // namespace ripstop::inline parachute
