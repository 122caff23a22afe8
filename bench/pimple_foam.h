// system/controlDict of a pimpleFoam case whose cloth lies in the patches cloth*.
#pragma once

#include <fmt/format.h>

#include <filesystem>

#include "ripstop/flow/openfoam/case_writer.h"

namespace ripstop {

inline constexpr char pimple_control[] = R"foam(application pimpleFoam;
startFrom startTime;
startTime 0;
stopAt endTime;
endTime {0:.17g};
deltaT {1:.17g};
writeControl timeStep;
writeInterval {2};
writeFormat binary;
writePrecision 12;
writeCompression off;
timeFormat general;
timePrecision 12;
runTimeModifiable false;
functions
{{
    forces
    {{
        type forces;
        libs ("libforces.so");
        patches ("cloth.*");
        rho rhoInf;
        rhoInf {3:.17g};
        CofR (0 0 0);
        log true;
        writeControl timeStep;
        writeInterval 1;
    }}
}}
)foam";

/// So many steps of `length` [s]; the fields are written after the last, the force on the cloth printed after each.
inline void write_pimple_control(const std::filesystem::path& folder, double length, int steps,
                                 double density) {
  openfoam::write_dictionary(folder / "system/controlDict", "dictionary",
                             fmt::format(pimple_control, (steps + 0.5) * length, length, steps, density));
}

}  // namespace ripstop
