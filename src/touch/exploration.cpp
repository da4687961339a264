#include "touch/exploration.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "device/hand.h"
#include "scene/scene_at.h"

namespace hl {

namespace {

constexpr double kAzimuthRate = 0.45;    // rad/s: about 30 mm/s on a model fitted to the device
constexpr double kElevationRate = 0.31;  // rad/s; no small ratio to the azimuth, so that the path wanders everywhere
constexpr double kStroke_s = 7.0;
constexpr double kLifted = 0.15;      // part of a stroke spent in the air
constexpr double kLift_D = 0.010;     // m at the hand, above the surface between strokes
constexpr double kThere_D = 0.004;    // m at the hand
constexpr double kStray_D = 0.008;    // m at the hand: farther from its goal than a stroke that goes well ever is
constexpr double kLongest_s = 0.1;    // between two goals; what is longer is a pause of the program
constexpr double kWaiting = 0.25;     // of the path's speed while the hand is on its way: the place may be out of reach
constexpr double kTurn = 0.15;        // rad, of a step around the model
constexpr int kTurnsAhead = 3;        // that must be clear
constexpr double kFreePresses = 2.5;  // how far ahead of the proxy the goal goes through the open
constexpr double kSlimmer = 0.9;      // of the proxy's radius: what it touches is not in its way along it

// 1 while pressing, 0 in the air, smooth between.
double pressing(double time_s) {
  const double phase = time_s / kStroke_s - std::floor(time_s / kStroke_s);
  const double edge = std::min(phase, 1 - phase) / (0.5 * kLifted);
  const double s = std::min(1.0, edge);
  return s * s * (3 - 2 * s);
}

// From one unit vector toward another, by `angle` at most.
Vec3 turned(const Vec3& from, const Vec3& to, double angle) {
  const double between = std::atan2(from.cross(to).norm(), from.dot(to));
  if (between <= angle) return to;
  Vec3 aside = to - from * from.dot(to);
  if (aside.norm() < 1e-9) aside = from.unitOrthogonal();
  return std::cos(angle) * from + std::sin(angle) * aside.normalized();
}

bool hasBodies(const Snapshot& snapshot) {
  return std::any_of(snapshot.instances.begin(), snapshot.instances.end(), [](const auto& i) { return i.body; });
}

}  // namespace

double pressOf(bool firm, double stiffness_N_m, double scale) {
  const GripParameters& grip = firm ? kFirmGrip : kLightGrip;
  const double softness_m_N = 1 / grip.pad_stiffness_N_m + 1 / grip.arm_stiffness_N_m + 1 / stiffness_N_m;
  return ExploringHand::kPress_N * softness_m_N * scale;
}

// The scene around the hand at one moment.
class Exploration::Look {
 public:
  Look(const SceneAt& scene, const ExploringHand& hand)
      : hand_(hand),
        scene_(scene),
        centre_(scene.snapshot().bounds.centre()),
        outside_(0.5 * scene.snapshot().bounds.size().norm() + 4 * hand.radius + lift()) {}

  const ExploringHand& hand() const { return hand_; }
  const Vec3& proxy() const { return hand_.proxy; }
  Vec3 fromCentre() const { return hand_.proxy - centre_; }
  double lift() const { return kLift_D * hand_.scale; }
  bool isAt(const Vec3& place) const { return (place - hand_.proxy).norm() < kThere_D * hand_.scale; }
  // How far from the centre a sphere falling inward stops.
  double surface(const Vec3& outward) const {
    const auto part = freePart(centre_ + outside_ * outward, -outside_ * outward, hand_.radius);
    return part ? outside_ * (1 - *part) : 0.0;
  }
  Vec3 at(const Vec3& outward, double distance) const { return reachable(centre_ + distance * outward); }
  Vec3 reachable(const Vec3& place) const { return place.cwiseMax(hand_.reach.min).cwiseMin(hand_.reach.max); }
  bool isFreeTo(const Vec3& place) const {
    return !freePart(hand_.proxy, place - hand_.proxy, kSlimmer * hand_.radius).has_value();
  }
  bool isFreeAlong(const Vec3& unit) const { return isFreeTo(hand_.proxy + 2 * outside_ * unit); }
  // Bodies come into the way between two looks: with them it counts as blocked.
  Vec3 leashed(const Vec3& goal) const {
    const Vec3 way = goal - hand_.proxy;
    double most = hand_.press;
    if (way.norm() > most && !hasBodies(scene_.snapshot())) {
      const double ahead = kFreePresses * hand_.press;
      const auto part = freePart(hand_.proxy, ahead * way.normalized(), kSlimmer * hand_.radius);
      most = std::min(ahead, part.value_or(1) * ahead + hand_.press);
    }
    return hand_.proxy + limited(way, most);
  }

