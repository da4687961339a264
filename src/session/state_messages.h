// What the loops did, as messages of proto/hl.proto: for pages and for HL clients.
#pragma once

#include <hl.pb.h>

#include "io/vec_messages.h"
#include "touch/touch_session.h"

namespace hl {

void toProto(const TouchSession& session, proto::DeviceInfo& out);
void toProto(const LoopSummary& loop, const LoopTotals& totals, proto::LoopStats& out);
void toProto(const VibrationView& vibration, proto::Vibration& out);
void toProto(const EndingCounts& ended, proto::TicksEnded& out);
void toProto(const ProxyContact& contact, proto::ContactPlane& out);
void toProto(const HoldingSnap& snap, proto::HoldingSnap& out);
/// The proxy's ledger and the servo's, which books late hand-over, as one.
void toProto(const Ledger& ledger, const Ledger& late, LedgerMode mode, proto::Ledger& out);
/// Of a proto::State or a proto::ClientState.
template <typename Message>
void setEndings(const EndingCounts& ended, Message& out) {
  out.set_iteration_caps(ended.capped());
  out.set_unplaced_ticks(ended[Ending::kUnplaced]);
  toProto(ended, *out.mutable_ticks_ended());
}
/// All that a client is sent, but whether it is the master.
void toProto(const TouchSession& session, const ServoView& servo, const ProxyView& proxy, proto::ClientState& out);
/// What the device has done since its moment `next`, which is what comes next then.
void addMoments(const TouchSession& session, std::uint64_t& next, proto::ClientState& out);

}  // namespace hl
