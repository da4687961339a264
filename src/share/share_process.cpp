#include "share/share_process.h"

namespace hl {

std::optional<SharePacket> ShareProcess::receive() {
  while (const auto message = process_.receive(buffer_)) {
    if (auto packet = sharePacketOf(*message)) return packet;
  }
  return std::nullopt;
}

}  // namespace hl
