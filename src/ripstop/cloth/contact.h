// Cloth that does not pass through cloth: nodes of different places of it keep a distance. Internal to cloth/.
//
// Two nodes that lie farther apart on the cloth than `neighbourhood` spacings of the lattice have the potential
// k (d - r)^2 / 2 where their distance r is below d. d is `thickness` spacings, so that layers do not slip through
// each other's meshes: the centre of a square cell is 0.71 spacings from its corners. Pairs that were folded closer
// have that distance for d, so that the folded start has no contact force.
//
// The forces are softer by far than the springs', so they are kicks every few steps (a multiple time step). Every
// node sums its own contacts in order of their numbers: the same to the last bit for any number of threads.
#pragma once

#include <array>
#include <vector>

#include "ripstop/cloth/cloth.h"
#include "ripstop/core/thread_team.h"

namespace ripstop::inline cloth {

/// Data that do not change: compiled once with the cloth. Arrays by node of the cells unless stated
/// otherwise.
struct ContactLayout {
  std::vector<int> slot;
  std::vector<double> spacing;        // of the lattice there [m]
  std::vector<double> mass;           // of tied nodes their own [kg]
  std::vector<Vec3> as_cut, folded;   // positions, from which follow neighbourhood and d
  std::vector<int> piece;             // Patch::piece: nodes of different pieces are no neighbours
  double largest_spacing = 0;         // [m]
  double stiffness_over_spacing = 0;  // k over the spacing [Pa]
  double friction = 0;
  double fastest = 0;  // angular frequency of a node with `usual_contacts` of them, the highest [1/s]
  /// Nodes of the mesh that a contact can move; of each the forces that act on it: those on tied nodes go to their
  /// masters.
  struct Part {
    int index;
    double weight;
  };
  std::vector<int> mover_slot;
  std::vector<double> mover_inverse_mass;
  std::vector<int> first_part;  // of a mover, and one more
  std::vector<Part> parts;
};
ContactLayout contact_layout(const Mesh& mesh, const Cloth& cloth);

/// Contacts of one cloth while it is stepped. Nothing in it has to be kept from call to call, but the list of pairs
/// saves time (step_memory.h).
class Contact {
 public:
  Contact(const ContactLayout& layout, int threads);

  /// Before the kicks of a call: damped() is 0.
  void begin();
  /// Largest number of steps of `dt` that one kick can represent.
  int steps_a_kick(double dt) const;
  /// Called by every rank: changes the velocities by the impulse of the contacts in `interval` [s]. Ends with a
  /// barrier. Where a position is not finite nothing is in contact: the step finds it and throws (check_health).
  void kick(int rank, ThreadTeam& team, ClothState& state, double interval);
  /// By friction and the dampers of all kicks [J].
  double damped() const;

  /// At a state, by one thread.
  ContactReport report(const ClothState& state);

 private:
  struct Pair {
    int other;
    double wanted, stiffness;  // d [m], k [N/m]
  };
  struct Cells {  // into which nodes are sorted, wide enough for pairs to be in neighbouring ones
    double width = 0;
    std::array<int, 3> size{};
    std::vector<int> begin, nodes, of;
    std::vector<Vec3> x;  // of `nodes` [m]
  };
  void gather(int rank, const ClothState& state);
  void sort_into_cells();
  void list_pairs(int rank);
  void add_forces(int rank, double interval);
  void move(int rank, ClothState& state, double interval);
  IndexRange range_of(int rank) const { return part_of(static_cast<int>(x_.size()), rank, threads_); }

  const ContactLayout& layout_;
  int threads_;
  double skin_;  // pairs are listed that much beyond where they touch [m]
  bool listed_ = false, anew_ = true, finite_ = true;
  std::vector<Vec3> x_, v_, listed_at_, force_, lossy_;
  std::vector<double> moved_;  // since the pairs were listed, by rank, squared
  Cells cells_;
  struct Worker {
    std::vector<Pair> pairs;  // of its nodes, one after the other
    std::vector<int> first;
    ContactReport report;
  };
  std::vector<Worker> workers_;
  std::vector<double> lost_;  // by mover [J]
};

}  // namespace ripstop::inline cloth
