// The curve of F-111 ripstop nylon, [NFM] Table 3: K_1 and K_2 of the load per width over the strain.
#pragma once

#include <vector>

namespace ripstop {

inline const std::vector<double> f111_curve{30006, -18936};  // [N/m]

}  // namespace ripstop
