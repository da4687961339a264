#include "proxy/contact_parts.h"

#include <Eigen/QR>
#include <algorithm>

namespace hl {

namespace {

using Shares = std::array<double, kMaxActive>;

// Brings the sum of the shares to 1. False, and nothing done, where it is 0.
bool normalise(Shares& shares) {
  double sum = 0;
  for (const double share : shares) sum += share;
  if (!(sum > 0)) return false;
  for (double& share : shares) share /= sum;
  return true;
}

// Shares of the contacts in the part of e that is not along their normals; their sum is 1.
Shares frictionShares(const FixedVector<ProxyContact, kMaxActive>& contacts) {
  Shares shares{};
  double sum = 0;
  for (const bool by_friction : {true, false}) {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const ProxyContact& contact = contacts[i];
      shares[i] = std::max(0.0, contact.multiplier_m) * (by_friction ? contact.static_friction : 1.0);
      sum += shares[i];
    }
    if (sum > 0) break;
  }
  for (std::size_t i = 0; i < contacts.size(); ++i)
    shares[i] = sum > 0 ? shares[i] / sum : 1.0 / static_cast<double>(contacts.size());
  return shares;
}

}  // namespace

ContactParts partsOf(const FixedVector<ProxyContact, kMaxActive>& contacts, const Vec3& e) {
  ContactParts parts;
  Vec3 tangential = e;
  for (const ProxyContact& contact : contacts) tangential -= contact.multiplier_m * contact.normal;
  const Shares shares = frictionShares(contacts);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    parts[i] = contacts[i].multiplier_m * contacts[i].normal + shares[i] * tangential;
  return parts;
}

JointContact jointContact(const FixedVector<ProxyContact, kMaxActive>& contacts, const ContactParts& parts,
                          const std::array<bool, kMaxActive>& among) {
  JointContact joint;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (among[i]) joint.shares[i] = std::max(0.0, contacts[i].multiplier_m);
  }
  if (!normalise(joint.shares)) {  // none of them presses
    for (std::size_t i = 0; i < contacts.size(); ++i) joint.shares[i] = among[i] ? 1 : 0;
    normalise(joint.shares);
  }
  Vec3 normal = Vec3::Zero();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (!among[i]) continue;
    joint.part += parts[i];
    normal += joint.shares[i] * contacts[i].normal;
    joint.normal = contacts[i].normal;
  }
  const double length = normal.norm();
  if (length > 0) joint.normal = normal / length;
  return joint;
}

PartsAlongNormals partsAlong(const FixedVector<Vec3, kMaxActive>& normals, const Vec3& v) {
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMaxActive> columns(3, normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = normals[i];
  const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxActive, 1> along = columns.colPivHouseholderQr().solve(v);
  PartsAlongNormals parts;
  for (std::size_t i = 0; i < normals.size(); ++i) parts.along[i] = along[static_cast<Eigen::Index>(i)];
  parts.rest = v - columns * along;
  return parts;
}

ContactParts contactForces_N(const ProxySettings& settings, const ProxyState& state, const TickReport& report,
                             const Vec3& finger) {
  const Vec3 by_contacts_m = state.anchor() - finger - report.held_pull_m;
  ContactParts forces = partsOf(report.contacts, by_contacts_m);
  const double spring_N_m = settings.springInWorld_N_m();
  for (std::size_t i = 0; i < report.contacts.size(); ++i) forces[i] = spring_N_m * state.stiffness * forces[i];
  return forces;
}

}  // namespace hl
