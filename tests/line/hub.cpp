#include "line/hub.h"

#include <algorithm>
#include <cstddef>
#include <sstream>

namespace hl::line {

namespace {

// Of an IPv4 header (RFC 791).
constexpr std::size_t kHeaderBytes = 20, kProtocolAt = 9, kDestinationAt = 16;
constexpr std::uint8_t kIgmp = 2;
constexpr std::uint32_t kNetwork = 0x0A4D0000;  // 10.77.0.0/24
constexpr int kAll = -1, kNobody = 0;

std::uint8_t byteOf(const Packet& packet, std::size_t at) { return static_cast<std::uint8_t>(packet[at]); }

int destinationOf(const Packet& packet, int ends) {
  if (packet.size() < kHeaderBytes || byteOf(packet, 0) >> 4U != 4 || byteOf(packet, kProtocolAt) == kIgmp)
    return kNobody;
  std::uint32_t address = 0;
  for (std::size_t i = 0; i < 4; ++i) address = address << 8U | byteOf(packet, kDestinationAt + i);
  const bool multicast = address >> 28U == 14;
  if (multicast || address == 0xFFFFFFFF || address == (kNetwork | 0xFFU)) return kAll;
  const std::uint32_t end = address - kNetwork;
  return end >= 1 && end <= static_cast<std::uint32_t>(ends) ? static_cast<int>(end) : kNobody;
}

}  // namespace

std::string addressOf(int end) { return "10.77.0." + std::to_string(end); }

Hub::Hub(int ends, std::uint64_t seed) : ends_(ends), cut_(static_cast<std::size_t>(ends)) {
  std::mt19937_64 seeds(seed);
  for (int link = 0; link < ends * ends; ++link) links_.emplace_back(seeds());
}

std::size_t Hub::index(int from, int to) const { return static_cast<std::size_t>((from - 1) * ends_ + to - 1); }

template <typename Visit>
void Hub::eachLink(const Visit& visit) const {
  for (int from = 1; from <= ends_; ++from) {
    for (int to = 1; to <= ends_; ++to) {
      if (from != to) visit(from, to);
    }
  }
}

void Hub::obey(const Order& order) {
  if (order.kind == OrderKind::kSet) {
    const auto meant = [&](int from, int to) {
      return (order.from == 0 || order.from == from) && (order.to == 0 || order.to == to);
    };
    std::vector<LinkSettings> all(links_.size());
    eachLink([&](int from, int to) {
      const LinkSettings& now = links_[index(from, to)].settings();
      all[index(from, to)] = meant(from, to) ? changed(now, order) : now;
    });
    for (std::size_t i = 0; i < all.size(); ++i) links_[i].set(all[i]);
  } else if (order.kind == OrderKind::kMulticast) {
    multicast_ = order.multicast;
  } else if (order.kind != OrderKind::kCount) {
    const auto isCut = [&](int end) { return cut_[static_cast<std::size_t>(end - 1)]; };
    cut_[static_cast<std::size_t>(order.end - 1)] = order.kind == OrderKind::kCut;
    eachLink([&](int from, int to) { links_[index(from, to)].cut(isCut(from) || isCut(to)); });
  }
}

void Hub::put(int from, const Packet& packet, std::int64_t now_ns) {
  const int destination = destinationOf(packet, ends_);
  if (destination == kAll && !multicast_) return;
  for (int to = 1; to <= ends_; ++to) {
    if (to != from && (destination == kAll || destination == to)) links_[index(from, to)].put(packet, now_ns);
  }
}

void Hub::give(std::int64_t now_ns, const std::function<void(int end, const Packet&)>& give) {
  eachLink([&](int from, int to) {
    while (const auto packet = links_[index(from, to)].take(now_ns)) give(to, *packet);
  });
}

std::int64_t Hub::due_ns() const {
  std::int64_t due_ns = Link::kNever_ns;
  for (const Link& link : links_) due_ns = std::min(due_ns, link.due_ns());
  return due_ns;
}

std::string Hub::describe() const {
  std::ostringstream out;
  eachLink([&](int from, int to) {
    const LinkCounts n = counts(from, to);
    out << from << " -> " << to << ": taken " << n.taken << " given " << n.given << " lost " << n.lost << " cut "
        << n.cut << " full " << n.full << " waiting " << n.waiting << '\n';
  });
  return out.str();
}

}  // namespace hl::line
