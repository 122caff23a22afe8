// The checkpoint within an angle of attack: the steps of its averaging window and the flow after them.
#pragma once

#include <cstddef>
#include <optional>

#include "ripstop/core/claimed_folder.h"
#include "ripstop/flow/unsteady.h"
#include "ripstop/run/checkpoint_parts.h"

namespace ripstop::inline run {

class WindowCheckpoint {
 public:
  /// In `window/` of the folder of the angle.
  WindowCheckpoint(ClaimedFolder& folder, double every_s);

  /// The steps of a killed run, whose flow is restored; nothing where there is none. Throws Error(bad_data) for damaged
  /// files.
  std::optional<FlowRecord> resume(Flow& flow);
  /// Saves, unless the last time was less than `every_s` ago.
  void look(const Flow& flow, const FlowRecord& record);
  void remove() const;

 private:
  ClaimedFolder& folder_;
  CheckpointTimer timer_;
  std::size_t next_ = 0;  // which of its two folders the next flow goes to
};

}  // namespace ripstop::inline run
