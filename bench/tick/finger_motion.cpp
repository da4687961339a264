#include "tick/finger_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tick/course.h"

namespace hl::bench {

namespace {

// Lengths are of the hand.
constexpr double kStep_m = kSpeed_m_s * kPeriod_s;
constexpr double kTurn = 0.2;               // a step's weight of the wanted direction: a bend of about 1 mm
constexpr double kLead_m = 0.003;           // how far ahead on the course the finger aims
constexpr double kAdvance_m = 1e-4;         // the course is followed in pieces this long
constexpr int kMaxAdvances = 1000;          // a scene without extent has no course to follow
constexpr double kStartAbove_m = 0.01;      // over the top of the scene
constexpr std::size_t kMaxApproach = 5000;  // ticks; then the motion begins where the finger is
constexpr double kDepth_m = 0.004;          // of a sliding finger beneath the proxy
constexpr double kDeep_m = 0.015;           // of one that looks for corners
constexpr double kTraced_m = 0.002;         // of one that traces the surface beneath it, in the mean
constexpr double kTracedChange_m = 0.0015;  // by which that changes
constexpr double kTracedWave_m = 0.07;      // of the course, for one such change
constexpr double kTracedLead_m = 0.0003;    // how far ahead such a finger aims
constexpr double kWandered_m = 0.05;        // to one place at most, before there is another
constexpr double kLift_m = 0.006;           // of a tap over where it touched
constexpr double kTapSlope = 0.3;           // a tap goes sideways this much of its way
constexpr double kClearance_m = 0.001;      // of a free proxy from the surface, at least
constexpr double kHover_m = 0.002;          // of a free proxy from the surface, at most, once it has come near

// The nearest point of the scene within `reach` of `p`; its distance is infinite when there is none.
ClosestPoint nearest(const Snapshot& snapshot, const Vec3& p, double reach) {
  ClosestPoint result;
  result.distance = std::numeric_limits<double>::infinity();
  SceneAt(snapshot).primitivesWithin(p, reach, [&](PrimitiveId, const ClosestPoint& found) {
    if (found.distance < result.distance) result = found;
  });
  return result;
}

// A finger that steers along the course.
class Planner {
 public:
  Planner(const Snapshot& snapshot, FingerMotion motion, const ProxySettings& settings, double world_per_hand)
      : snapshot_(snapshot), motion_(motion), settings_(settings), scale_(world_per_hand), course_(snapshot.bounds) {
    finger_ = course_.at(0, course_.top_m() + settings.radius + scale_ * kStartAbove_m);
    direction_ = -course_.up(finger_);
    state_ = startProxy(snapshot, settings, finger_);
  }

  const Vec3& finger() const { return finger_; }
  const Vec3& proxy() const { return state_.position; }
  /// The finger has reached what it came for.
  bool arrived() const { return arrived_; }

  void step() {
    if (motion_ == FingerMotion::kFree) {
      hover();
    } else if (motion_ == FingerMotion::kTapping) {
      tap();
    } else if (motion_ == FingerMotion::kTracing) {
      trace();
    } else if (motion_ == FingerMotion::kWandering) {
      wander();
    } else {
      turnTo(ahead(course_.levelOf(proxy()) - scale_ * (motion_ == FingerMotion::kCorners ? kDeep_m : kDepth_m)));
    }
    finger_ += scale_ * kStep_m * direction_;
    tick(state_, snapshot_, settings_, finger_);
    if (motion_ != FingerMotion::kFree) arrived_ = arrived_ || state_.touching;
  }

 private:
  // Where to go on the course, at this level.
  Vec3 ahead(double level_m) {
    level_m = std::max(level_m, course_.bottom_m());
    for (int i = 0; i < kMaxAdvances && (course_.at(s_m_, level_m) - finger_).norm() < scale_ * kLead_m; ++i) {
      s_m_ += scale_ * kAdvance_m;
    }
    return course_.at(s_m_, level_m);
  }

  // To beneath the surface a little ahead on the course.
  void trace() {
    Vec3 place;
    for (int i = 0; i < kMaxAdvances; ++i) {
      place = course_.at(
          s_m_, surfaceLevel() -
                    scale_ * (kTraced_m + kTracedChange_m * std::sin(2 * M_PI * s_m_ / (scale_ * kTracedWave_m))));
      if ((place - finger_).norm() >= scale_ * kTracedLead_m) break;
      s_m_ += 0.1 * scale_ * kAdvance_m;
    }
    direction_ = (place - finger_).normalized();
  }

