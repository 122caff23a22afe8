// The pressure drop of air through cloth, from the material to the faces of the flow's grid.
#pragma once

namespace ripstop {

/// dp = a v + b v |v| with v the velocity along the cloth's normal ([NFM] Eq. 15).
struct PressureDrop {
  double linear = 0;     // a [Pa s/m]
  double quadratic = 0;  // b [Pa s2/m2]

  bool operator==(const PressureDrop&) const = default;
};

}  // namespace ripstop