 private:
  // Nothing: all of the way is free.
  std::optional<double> freePart(const Vec3& from, const Vec3& way, double radius) const {
    SceneImpact impact;
    if (!scene_.firstImpact(from, way, radius, -1, impact)) return {};
    return impact.impact.t;
  }

  const ExploringHand& hand_;
  const SceneAt& scene_;
  const Vec3 centre_;
  const double outside_;  // this far from the centre nothing is
};

Vec3 Exploration::outward() const {
  const double azimuth = azimuth_ + kAzimuthRate * path_s_;
  const double elevation = 0.5 + 0.6 * std::sin(kElevationRate * path_s_);
  return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), std::cos(elevation) * std::cos(azimuth)};
}

Vec3 Exploration::goal(const SceneAt& scene, const ExploringHand& hand, double time_s) {
  const Look look(scene, hand);
  if (!begun_) {
    const Vec3 from = look.fromCentre();
    azimuth_ = std::atan2(from.x(), from.z());
    path_s_ = 0;
    time_s_ = time_s;
    stroking_ = false;
    begun_ = true;
  }
  const double dt_s = std::clamp(time_s - time_s_, 0.0, kLongest_s);
  time_s_ = time_s;
  path_s_ += stroking_ ? dt_s : kWaiting * dt_s;
  return look.leashed(stroking_ ? stroke(look, dt_s) : approach(look));
}

Vec3 Exploration::stroke(const Look& look, double dt_s) {
  stroke_s_ += dt_s;
  const double pressed = pressing(stroke_s_);
  const double depth = look.hand().press * pressed - look.lift() * (1 - pressed);
  const Vec3 goal = look.at(outward(), look.surface(outward()) - depth);
  stroking_ = (goal - look.proxy()).norm() < look.hand().press + kStray_D * look.hand().scale;
  return stroking_ ? goal : approach(look);
}

// To above the place to stroke.
Vec3 Exploration::approach(const Look& look) {
  const Vec3 to = outward();
  const Vec3 above = look.at(to, look.surface(to) + look.lift());
  if (look.isAt(above)) {
    stroking_ = true;
    stroke_s_ = 0;
    return above;
  }
  if (look.isFreeTo(above)) return above;
  const double height = look.fromCentre().norm();
  const Vec3 here = height > 0 ? Vec3(look.fromCentre() / height) : Vec3::UnitY();
  double clear = 0;
  for (int i = 0; i <= kTurnsAhead; ++i)
    clear = std::max(clear, look.surface(turned(here, to, i * kTurn)) + look.lift());
  const Vec3 up = look.at(here, clear);
  if (height >= clear || look.isAt(up)) return look.at(turned(here, to, kTurn), clear);
  return look.isFreeTo(up) ? up : wayOut(look, here);
}

// Something is above the hand: sideways, the last way first, so that it does not go to and fro. Where there is none it
// stays.
Vec3 Exploration::wayOut(const Look& look, const Vec3& here) {
  const auto go = [&] { return look.reachable(look.proxy() + kFreePresses * look.hand().press * escape_); };
  if (look.isFreeAlong(escape_)) return go();
  double best = -2;
  for (int i = 0; i < 27; ++i) {
    const Vec3 way(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);  // NOLINT: whole numbers
    if (way.isZero()) continue;
    const Vec3 unit = way.normalized();
    if (unit.dot(here) <= best || !look.isFreeAlong(unit)) continue;
    best = unit.dot(here);
    escape_ = unit;
  }
  return best > -2 ? go() : look.proxy();
}

}  // namespace hl
