// Contact parts: what each active contact holds of the spring, in a tick and as a force on the hand.
//
// Contact i holds lambda_i along its normal. The rest is friction, divided in proportion to the friction limit of each
// contact, mu_i lambda_i, or to lambda_i if no contact has friction.
#pragma once

#include <array>

#include "proxy/proxy_state.h"
#include "proxy/solver.h"
#include "proxy/tick_report.h"

namespace hl {

/// One for each contact of a report. World frame.
using ContactParts = std::array<Vec3, kMaxActive>;

/// `e`: anchor of the spring - finger, m. The parts of it that the contacts hold; their sum is e, unless there is no
/// contact. RT-safe.
ContactParts partsOf(const FixedVector<ProxyContact, kMaxActive>& contacts, const Vec3& e);

/// Contacts of one object, as one: what they hold together, the direction in which they press, and the share of each in
/// that: its multiplier's, 0 of others. World frame.
struct JointContact {
  Vec3 part = Vec3::Zero();
  Vec3 normal = Vec3::UnitY();  ///< unit
  std::array<double, kMaxActive> shares{};
};
/// Of the contacts that are `among` them: at least one. RT-safe.
JointContact jointContact(const FixedVector<ProxyContact, kMaxActive>& contacts, const ContactParts& parts,
                          const std::array<bool, kMaxActive>& among);

/// A vector by the normals of contacts: v = sum along[i] * normals[i] + rest, with the least rest. RT-safe.
struct PartsAlongNormals {
  std::array<double, kMaxActive> along{};
  Vec3 rest = Vec3::Zero();
};
PartsAlongNormals partsAlong(const FixedVector<Vec3, kMaxActive>& normals, const Vec3& v);
/// The same of whatever has a normal, at most kMaxActive of them.
template <typename Contacts>
PartsAlongNormals partsAlongNormals(const Contacts& contacts, const Vec3& v) {
  FixedVector<Vec3, kMaxActive> normals;
  for (const auto& contact : contacts) normals.push(contact.normal);
  return partsAlong(normals, v);
}

/// N: forces of the contacts on the hand after the tick that returned `state` and `report` for `finger`: their parts of
/// what no snap and no matter holds, times K s. RT-safe.
ContactParts contactForces_N(const ProxySettings& settings, const ProxyState& state, const TickReport& report,
                             const Vec3& finger);

}  // namespace hl
