// Messages of a shared world: what they hold, checked. Anybody of the world may send anything.
#pragma once

#include <share.pb.h>

#include <optional>
#include <string>

#include "share/contents.h"
#include "share/playout.h"

namespace hl {

/// Of an object that stays where it is, velocity and spin are left out.
void toProto(const ItemMotion& motion, proto::ShareMotion& out);
/// Nothing: it is not rigid, out of reach, or no numbers.
std::optional<ItemMotion> motionOf(const proto::ShareMotion& in);

void toProto(const ContentName& name, proto::ShareName& out);
ContentName nameOf(const proto::ShareName& in);

/// Whether `a` counts where both are received of one object: by epoch, owner and change, in this order.
bool isNewer(const proto::ShareItem& a, const proto::ShareItem& b);
/// Of an object's look: with the rest of its item it fits in a packet.
inline constexpr std::size_t kMaxLook_bytes = 40'000;
/// Whether it makes sense.
bool isItem(const proto::ShareItem& item);

/// Whether a hand of another server can be shown.
bool isHand(const proto::OtherDevice& hand);

/// A packet that is no message has no body.
proto::ShareMessage messageOf(const std::string& bytes);

}  // namespace hl
