// Course: a way over or around a scene of any shape that never repeats.
#pragma once

#include "base/vec.h"
#include "scene/model.h"

namespace hl::bench {

/// Over a flat scene, around any other. A place is a way `s` along the course and a level: the height along the thin
/// side of a flat scene, the distance from the middle of any other. Metres, world frame.
class Course {
 public:
  explicit Course(const Box& bounds);

  Vec3 at(double s_m, double level_m) const;
  double levelOf(const Vec3& p) const;
  /// Unit, the way in which the level rises.
  Vec3 up(const Vec3& p) const;
  double top_m() const { return top_m_; }        ///< nothing of the scene is higher
  double bottom_m() const { return bottom_m_; }  ///< no reason to go deeper

 private:
  bool flat_ = false;
  int thin_ = 1;  ///< the axis of the smallest side
  Vec3 middle_;
  double reach_m_ = 0;  ///< how far the course goes from the middle
  double top_m_ = 0, bottom_m_ = 0;
};

}  // namespace hl::bench
