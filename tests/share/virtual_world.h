// Servers of a shared world in a time and a network of the test's own: each packet takes a delay with jitter and may be
// lost. Those of the stream are gone then; others come a round trip later for each loss, in order, as DDS has it.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <queue>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/splitmix64.h"
#include "share/shared_world.h"

namespace hl::test {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kFrame_ns = 16'666'667;

struct Line {
  std::int64_t delay_ns = 0, jitter_ns = 0;
  double loss = 0;
};

class VirtualNet {
 public:
  explicit VirtualNet(Line line, std::uint32_t seed = 1) : line_(line), random_(seed) {}

  struct Node {
    ShareSelf self;
    std::int64_t clock_ns = 0;  ///< how far its clock is ahead
    std::unique_ptr<SharedWorld> world;
    LocalItems local;
    std::map<std::uint64_t, std::string> items;  ///< its last one of each key
    int part = 0;                                ///< nodes of other parts are cut off
  };

  Node& add(const std::string& name, ServerId id, std::int64_t clock_ns = 0, bool adopts = true) {
    auto node = std::make_unique<Node>();
    node->self = {id, name, adopts, "test"};
    node->clock_ns = clock_ns;
    node->world = std::make_unique<SharedWorld>(
        node->self, now_ns_ + clock_ns, [this, raw = node.get()](const SharePacket& p) { return send(*raw, p); });
    for (const auto& other : nodes_) replay(*other, *node);
    nodes_.push_back(std::move(node));
    return *nodes_.back();
  }
  void kill(const Node& node) {
    std::erase_if(nodes_, [&](const auto& one) { return one.get() == &node; });
  }
  void cut(Node& node, int part) {
    node.part = part;
    for (const auto& other : nodes_) {
      if (other.get() == &node || other->part != part) continue;
      replay(*other, node);
      replay(node, *other);
    }
  }
  std::int64_t now_ns() const { return now_ns_; }
  std::int64_t nowOf(const Node& node) const { return now_ns_ + node.clock_ns; }
  const std::vector<std::unique_ptr<Node>>& nodes() const { return nodes_; }

  /// One frame of all nodes; packets come every millisecond of it.
  void frame() {
    for (const auto& node : nodes_) node->world->publish(node->local, true, nowOf(*node));
    const std::int64_t end_ns = now_ns_ + kFrame_ns;
    while (now_ns_ < end_ns) {
      now_ns_ = std::min(now_ns_ + kMs, end_ns);
      deliver();
      for (const auto& node : nodes_) node->world->step(nowOf(*node));
    }
  }
  void run(double seconds) {
    const std::int64_t end_ns = now_ns_ + static_cast<std::int64_t>(1e9 * seconds);
    while (now_ns_ < end_ns) frame();
  }

 private:
  struct Flight {
    std::int64_t time_ns;
    std::uint64_t number;
    ServerId to, from;
    SharePacket packet;
    bool operator>(const Flight& other) const {
      return std::make_pair(time_ns, number) > std::make_pair(other.time_ns, other.number);
    }
  };

  double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  std::int64_t transit_ns() {
    return line_.delay_ns + static_cast<std::int64_t>(uniform() * static_cast<double>(line_.jitter_ns));
  }
  void fly(const Node& from, const Node& to, const SharePacket& packet) {
    if (from.part != to.part) return;
    std::int64_t time_ns = now_ns_ + transit_ns();
    const bool lost = uniform() < line_.loss;
    if (packet.lane == Lane::kStream) {
      if (lost) return;
    } else {
      if (lost) time_ns += 2 * line_.delay_ns + 10 * kMs;
      while (uniform() < line_.loss) time_ns += 2 * line_.delay_ns + 10 * kMs;
      std::int64_t& last = last_ns_[{from.self.id, to.self.id, packet.lane}];
      last = time_ns = std::max(time_ns, last);
    }
    flights_.push({time_ns, ++number_, to.self.id, from.self.id, packet});
  }
  bool send(Node& from, const SharePacket& packet) {
    if (packet.bytes.size() > kMaxPacket_bytes) throw std::runtime_error("too large a packet");
    if (packet.lane == Lane::kItems) from.items[packet.key] = packet.bytes;
    for (const auto& to : nodes_) {
      if (to.get() == &from || (packet.lane == Lane::kInbox && to->self.id != packet.key)) continue;
      fly(from, *to, packet);
    }
    return true;
  }
  void replay(const Node& from, const Node& to) {
    for (const auto& [key, bytes] : from.items) fly(from, to, {Lane::kItems, key, bytes});
  }
  void deliver() {
    while (!flights_.empty() && flights_.top().time_ns <= now_ns_) {
      const Flight flight = flights_.top();
      flights_.pop();
      const auto part = [&](ServerId id) {
        for (const auto& node : nodes_) {
          if (node->self.id == id) return node->part;
        }
        return -1;
      };
      for (const auto& node : nodes_) {
        const bool cut = part(flight.from) != -1 && part(flight.from) != node->part;
        if (node->self.id == flight.to && !cut) node->world->hear(flight.packet, nowOf(*node));
      }
    }
  }

  const Line line_;
  std::mt19937 random_;
  std::int64_t now_ns_ = 1'000'000'000'000;
  std::uint64_t number_ = 0;
  std::vector<std::unique_ptr<Node>> nodes_;
  std::map<std::tuple<ServerId, ServerId, Lane>, std::int64_t> last_ns_;
  std::priority_queue<Flight, std::vector<Flight>, std::greater<>> flights_;
};

/// Something that can be shared, with contents of a size.
inline std::shared_ptr<const proto::ShareContent> contentOf(SharedWorld& world, const std::string& what,
                                                            bool body = false, std::size_t bytes = 100) {
  auto content = std::make_shared<proto::ShareContent>();
  std::string shape = what;
  shape.resize(std::max(bytes, what.size()), 'x');
  for (auto* name : {content->mutable_shape(), content->mutable_surfaces()}) {
    const ContentName named = nameOf(shape);
    world.contents().keep(named, std::make_shared<const std::string>(shape));
    toProto(named, *name);
    shape += "surfaces";
  }
  content->set_look(what);
  content->set_body(body);
  return content;
}

inline ItemMotion motionAt(const Vec3& origin) { return {{Mat3::Identity(), origin}, Vec3::Zero(), Vec3::Zero()}; }

}  // namespace hl::test
