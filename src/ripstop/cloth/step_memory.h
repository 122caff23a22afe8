// Data that calls of step() over the same cloth share: the list of pairs in contact, which remains valid while no node
// has moved far. The results do not depend on it.
#pragma once

#include <memory>

#include "ripstop/cloth/cloth.h"

namespace ripstop::inline cloth {

class Contact;
struct ContactLayout;

struct StepMemory {
  std::shared_ptr<const ContactLayout> layout;  // of `contact`
  std::shared_ptr<Contact> contact;             // none before the first step, or without contact
  int threads = 0;                              // of `contact`
};

/// step() of cloth.h with the memory of an earlier call.
void step(ClothState& state, const Cloth& cloth, const Loads& loads, double dt, int count, ThreadTeam& team,
          StepRecord* record, StepMemory& memory);

}  // namespace ripstop::inline cloth
