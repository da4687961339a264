// ServoRecord: all that goes into one step of the servo and comes out of it, so that the step can be made again.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

#include "base/fields.h"
#include "control/servo.h"

namespace hl {

/// What is done to the servo between two steps.
enum class ServoCommand : std::uint8_t { kNone, kArm, kDisarm, kStall, kJoin };

/// RT-safe.
inline void apply(ServoState& state, ServoCommand command) {
  if (command == ServoCommand::kArm) arm(state);
  if (command == ServoCommand::kDisarm) disarm(state);
  if (command == ServoCommand::kStall) fail(state, FaultReason::kStalled);
  if (command == ServoCommand::kJoin) fail(state, FaultReason::kOtherDevice);
}

struct ServoRecord {
  ServoState before;  ///< of the command
  ServoCommand command = ServoCommand::kNone;
  ServoSettings settings;
  ServoTarget target;
  DeviceSample sample;
  ServoOutput out;
  std::int64_t work_ns = 0;  ///< from the time of the sample to the end of the step
};

template <typename Visit>
void visitFields(ServoState& state, Visit& visit) {
  visitBases<Safety, SpringState>(state, visit);
}
template <typename Visit>
void visitFields(ServoSettings& settings, Visit& visit) {
  visitBases<SafetySettings, SpringSettings>(settings, visit);
}
/// All but the name.
template <typename Visit>
void visitFields(DeviceInfo& info, Visit& visit) {
  boost::pfr::for_each_field(info, [&]<typename T>(T& field) {
    if constexpr (!std::is_same_v<T, std::string>) visitField(field, visit);
  });
}

}  // namespace hl
