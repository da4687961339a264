// Compliance estimate: how a mesh that is deformed by frames yields, where its client does not say.
//
// Only of clients that take contact reports: they read the force that their mesh is to answer
// (Instance::answers_force). Such a client moves its mesh by the force that it reads: x_k = x_0 - C F_k along the
// normal. It closes a loop with the servo's spring K, over a latency that is not known, and which is unstable for C >
// 1/K. The estimate of C is the secant of the last frames: how far each has moved the mesh at the contact, against how
// much the mean force had changed some frames before, for the number of frames that explains it best; rounded up, as
// too much is always stable. A mesh that moves by itself changes the force by K dx, so its secant is at most 1/K; and
// up to there the loop is stable as it is. So nothing is estimated below 1/K. Where the mesh does not follow the force
// the estimate falls to 0.
//
// The force F_k that a frame was computed for is not known either. What the mesh moves is taken for an answer to the
// force: the lift C F_k loses what the mesh moves, so that a frame is not felt at once. From there it goes to C F with
// the time constant of some frames. At rest it is C F, so that the force is that of the mesh alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/vec.h"
#include "geometry/element_id.h"

namespace hl {

/// World frame. One object at a time: the deforming one that was touched last.
struct ComplianceEstimate {
  static constexpr std::size_t kFrames = 24;

  std::uint64_t key = 0;       ///< of the instance; 0: none
  std::uint64_t geometry = 0;  ///< of its shape
  double compliance_m_N = 0;   ///< C
  Vec3 lift_m = Vec3::Zero();  ///< C F_k
  // The point of the mesh that was pressed hardest, and the force of the whole mesh at the end of the last tick:
  ElementId element = 0;
  std::array<double, 3> weights{};
  Vec3 normal = Vec3::Zero();  ///< of its normal force
  Vec3 force_N = Vec3::Zero();
  // Since the last frame:
  double moved_m = 0, sum_N = 0;  ///< along the normal
  std::int64_t ticks = 0;
  // Of the last frames, the newest last; 0 before the touch. Forces: the mean and the last, as a client may read
  // either.
  double frame_s = 0;
  std::array<double, kFrames> moves_m{}, means_N{}, lasts_N{};

  /// A frame has come: the one before is complete. `servo_m_N`: 1/K, per metre of the world. RT-safe.
  void closeFrame(double period_s, double servo_m_N);
  /// C by the frames so far; 0: the mesh does not follow the force; below 0: the force has not changed enough for it.
  /// RT-safe.
  double secant_m_N() const;
};

}  // namespace hl
