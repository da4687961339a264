// PersonScript: the hand of a person who gets instructions, one thing after the other.
#pragma once

#include <algorithm>
#include <vector>

#include "device/hand_script.h"

namespace hl::test {

class PersonScript {
 public:
  /// Waits at `start` for so long.
  PersonScript(const Vec3& start, double wait_s) {
    script_.samples.push_back({0, start});
    wait(wait_s);
  }

  PersonScript& moveTo(const Vec3& goal, double speed_m_s) { return goOn((goal - place()).norm() / speed_m_s, goal); }
  PersonScript& wait(double lasts_s) { return goOn(lasts_s, place()); }
  /// Wants to be `way` farther, stays so for the time, and comes back.
  PersonScript& press(const Vec3& way, double speed_m_s, double lasts_s) {
    const Vec3 from = place();
    return moveTo(from + way, speed_m_s).wait(lasts_s).moveTo(from, speed_m_s);
  }
  /// Presses `times` times, coming back at once.
  PersonScript& tap(const Vec3& way, double speed_m_s, int times) {
    for (int i = 0; i < times; ++i) press(way, speed_m_s, 0);
    return *this;
  }
  /// Wants to be `way` farther, goes `along` and back there, and comes back.
  PersonScript& stroke(const Vec3& way, const Vec3& along, double speed_m_s) {
    const Vec3 from = place();
    return moveTo(from + way, speed_m_s)
        .moveTo(from + way + along, speed_m_s)
        .moveTo(from + way, speed_m_s)
        .moveTo(from, speed_m_s);
  }
  /// Lets the device go, and takes it again.
  PersonScript& letGo(double lasts_s) {
    const double begin_s = duration_s();
    wait(lasts_s);
    free_.push_back({begin_s, duration_s()});
    return *this;
  }

  Vec3 at(double time_s) const { return script_.at(time_s); }
  bool holdsAt(double time_s) const {
    return std::none_of(free_.begin(), free_.end(),
                        [&](const Span& span) { return span.begin_s <= time_s && time_s < span.end_s; });
  }
  double duration_s() const { return script_.samples.back().time_s; }

 private:
  struct Span {
    double begin_s = 0, end_s = 0;
  };

  Vec3 place() const { return script_.samples.back().position; }
  PersonScript& goOn(double lasts_s, const Vec3& goal) {
    constexpr double kShortest_s = 1e-3;  // times of a script increase strictly
    script_.samples.push_back({duration_s() + std::max(kShortest_s, lasts_s), goal});
    return *this;
  }

  HandScript script_;
  std::vector<Span> free_;  // of nobody's hand
};

}  // namespace hl::test