  // Of what lies uppermost at this place of the course; the bottom where there is nothing.
  double surfaceLevel() const {
    const Vec3 top = course_.at(s_m_, course_.top_m() + settings_.radius);
    const Vec3 down = course_.at(s_m_, std::max(course_.bottom_m(), -course_.top_m())) - top;
    SceneImpact impact;
    const double thin = 1e-3 * settings_.radius;
    if (!SceneAt(snapshot_).firstImpact(top, down, thin, thin, impact)) return course_.bottom_m();
    return course_.levelOf(top + impact.impact.t * down);
  }

  // To a place of the surface and beneath it, as far as what lies between lets it.
  void wander() {
    s_m_ += scale_ * kStep_m;
    const double depth_m = scale_ * kDepth_m;
    if (s_m_ > scale_ * kWandered_m || (goal_ - proxy()).norm() < depth_m) {
      s_m_ = 0;
      goal_ = drawn();
    }
    turnTo(proxy() + depth_m * (goal_ - proxy()).normalized());
  }

  // As deep beneath the surface as a finger is that slides.
  Vec3 drawn() {
    const auto part = [this] { return static_cast<double>(random_()) / static_cast<double>(random_.max()); };
    const Vec3 parts(part(), part(), part());
    PrimitiveId primitive;
    ClosestPoint found;
    const Vec3 place = snapshot_.bounds.min + snapshot_.bounds.size().cwiseProduct(parts);
    if (!SceneAt(snapshot_).nearest(place, primitive, found)) return place;
    return found.point + scale_ * kDepth_m * (found.point - place).normalized();
  }

  void turnTo(const Vec3& place) { direction_ = (direction_ + kTurn * (place - finger_).normalized()).normalized(); }

  // Down while nothing is near, away at once from what is too near, and between the two along the course. As the
  // clearance is many steps long, what was clear by more than it stays clear.
  void hover() {
    const double closest = settings_.radius + scale_ * kClearance_m, farthest = settings_.radius + scale_ * kHover_m;
    const ClosestPoint near = nearest(snapshot_, finger_, farthest);
    arrived_ = arrived_ || near.distance <= farthest;
    if (near.distance < closest) {
      direction_ = near.normal;
      return;
    }
    const double down = std::min(near.distance, farthest + scale_ * kLead_m) - 0.5 * (closest + farthest);
    turnTo(ahead(course_.levelOf(finger_) - down));
  }

  void tap() {
    const double level = course_.levelOf(finger_);
    if (falling_ && state_.touching && !pressing_) touched_m_ = level;
    pressing_ = state_.touching;
    if (falling_ && (course_.levelOf(proxy()) - level > scale_ * kDepth_m || level < course_.bottom_m()))
      falling_ = false;
    if (!falling_ && level > touched_m_ + scale_ * kLift_m) falling_ = true;
    const Vec3 up = course_.up(finger_);
    const Vec3 along = ahead(level) - finger_;
    const Vec3 sideways = (along - along.dot(up) * up).normalized();
    direction_ = ((falling_ ? -up : up) + kTapSlope * sideways).normalized();
  }

  const Snapshot& snapshot_;
  const FingerMotion motion_;
  const ProxySettings settings_;
  const double scale_;  // world per hand
  const Course course_;
  Vec3 finger_ = Vec3::Zero(), direction_ = Vec3::Zero();
  ProxyState state_;
  double s_m_ = 0;                         // along the course, or to a place
  Vec3 goal_ = snapshot_.bounds.centre();  // of one that wanders
  std::mt19937 random_;
  bool arrived_ = false;
  bool falling_ = true, pressing_ = false;  // of a tap
  double touched_m_ = course_.bottom_m();   // level at which the tap came into contact
};

}  // namespace

const char* nameOf(FingerMotion motion) {
  constexpr std::array<const char*, kFingerMotions.size()> kNames{"sliding", "free",    "tapping",
                                                                  "corners", "tracing", "wandering"};
  return kNames[static_cast<std::size_t>(motion)];
}

Path planPath(const Snapshot& snapshot, FingerMotion motion, const ProxySettings& settings, std::size_t ticks,
              double world_per_hand) {
  Planner planner(snapshot, motion, settings, world_per_hand);
  Path path;
  const auto keep = [&] {
    path.fingers.push_back(planner.finger());
    path.proxies.push_back(planner.proxy());
  };
  keep();
  while (!planner.arrived() && path.fingers.size() < kMaxApproach) {
    planner.step();
    keep();
  }
  path.approach = path.fingers.size();
  for (std::size_t i = 0; i < ticks; ++i) {
    planner.step();
    keep();
  }
  return path;
}

}  // namespace hl::bench
