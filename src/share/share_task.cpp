#include "share/share_task.h"

#include <algorithm>
#include <charconv>
#include <cstring>

#include "base/error.h"
#include "base/printable.h"

namespace hl {

namespace {

constexpr const char* kServe = "--serve";

bool isOfName(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; }

/// Before the bytes of a packet.
struct Head {
  std::uint64_t lane, key;
};

}  // namespace

void checkShareName(const std::string& name, const char* what) {
  checkPrintable(name, what);
  if (name.empty() || name.size() > kMaxShareName || !std::all_of(name.begin(), name.end(), isOfName))
    throw Error(std::string(what) + " is '" + name + "': it is made of 1 to " + std::to_string(kMaxShareName) +
                " letters, digits and _");
}

std::string shareNameLike(const std::string& name) {
  std::string like = name.substr(0, std::min(name.find('.'), kMaxShareName));
  std::replace_if(
      like.begin(), like.end(), [](char c) { return !isOfName(c); }, '_');
  return like.empty() ? "server" : like;
}

std::vector<std::string> wordsOf(const ShareTask& task) {
  std::vector<std::string> words{kServe, task.version, std::to_string(task.domain), task.world,
                                 std::to_string(task.server)};
  const std::vector<std::string> reach = wordsOf(task.reach);
  words.insert(words.end(), reach.begin(), reach.end());
  return words;
}

ShareTask shareTaskOf(const std::vector<std::string>& words) {
  const Error none("it shares worlds for hld and hl, which start it by themselves: try hld --share lab");
  if (words.size() < 5 || words[0] != kServe) throw none;
  ShareTask task{words[1], ddsDomainOf(words[2], "the domain"), words[3], 0};
  const std::string& id = words[4];
  const auto [end, error] = std::from_chars(id.data(), id.data() + id.size(), task.server);
  if (error != std::errc() || end != id.data() + id.size() || task.server == 0) throw none;
  checkShareName(task.world, "the world");
  auto word = words.begin() + 5;
  if (!readReach(words, word, task.reach) || word != words.end()) throw none;
  checkReach(task.reach, kShareUse);
  return task;
}

std::string shareTopic(const std::string& world, Lane lane, ServerId to) {
  const std::string begin = "hl/" + world + "/";
  if (lane == Lane::kItems) return begin + "items";
  if (lane == Lane::kStream) return begin + "stream";
  return begin + "inbox/" + std::to_string(to);
}

std::string bytesOf(const SharePacket& packet) {
  const Head head{static_cast<std::uint64_t>(packet.lane), packet.key};
  std::string bytes(sizeof head, '\0');
  std::memcpy(bytes.data(), &head, sizeof head);
  return bytes + packet.bytes;
}

std::optional<SharePacket> sharePacketOf(std::span<const char> bytes) {
  Head head;
  if (bytes.size() < sizeof head || bytes.size() > kMaxShareMessage_bytes) return std::nullopt;
  std::memcpy(&head, bytes.data(), sizeof head);
  if (head.lane > static_cast<std::uint64_t>(Lane::kInbox)) return std::nullopt;
  const auto rest = bytes.subspan(sizeof head);
  return SharePacket{static_cast<Lane>(head.lane), head.key, std::string(rest.begin(), rest.end())};
}

}  // namespace hl
