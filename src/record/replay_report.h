// What a replay has found.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "control/servo_record.h"

namespace hl {

/// The first step or tick of which something else comes out.
struct ReplayDifference {
  const char* what = "";  ///< "servo step" or "tick"
  std::uint64_t number = 0;
  double time_s = 0;  ///< since the recording began
  std::string text;   ///< what is recorded, and what comes out
};

struct ReplayReport {
  std::string version, device, label, fault;  ///< as recorded; `fault` of a black box
  bool black_box = false;
  std::uint64_t steps = 0, ticks = 0, scenes = 0;
  std::uint64_t lost_steps = 0, lost_ticks = 0;  ///< that the recorder could not keep
  std::uint64_t world_hashes = 0;                ///< of bodies, that were compared
  std::uint64_t unchecked_ticks = 0;             ///< after lost ones: what the proxy did meanwhile is not known
  /// Not checked: hands are at the bodies of which there is no recording, or none from the begin on.
  std::uint64_t ticks_among_hands = 0;
  double first_s = 0, last_s = 0;  ///< times of the first and last step
  std::optional<ReplayDifference> difference;
  std::string end;     ///< why it ends; empty: the program was killed
  std::string damage;  ///< of the file, or empty
};

/// Called with each servo step that the file holds, in order; `time_s` since the recording began.
using StepVisitor = std::function<void(double time_s, const ServoRecord& step)>;

}  // namespace hl
