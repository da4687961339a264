// The finger of the long run: stretches of slow and fast motion, jumps, noise, deep pressing and rest, without end.
// Lengths are in radii of the proxy.
#pragma once

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "geometry/scenes.h"

namespace hl::soak {

class Finger {
 public:
  Finger(test::Random& random, const Vec3& half, std::vector<Vec3> marks = {})
      : random_(random), half_(half), marks_(std::move(marks)) {}

  /// Anywhere in the scene and about it.
  Vec3 anywhere() { return random_.inCube(1.3).cwiseProduct(half_); }

  /// Where it is in the next tick.
  Vec3 next(const Vec3& proxy) {
    if (left_-- == 0) begin(proxy);
    switch (way_) {
      case Way::kMove:
        turn();
        return place_ += velocity_;
      case Way::kJump:
        if (random_.below(8) == 0) place_ = anywhere();
        return place_;
      case Way::kNoise:
        return place_ + random_.inCube(size_);
      case Way::kDeep:
        turn();
        place_ += velocity_;
        return size_ * place_.normalized();
      case Way::kRest:
        break;
    }
    return place_;
  }

 private:
  enum class Way { kMove, kJump, kNoise, kDeep, kRest };
  static constexpr std::array kWays{Way::kMove, Way::kMove, Way::kJump, Way::kNoise, Way::kDeep, Way::kRest};

  void begin(const Vec3& proxy) {
    way_ = kWays[static_cast<std::size_t>(random_.below(kWays.size()))];
    left_ = 20 + random_.below(200);
    // Rules that add energy without limit may drive the proxy far away.
    const bool near = (proxy.cwiseAbs().array() < 3 * half_.array()).all();
    place_ = random_.below(3) == 0 || !near ? anywhere() : Vec3(proxy + random_.inCube(3));
    if (!marks_.empty() && random_.below(2) == 0) place_ = nearMark();
    // In a tick of 1 ms at r = 1 mm: from 1 mm/s to 10 m/s.
    velocity_ = std::pow(10.0, random_.uniform(-3, 1)) * random_.direction();
    // Noise from far below the skin up; deep is up to a thousand times the scene away.
    size_ = way_ == Way::kNoise ? std::pow(10.0, random_.uniform(-12, 0.5))
                                : half_.norm() * std::pow(10.0, random_.uniform(0, 3));
  }

  // From a billionth of a radius off to ten.
  Vec3 nearMark() {
    const auto mark = static_cast<std::size_t>(random_.below(static_cast<int>(marks_.size())));
    return marks_[mark] + std::pow(10.0, random_.uniform(-9, 1)) * random_.direction();
  }

  // A bent way that comes back before it leaves the scene far behind.
  void turn() {
    const double speed = velocity_.norm();
    Vec3 toward = velocity_ + 0.2 * speed * random_.direction();
    if ((place_.cwiseAbs().array() > 1.5 * half_.array()).any()) toward -= 0.5 * speed * place_.normalized();
    velocity_ = speed * toward.normalized();
  }

  test::Random& random_;
  const Vec3 half_;
  const std::vector<Vec3> marks_;
  Way way_ = Way::kRest;
  int left_ = 0;
  Vec3 place_ = Vec3::Zero(), velocity_ = Vec3::Zero();
  double size_ = 0;
};

}  // namespace hl::soak
