// The lanes of a shared world within one process, for servers with threads: what is sent is there at once.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "share/share_link.h"

namespace hl::test {

class MemoryHub {
 public:
  class Link final : public ShareLink {
   public:
    Link(MemoryHub& hub, ServerId id) : hub_(hub), id_(id) { hub_.join(*this); }
    ~Link() override { hub_.leave(*this); }

    void wait(std::int64_t most_ns) override {
      std::unique_lock lock(hub_.mutex_);
      hub_.changed_.wait_for(lock, std::chrono::nanoseconds(most_ns), [this] { return !come_.empty() || ended_; });
    }
    bool send(const SharePacket& packet) override { return hub_.send(*this, packet); }
    std::optional<SharePacket> receive() override {
      const std::lock_guard lock(hub_.mutex_);
      if (come_.empty()) return std::nullopt;
      SharePacket packet = std::move(come_.front());
      come_.pop_front();
      return packet;
    }
    bool ended() const override {
      const std::lock_guard lock(hub_.mutex_);
      return ended_;
    }
    /// As one that joins.
    bool startAgain() override {
      hub_.leave(*this);
      come_.clear();
      items_.clear();
      ended_ = false;
      hub_.join(*this);
      return true;
    }

   private:
    friend class MemoryHub;
    MemoryHub& hub_;
    const ServerId id_;
    std::deque<SharePacket> come_;
    std::map<std::uint64_t, SharePacket> items_;  // its last one of each key
    bool ended_ = false;
  };

  /// Nothing of this server comes to others any more, nor theirs to it, as of one that is killed.
  void cut(ServerId id) {
    const std::lock_guard lock(mutex_);
    std::erase_if(links_, [&](const Link* link) { return link->id_ == id; });
  }
  /// Its program ends, and what it has kept for others goes.
  void end(ServerId id) {
    const std::lock_guard lock(mutex_);
    for (Link* link : links_) link->ended_ |= link->id_ == id;
    std::erase_if(links_, [&](const Link* link) { return link->id_ == id; });
    changed_.notify_all();
  }

 private:
  void join(Link& link) {
    const std::lock_guard lock(mutex_);
    for (const Link* other : links_) {
      for (const auto& [_, packet] : other->items_) link.come_.push_back(packet);
    }
    links_.push_back(&link);
  }
  void leave(const Link& link) {
    const std::lock_guard lock(mutex_);
    std::erase(links_, &link);
  }
  bool send(Link& from, const SharePacket& packet) {
    const std::lock_guard lock(mutex_);
    if (std::find(links_.begin(), links_.end(), &from) == links_.end()) return true;
    if (packet.lane == Lane::kItems) from.items_[packet.key] = packet;
    for (Link* to : links_) {
      if (to != &from && (packet.lane != Lane::kInbox || to->id_ == packet.key)) to->come_.push_back(packet);
    }
    changed_.notify_all();
    return true;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Link*> links_;
};

}  // namespace hl::test
