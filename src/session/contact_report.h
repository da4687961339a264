// ContactReport: where and how strongly the hand has pressed since the last report, for clients that move or deform
// what they draw by the forces on it.
#pragma once

#include <hl.pb.h>

#include <cstdint>

#include "touch/touch_session.h"

namespace hl {

/// What the device has done since its moment `next`, which is what comes next then: mean forces over these steps, by
/// primitive. The sum over the contacts is the mean force on the hand while there were contacts.
void reportContacts(const TouchSession& session, std::uint64_t& next, proto::ContactReport& out);

}  // namespace hl
