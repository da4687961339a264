// Steps of the servo between their records and the messages of a recording.
#pragma once

#include <recording.pb.h>

#include <span>
#include <vector>

#include "control/servo_record.h"

namespace hl {

/// Consecutive steps, at least one; `first` is the number of the first.
void toProto(std::span<const ServoRecord> records, std::uint64_t first, proto::ServoSteps& out);
/// `before` is known of the first only: the rest follows from it. Throws hl::Error when the message does not fit.
std::vector<ServoRecord> fromProto(const proto::ServoSteps& in);

}  // namespace hl
