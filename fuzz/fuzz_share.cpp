// Packets of a shared world, from servers that may send anything: what the world then has, what it sends, and what is
// made of an object that they publish. Of each packet three bytes come first: milliseconds, and its length.
#include <vector>

#include "base/error.h"
#include "require.h"
#include "share/item_content.h"
#include "share/share_messages.h"
#include "share/shared_world.h"

namespace {

using namespace hl;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::size_t kHead_bytes = 3, kMaxPackets = 64;

struct Heard {
  std::int64_t after_ns;
  std::string bytes;
};

std::vector<Heard> packetsOf(const std::uint8_t* data, std::size_t size) {
  std::vector<Heard> packets;
  std::size_t at = 0;
  while (at + kHead_bytes <= size && packets.size() < kMaxPackets) {
    const std::size_t length = std::min<std::size_t>(data[at + 1] | data[at + 2] << 8, size - at - kHead_bytes);
    packets.push_back({data[at] * kMs, std::string(reinterpret_cast<const char*>(data) + at + kHead_bytes, length)});
    at += kHead_bytes + length;
  }
  return packets;
}

LocalItems ownItems(Contents& contents) {
  static const auto bytes = std::make_shared<const std::string>("a shape");
  const ContentName name = nameOf(*bytes);
  contents.keep(name, bytes);
  static const auto content = [&] {
    auto made = std::make_shared<proto::ShareContent>();
    toProto(name, *made->mutable_shape());
    toProto(name, *made->mutable_surfaces());
    made->set_body(true);
    return made;
  }();
  return {{1, {content, {}}}};
}

void requireSound(const SharedWorld& world, std::int64_t now_ns) {
  for (const Replica& replica : world.replicas(now_ns))
    fuzz::require(replica.id != 0 && replica.pose.origin.allFinite() && replica.pose.rotation.allFinite());
  const ShareCounts counts = world.counts(now_ns);
  fuzz::require(counts.items <= SharedWorld::kMaxItems && counts.peers <= Peers::kMaxPeers);
}

void hearAll(const std::vector<Heard>& packets) {
  std::int64_t now_ns = 1000 * kMs;
  SharedWorld world({7, "fuzzer", true, "0"}, now_ns, [](const SharePacket& packet) {
    fuzz::require(packet.bytes.size() <= kMaxPacket_bytes);
    return true;
  });
  for (const Heard& packet : packets) {
    now_ns += packet.after_ns;
    world.hear({Lane::kStream, 0, packet.bytes}, now_ns);
    world.publish(ownItems(world.contents()), true, now_ns);
    world.press({2, Vec3::UnitX(), Vec3::Zero(), 0.01});
    world.step(now_ns);
    for (const ItemPush& push : world.takePushes()) fuzz::require(push.impulse_N_s.allFinite());
    for (const ReturnedItem& item : world.takeReturned()) fuzz::require(item.motion.pose.origin.allFinite());
  }
  requireSound(world, now_ns);
}

// The first one publishes an object, the others are its contents.
void readItem(const std::vector<Heard>& packets) {
  if (packets.size() < 3) return;
  const proto::ShareMessage message = messageOf(packets[0].bytes);
  try {
    const Instance item = ItemReader().read(message.item().content(), packets[1].bytes, packets[2].bytes);
    fuzz::require(item.shape != nullptr && item.surfaces != nullptr);
  } catch (const Error&) {  // it makes no sense, and nothing has changed
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::vector<Heard> packets = packetsOf(data, size);
  hearAll(packets);
  readItem(packets);
  return 0;
}
