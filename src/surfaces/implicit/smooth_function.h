// SmoothFunction: a function of space that is below 0 in a solid with a smooth surface: one body, or bodies that are
// blended. Once differentiable wherever it is 0.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/vec.h"
#include "surfaces/implicit/jet.h"

namespace hl {

enum class BodyKind : std::uint8_t { kHalfSpace, kSphere, kRoundBox, kCapsule, kRod, kTorus, kGyroid };

/// A body in coordinates of its own, local = axes p + offset, in which it is at the origin and has the axis z. The
/// value is gain times its own, plus shift.
struct SmoothBody {
  BodyKind kind = BodyKind::kSphere;
  Mat3 axes = Mat3::Identity();
  Vec3 offset = Vec3::Zero();
  double gain = 1, shift = 0;
  double radius = 0;         ///< of its rounding; of a torus, that of the tube
  double ring = 0;           ///< of a torus: from the axis to the middle of the tube
  Vec3 half = Vec3::Zero();  ///< half the sides, before they are rounded; of a capsule half its axis, along z
};

/// Immutable but for its making; read by any thread.
class SmoothFunction {
 public:
  /// No function needs more values at once.
  static constexpr std::size_t kMaxWaiting = 12;
  using Space = std::array<Interval, 3>;

  SmoothFunction() = default;
  explicit SmoothFunction(const SmoothBody& body) : steps_{{body, 0}} {}
  /// Where both are far from each other's surface the lesser value; see blendOf().
  SmoothFunction(const SmoothFunction& a, const SmoothFunction& b, double reach);
  void negate();
  void shift(double by);

  std::size_t bodies() const { return (steps_.size() + 1) / 2; }
  bool fits() const { return waiting_ <= kMaxWaiting; }
  /// Whether its gradient is nowhere longer than 1, as that of a distance, and of a blend of distances, which is a mean
  /// of theirs.
  bool isNoSteeperThanDistance() const;
  /// Half the sides of a box that holds, wherever it is, all values that there are; nothing: no box does.
  std::optional<Vec3> halfPeriod() const;

  // RT-safe.
  double at(const Vec3& p) const;
  Lanes at(const std::array<Lanes, 3>& p) const;
  Jet<double, 1> slopeAt(const Vec3& p) const;  ///< value and gradient
  Jet<Lanes, 1> slopeAt(const std::array<Lanes, 3>& p) const;
  Vec3 gradient(const Vec3& p) const;
  Interval over(const Space& box) const;               ///< bounds of the values
  Jet<Interval, 1> slopeOver(const Space& box) const;  ///< and of the gradient
  Jet<Interval, 2> bendOver(const Space& box) const;   ///< and of the second derivatives

 private:
  /// In the order of evaluation: a body, or a blend of the last two results.
  struct Step {
    SmoothBody body;
    double blend = 0;  ///< != 0: reach of a blend, negative for one that keeps the larger value
  };
  template <typename Result, typename Number>
  Result evaluated(const std::array<Number, 3>& p) const;

  std::vector<Step> steps_;
  std::size_t waiting_ = 1;  // values at once, at most
};

}  // namespace hl
