// The keys of [deployment].
#include "ripstop/case/case.h"
#include "ripstop/core/toml/fields.h"

namespace ripstop::inline cases {
namespace {

void describe_container(Fields& fields, DeploymentKeys& keys) {
  using Container = DeploymentKeys::Container;
  fields.choice("container", keys.container, {{"bag", Container::bag}, {"wrap", Container::wrap}},
                "Container of the packed canopy. A wrap has other default values of mass and strip force.");
  fields.number("mass_kg", keys.mass_kg, from(0).up_to(1000), "Mass of the empty container.")
      .absent("10 % of the parachute's mass for a bag, 3 % for a wrap");
  fields
      .number("drag_area_m2", keys.drag_area_m2, from(0).up_to(100),
              "C_D S of the packed container in the stream.")
      .absent("area of one side of a cube with the packed volume");
  fields
      .number("length_m", keys.length_m, above(0).up_to(100),
              "Length of the packed canopy along the path, for a check: it must be shorter than lines and "
              "riser together, and shorter than 0.9 times the length of the canopy.")
      .absent("not checked");
}

void describe_extraction(Fields& fields, DeploymentKeys& keys) {
  fields
      .number("pilot_drag_area_m2", keys.pilot_drag_area_m2, from(0).up_to(1000),
              "C_D S of the pilot chute or drogue that pulls the container.")
      .absent("0 with relative_speed_m_s or ejection_impulse_n_s, else 1.5 % of S0");
  fields
      .number("pilot_mass_kg", keys.pilot_mass_kg, from(0).up_to(1000), "Mass of the pilot chute or drogue.")
      .absent("5 % of the parachute's mass where there is a pilot chute");
  fields
      .number("relative_speed_m_s", keys.relative_speed_m_s, from(0).up_to(200),
              "Speed at which the container leaves the payload.")
      .absent("from ejection_impulse_n_s, else 0");
  fields
      .number("ejection_impulse_n_s", keys.ejection_impulse_n_s, from(0).up_to(1e5),
              "Impulse of a mortar, a spring or a charge between payload and packed parachute.")
      .absent("from relative_speed_m_s");
}

}  // namespace

void describe(Fields& fields, DeploymentKeys& keys) {
  using Order = DeploymentKeys::Order;
  fields.choice("order", keys.order,
                {{"lines-first", Order::lines_first}, {"canopy-first", Order::canopy_first}},
                "Part that leaves the container first.");
  describe_container(fields, keys);
  fields
      .number("strip_force_n", keys.strip_force_n, from(0).up_to(1e5),
              "Force that pulls the canopy out of its bag, or that unrolls it from its wrap.")
      .absent("weight of the canopy for a bag, half of it for a wrap");
  fields
      .number("line_force_n", keys.line_force_n, from(0).up_to(1e5),
              "Force that pulls the lines out of their stows.")
      .absent("weight of lines and riser");
  describe_extraction(fields, keys);
}

}  // namespace ripstop::inline cases
