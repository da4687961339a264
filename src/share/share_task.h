// ShareTask: what hl-share is started with, and how packets go between it and its server.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ros/dds_reach.h"
#include "share/share_link.h"

namespace hl {

struct ShareTask {
  std::string version;       ///< of the program that starts it
  std::uint32_t domain = 0;  ///< of DDS
  std::string world;         ///< see checkShareName()
  ServerId server = 0;       ///< that starts it
  DdsReach reach{};
};

/// The words after the name of hl-share; the task of them, read again. Throws hl::Error for words that are no such.
std::vector<std::string> wordsOf(const ShareTask& task);
ShareTask shareTaskOf(const std::vector<std::string>& words);

/// The name of a world or of a server in it: 1 to kMaxShareName letters, digits and _. Throws hl::Error, which says
/// `what` it is.
void checkShareName(const std::string& name, const char* what);
inline constexpr std::size_t kMaxShareName = 32;
/// A name like this one that is allowed: what is not becomes a _, and what is too much goes; "server" of nothing.
std::string shareNameLike(const std::string& name);

/// The topic of DDS of a lane in this world; of an inbox: that of the server `to`.
std::string shareTopic(const std::string& world, Lane lane, ServerId to = 0);

/// As one message of the socket between a server and hl-share; both are of one version, on one machine.
std::string bytesOf(const SharePacket& packet);
/// Nothing: these are no packet.
std::optional<SharePacket> sharePacketOf(std::span<const char> bytes);
/// From hl-share in the place of a packet: so many bytes of items and inboxes that it was given wait in it no more.
struct ShareTaken {
  std::uint64_t bytes = 0;
};
/// No message is longer.
inline constexpr std::size_t kMaxShareMessage_bytes = kMaxPacket_bytes + 16;

}  // namespace hl
