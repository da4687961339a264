// Compliance: how an object yields between the frames of a client that computes its deformation itself. The mesh of a
// frame was computed for a force F_k; under another force F its surface is displaced by C (F_k - F) from there.
// docs/tissue.md has the theory.
#pragma once

#include <cstdint>

#include "base/vec.h"

namespace hl {

/// Largest compliance, m of the world per newton, and largest component of a force, N, that a client may give.
inline constexpr double kMaxCompliance_m_N = 1e9;
inline constexpr double kMaxComputedForce_N = 1e9;

/// World frame.
struct Compliance {
  double normal_m_N = 0;               ///< C along the surface's normal, m of the world per newton at the hand
  double tangential_m_N = 0;           ///< C along the surface
  Vec3 computed_for_N = Vec3::Zero();  ///< F_k: force of the object on the hand for which its mesh was computed

  bool operator==(const Compliance&) const = default;
  /// Between two compliances, `part` 0..1. RT-safe.
  static Compliance between(const Compliance& from, const Compliance& to, double part);
};

/// A compliance over time: it changes as the mesh does, at a constant rate from frame to frame (mesh_motion.h), so that
/// mesh and force agree at every moment. Immutable; any thread.
class ComplianceMotion {
 public:
  struct Way {
    Compliance from, to;
    std::int64_t begin_ns = 0, end_ns = 0;  ///< begin_ns <= end_ns
    Compliance at(std::int64_t time_ns) const;
  };

  /// At rest.
  explicit ComplianceMotion(const Compliance& rest) : ComplianceMotion({rest, rest}, {rest, rest}) {}
  /// One way after the other, as earlier() and last() return them.
  ComplianceMotion(const Way& earlier, const Way& last) : earlier_(earlier), last_(last) {}
  /// This one until `begin_ns`, and then a change to `to` that ends at `end_ns` >= `begin_ns`.
  ComplianceMotion then(const Compliance& to, std::int64_t begin_ns, std::int64_t end_ns) const;

  const Way& earlier() const { return earlier_; }
  const Way& last() const { return last_; }
  /// RT-safe.
  Compliance at(std::int64_t time_ns) const { return (time_ns < last_.begin_ns ? earlier_ : last_).at(time_ns); }

 private:
  Way earlier_, last_;
};

}  // namespace hl
