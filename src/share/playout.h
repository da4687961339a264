// Playout: when what another server has sent is shown. A pose comes with the time at which it was so; it is shown at a
// fixed delay after that time, so that what came evenly moves evenly, however unevenly the packets came. The delay is
// as long as all but one in a hundred packets are under way.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "scene/snapshot.h"

namespace hl {

/// Where something is, and how fast it moves. World frame.
struct ItemMotion {
  Pose pose;
  Vec3 velocity_m_s = Vec3::Zero(), spin_rad_s = Vec3::Zero();
  bool operator==(const ItemMotion&) const = default;
};

/// Of an instance now: of a body as it was after its last step, of any other one without velocities. Any thread.
ItemMotion motionOf(const Instance& instance, std::int64_t now_ns);

/// Of one server. One thread.
class PlayoutDelay {
 public:
  /// A packet was under way for so long, by both clocks; a negative one counts as 0.
  void add(std::int64_t transit_ns);
  /// From the time of a pose to when it is shown. The shortest transit, and kMaxJitter_ns beyond it at most.
  std::int64_t delay_ns() const { return delay_ns_; }
  static constexpr std::int64_t kMaxJitter_ns = 100'000'000;

 private:
  static constexpr std::size_t kTransits = 256;
  std::array<std::int64_t, kTransits> transits_{};
  std::size_t added_ = 0;
  std::int64_t delay_ns_ = 0;
};

/// How far what a server publishes is behind, as it is shown: it follows what clocks and delays ask for slowly, so that
/// what moves evenly goes on evenly. Of one server. One thread.
class SteadyLag {
 public:
  /// The part of the time by which things may be shown faster or slower.
  static constexpr double kRate = 0.1;
  /// Farther than that nobody is to wait: it jumps.
  static constexpr std::int64_t kJump_ns = 500'000'000;

  void follow(std::int64_t now_ns, std::int64_t wanted_ns);
  /// This server's time less the other's of what is shown; nothing before the first call.
  std::optional<std::int64_t> lag_ns() const { return lag_ns_; }

 private:
  std::optional<std::int64_t> lag_ns_;
  std::int64_t last_ns_ = 0;
};

/// Of one object: where it was, as its owner has published. One thread.
class Track {
 public:
  /// It is on its way; one that is older than the newest is put in order, one of the same time is left out.
  void add(std::int64_t time_ns, const ItemMotion& motion);
  /// It rests there from this time on: the end of the track.
  void rest(std::int64_t time_ns, const ItemMotion& motion);
  void clear() { points_.clear(); }
  bool empty() const { return points_.empty(); }

  /// At this time of the owner's clock: between two poses on a screw; before the first one and after the last one
  /// there. Exactly the last one at its time and later.
  Pose at(std::int64_t time_ns) const;
  /// As it was last received; a track with nothing: at rest at the origin.
  ItemMotion newest() const { return points_.empty() ? ItemMotion{} : points_.back().motion; }
  /// Nothing that is older than this is asked for any more.
  void forgetBefore(std::int64_t time_ns);

 private:
  struct Point {
    std::int64_t time_ns;
    ItemMotion motion;
  };
  static constexpr std::size_t kMaxPoints = 128;  // two seconds of frames
  std::vector<Point> points_;                     // by rising times
};

}  // namespace hl
