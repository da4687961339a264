// Recorded stylus: how it was turned in each step of the servo. What few devices have is written for all steps or for
// none.
#pragma once

#include <recording.pb.h>

#include <cstdint>
#include <span>

#include "control/servo_record.h"
#include "io/value_messages.h"

namespace hl {

/// Recordings before the stylus lack the last values of a DeviceInfo: it had neither wrist nor gripper.
LaterForms laterOfDevice();

void addStylus(std::span<const ServoRecord> records, proto::ServoSteps& out);
/// Of step `i`; the lists agree.
Stylus stylusAt(const proto::ServoSteps& in, int i);
/// Whether the lists are those of `steps` steps, and hold nothing but orientations.
bool stylusAgrees(const proto::ServoSteps& in, std::int64_t steps);

}  // namespace hl
