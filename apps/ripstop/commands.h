// The commands of the program, one small file each. A command sets `status`, the program's exit code.
#pragma once

namespace CLI {
class App;
}

namespace ripstop::cli {

void add_check(CLI::App& app, int& status);
void add_materials(CLI::App& app, int& status);
void add_schema(CLI::App& app, int& status);
void add_steady(CLI::App& app, int& status);
void add_fabric(CLI::App& app, int& status);
void add_fit(CLI::App& app, int& status);
void add_coupon(CLI::App& app, int& status);
void add_inflate(CLI::App& app, int& status);
void add_pattern(CLI::App& app, int& status);
void add_flow_parity(CLI::App& app, int& status);
void add_calibrate(CLI::App& app, int& status);
void add_calibrate_porosity(CLI::App& parent, int& status);
void add_stability(CLI::App& app, int& status);
void add_sweep(CLI::App& app, int& status);
void add_compare(CLI::App& app, int& status);
void add_photogrammetry(CLI::App& app, int& status);
void add_compare_flight(CLI::App& app, int& status);
void add_import(CLI::App& app, int& status);
void add_descent(CLI::App& app, int& status);
void add_recovery(CLI::App& app, int& status);
void add_report(CLI::App& app, int& status);
void add_fly(CLI::App& app, int& status);
void add_load(CLI::App& app, int& status);
void add_size(CLI::App& app, int& status);
void add_studio(CLI::App& app, int& status);
void add_export(CLI::App& app, int& status);

}  // namespace ripstop::cli
