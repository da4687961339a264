#include "share/share_messages.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/error.h"
#include "geometry/primitive.h"
#include "io/value_messages.h"
#include "io/vec_messages.h"

namespace hl {

namespace {

// Faster than anything of a scene; of numbers that are none nothing is left.
constexpr double kMaxSpeed = 1e9;
constexpr std::size_t kSha256_bytes = 32;
// A change of owner each millisecond for fifty days: there is always a next one.
constexpr std::uint64_t kMaxEpoch = std::uint64_t{1} << 32;

bool readVector(const google::protobuf::RepeatedField<float>& in, Vec3& out) {
  if (in.size() == 0) return true;
  if (in.size() != 3) return false;
  out = Vec3(in[0], in[1], in[2]);
  return out.allFinite() && out.norm() < kMaxSpeed;
}

void writeVector(const Vec3& v, google::protobuf::RepeatedField<float>& out) {
  for (const double component : v) out.Add(static_cast<float>(component));
}

bool isName(const proto::ShareName& name) { return name.sha256().size() == kSha256_bytes && name.bytes() > 0; }

}  // namespace

void toProto(const ItemMotion& motion, proto::ShareMotion& out) {
  out.mutable_pose()->Add(motion.pose.rotation.data(), motion.pose.rotation.data() + 9);
  out.mutable_pose()->Add(motion.pose.origin.data(), motion.pose.origin.data() + 3);
  if (motion.velocity_m_s.isZero(0) && motion.spin_rad_s.isZero(0)) return;
  writeVector(motion.velocity_m_s, *out.mutable_velocity_m_s());
  writeVector(motion.spin_rad_s, *out.mutable_spin_rad_s());
}

std::optional<ItemMotion> motionOf(const proto::ShareMotion& in) {
  ItemMotion motion;
  if (in.pose_size() != 12) return std::nullopt;
  std::copy_n(in.pose().begin(), 9, motion.pose.rotation.data());
  std::copy_n(in.pose().begin() + 9, 3, motion.pose.origin.data());
  if (!readVector(in.velocity_m_s(), motion.velocity_m_s) || !readVector(in.spin_rad_s(), motion.spin_rad_s))
    return std::nullopt;
  try {
    checkRecorded(motion.pose, "an object");
  } catch (const Error&) {
    return std::nullopt;
  }
  return motion;
}

void toProto(const ContentName& name, proto::ShareName& out) {
  out.set_sha256(name.sha256);
  out.set_bytes(name.bytes);
}

ContentName nameOf(const proto::ShareName& in) { return {in.sha256(), in.bytes()}; }

bool isNewer(const proto::ShareItem& a, const proto::ShareItem& b) {
  return std::make_tuple(a.epoch(), a.owner(), a.change()) > std::make_tuple(b.epoch(), b.owner(), b.change());
}

bool isItem(const proto::ShareItem& item) {
  if (item.id() == 0 || item.epoch() == 0 || item.epoch() > kMaxEpoch || item.owner() == 0) return false;
  if (item.gone()) return true;
  if (item.content().look().size() > kMaxLook_bytes) return false;
  return isName(item.content().shape()) && isName(item.content().surfaces()) && motionOf(item.motion()).has_value();
}

bool isHand(const proto::OtherDevice& hand) {
  constexpr std::size_t kMaxText = 200;
  constexpr double kMaxForce_N = 1e4;
  const auto within = [](const proto::Vec3& in, double most) {
    const Vec3 v = vecOf(in);
    return v.allFinite() && v.norm() <= most;
  };
  return hand.label().size() <= kMaxText && hand.fault().size() <= kMaxText && within(hand.finger(), kFarthest_m) &&
         within(hand.proxy(), kFarthest_m) && within(hand.force_n(), kMaxForce_N) && hand.proxy_radius() >= 0 &&
         hand.proxy_radius() <= kFarthest_m && std::isfinite(hand.servo_rate_hz());
}

proto::ShareMessage messageOf(const std::string& bytes) {
  proto::ShareMessage message;
  if (!message.ParseFromString(bytes)) message.Clear();
  return message;
}

}  // namespace hl
