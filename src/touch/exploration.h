// Exploration: the built-in hand that strokes the model, so that something is felt on a machine without a person.
// It circles the model slowly, presses beneath the surface that a sphere falling inward would meet, and lifts now and
// then. Where it is not near the place to stroke, as at its begin or beside a spout, it goes there first: outward,
// above the surface, and down, never through the model.
//
//   |goal - proxy| <= way that is free + press      so a hand at rest presses by at most kPress_N, whatever holds it
#pragma once

#include "base/vec.h"
#include "geometry/primitive.h"
#include "scene/scene_at.h"

namespace hl {

/// What the exploration must know of the hand. World frame, m.
struct ExploringHand {
  static constexpr double kPress_N = 1;

  Vec3 proxy = Vec3::Zero();
  double radius = 0.002;  ///< of its proxy
  double scale = 1;       ///< metres of the world for one of the hand
  double press = 0.010;   ///< how far beneath the surface its goal is while it presses by kPress_N
  Box reach;              ///< where it can go
};

/// m in the world: how far beneath a surface a simulated hand must want to be, to press by kPress_N with a servo of
/// this stiffness: its springs and the servo's are in series.
double pressOf(bool firm, double stiffness_N_m, double scale);

/// One thread, never a real-time one. Deterministic.
class Exploration {
 public:
  /// The next goal is the first: the hand sets out from where it is.
  void begin() { begun_ = false; }
  /// Where the hand wants to be at this time; the scene is not empty. Asked about 60 times a second.
  Vec3 goal(const SceneAt& scene, const ExploringHand& hand, double time_s);

 private:
  class Look;

  Vec3 outward() const;
  Vec3 stroke(const Look& look, double dt_s);
  Vec3 approach(const Look& look);
  Vec3 wayOut(const Look& look, const Vec3& here);

  bool begun_ = false, stroking_ = false;
  double time_s_ = 0;    // of the last goal
  double path_s_ = 0;    // along the path around the model
  double stroke_s_ = 0;  // since the stroke began, in the air
  double azimuth_ = 0;   // rad, where the path begins
  Vec3 escape_ = Vec3::UnitY();
};

}  // namespace hl
