// FeltContact: where the proxy presses on what, in the terms of the client that drew it, and how the force that the
// hand felt is shared among the contacts.
#pragma once

#include <array>
#include <cstdint>

#include "base/fixed_vector.h"
#include "base/vec.h"
#include "proxy/proxy_state.h"
#include "proxy/solver.h"
#include "proxy/tick_report.h"
#include "scene/scene_at.h"
#include "touch/touch_events.h"

namespace hl {

struct FeltContact {
  std::uint32_t session = 0, object = 0, name = 0, item = 0;  ///< as in Instance
  PrimitiveKind kind = PrimitiveKind::kPoint;
  std::uint32_t primitive = 0;              ///< index of the triangle, segment or point in its item
  std::array<std::uint32_t, 3> vertices{};  ///< of the item; as many as `kind` has
  std::array<double, 3> weights{};          ///< barycentric, of the vertices
  Vec3 point_W = Vec3::Zero();              ///< m
  Vec3 force_N = Vec3::Zero();              ///< on the hand
};
using FeltContacts = FixedVector<FeltContact, kMaxActive>;

/// The contacts after a tick, with the forces of the spring. RT-safe.
FeltContacts feltContacts(const SceneAt& scene, const ProxySettings& settings, const ProxyState& state,
                          const TickReport& report, const Vec3& finger);

/// The same contacts with forces that add up to `force_N`, which the hand felt, together with that of a snap, `held_N`
/// before: what damping, limits and blends make of the spring's force is shared in proportion. RT-safe.
FeltContacts sharing(const FeltContacts& contacts, const Vec3& held_N, const Vec3& force_N);

}  // namespace hl
