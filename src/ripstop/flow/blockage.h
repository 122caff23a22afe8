// Effect of a tunnel on the drag of a body by classic theory. docs/theory/tunnel.md.
#pragma once

namespace ripstop::inline flow {

/// A porous disk of loss coefficient K = dp / (rho u^2 / 2) that fills the share `blockage` of a closed test section;
/// momentum theory with one pressure downstream for the wake and the air around it. 0: Taylor's K / (1 + K / 4)^2.
/// Based on the speed upstream. Throws Error(not_converged) for K above about 4, where the wake would stop.
double porous_disk_drag(double loss, double blockage);

/// Maskell (ARC R&M 3400) for a bluff body between walls: measured over free-air drag, 1 / (1 + C_D b /
/// Cp_b) at the blockage b, with drag and base pressure coefficient (below 0) of free air.
double maskell_ratio(double drag_coefficient, double base_pressure, double blockage);

/// Glauert's first order (ARC R&M 1566) of a body in a round open jet, its boundary far upstream and
/// downstream of it: the change of speed over the jet's, -0.1825 V / C^(3/2), with V = doublet strength over
/// speed [m3] and C the jet's area [m2]. (His tau = -0.206 is on a sphere's cross-section: 0.206 sqrt(pi) / 2.)
double open_jet_speed_change(double effective_volume, double jet_area);

/// Doublet strength over speed of a prolate spheroid along the stream, its volume and its added mass's [m3].
double spheroid_effective_volume(double length, double diameter);

}  // namespace ripstop::inline flow
