#include "share/share_process.h"

#include "ros/packets.h"

namespace hl {

bool ShareProcess::startAgain() {
  waiting_bytes_ = 0;
  return process_.startAgain();
}

bool ShareProcess::send(const SharePacket& packet) {
  const std::size_t waiting_bytes = packet.lane == Lane::kStream ? 0 : packet.bytes.size();
  if (waiting_bytes > 0 && waiting_bytes_ > kMaxWaiting_bytes) return false;
  if (!process_.send(bytesOf(packet))) return false;
  waiting_bytes_ += waiting_bytes;
  return true;
}

std::optional<SharePacket> ShareProcess::receive() {
  while (const auto message = process_.receive(buffer_)) {
    if (const auto taken = packetOf<ShareTaken>(*message)) waiting_bytes_ -= taken->bytes;
    if (auto packet = sharePacketOf(*message)) return packet;
  }
  return std::nullopt;
}

}  // namespace hl
