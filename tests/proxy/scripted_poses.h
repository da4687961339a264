// ScriptedPoses: an object that is where a script says: at each of its moments at one pose, and between two on a screw.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "scene/motion.h"

namespace hl::test {

class ScriptedPoses final : public PoseSource {
 public:
  using Script = std::vector<std::pair<std::int64_t, Pose>>;  // by rising moment, two at least
  explicit ScriptedPoses(Script script) : script_(std::move(script)) {
    for (std::size_t i = 1; i < script_.size(); ++i)
      screws_.emplace_back(script_[i - 1].second, script_[i].second, script_[i - 1].first, script_[i].first);
  }

  Pose at(std::int64_t time_ns) const override { return screwAt(time_ns).at(time_ns); }
  std::int64_t straightUntil(std::int64_t now_ns, std::int64_t until_ns, double turn_rad) const override {
    if (now_ns < script_.front().first) return std::min(until_ns, script_.front().first);
    const Screw& screw = screwAt(now_ns);
    if (now_ns < screw.end_ns()) until_ns = std::min(until_ns, screw.end_ns());
    const double rate_rad_ns = screw.angle() / static_cast<double>(screw.end_ns() - screw.begin_ns());
    if (rate_rad_ns * static_cast<double>(until_ns - now_ns) <= turn_rad) return until_ns;
    return now_ns + std::max<std::int64_t>(1, static_cast<std::int64_t>(turn_rad / rate_rad_ns));
  }
  bool moves() const override { return true; }
  std::int64_t restsFrom_ns() const override { return script_.back().first; }
  Pose to() const override { return script_.back().second; }
  Box reach(const Box& object) const override {
    Box reach;
    for (const Screw& screw : screws_) {
      const Box part = Motion(Screw(screw.from()), screw).reach(object);
      reach.extend(part.min);
      reach.extend(part.max);
    }
    return reach;
  }

 private:
  const Screw& screwAt(std::int64_t time_ns) const {
    const auto is_after = [&](const Screw& screw) { return time_ns < screw.end_ns(); };
    const auto found = std::find_if(screws_.begin(), screws_.end(), is_after);
    return found == screws_.end() ? screws_.back() : *found;
  }

  Script script_;
  std::vector<Screw> screws_;
};

}  // namespace hl::test
