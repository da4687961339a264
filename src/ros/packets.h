// Packets between a server and hl-ros, which speaks DDS for it in a process of its own: plain memory, one packet in
// each message of a local socket. Both programs are of one version.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>

namespace hl {

/// Of a Joy: more than any device has.
inline constexpr std::uint32_t kRosButtons = 8;

/// To hl-ros: how a hand is. Frame D of its device.
struct RosHandState {
  std::uint32_t hand = 0;  ///< its place among the words that hl-ros was started with
  std::uint32_t buttons = 0;
  std::int64_t time_ns = 0;  ///< of the system clock, since 1970
  std::array<double, 3> position{};
  std::array<double, 4> orientation{0, 0, 0, 1};  ///< quaternion, x y z w
  std::array<double, 3> velocity{}, angular_velocity{};
  std::array<double, 3> force{}, torque{};
  std::uint64_t has_gripper = 0;  ///< 0: the next two say nothing
  double gripper_rad = 0, gripper_N = 0;
  std::uint64_t leads_robot = 0;  ///< 0: the next three say nothing; else the topics of a robot far away are there
  std::array<double, 3> set_point{}, set_point_velocity{};
  double given_up_J = 0;  ///< total of what the hand's side has given up for the robot's, J at the robot
};

/// kMalformed: what is no sample of its topic, or no packet of DDS; nothing else of the command says anything.
enum class RosInput : std::uint32_t { kServoCf, kServoCp, kRemoteCf, kRemoteEnergy, kMalformed };
/// Those that are topics.
inline constexpr std::size_t kRosInputs = 4;

/// From hl-ros: what somebody has sent to a hand, as it came. Nothing of it is to be trusted.
struct HandCommand {
  RosInput input = RosInput::kServoCf;
  std::uint32_t hand = 0;
  std::uint64_t own_frame = 0;    ///< 1: its frame is the hand's, or it names none
  std::int64_t age_ns = 0;        ///< how long before its arrival it was sent, by the clocks of both sides
  std::int64_t arrived_ns = 0;    ///< on the monotonic clock
  std::array<double, 3> value{};  ///< a force in N, a place in m, or one energy in J
  std::uint64_t writer = 0;       ///< which of those that write to the topic
};

/// A packet of this type, and nothing else.
template <typename Packet>
std::optional<Packet> packetOf(std::span<const char> bytes) {
  static_assert(std::is_trivially_copyable_v<Packet>);
  if (bytes.size() != sizeof(Packet)) return std::nullopt;
  Packet packet;
  std::memcpy(&packet, bytes.data(), sizeof packet);
  return packet;
}

template <typename Packet>
std::span<const char> bytesOf(const Packet& packet) {
  static_assert(std::is_trivially_copyable_v<Packet>);
  return {reinterpret_cast<const char*>(&packet), sizeof packet};
}

}  // namespace hl
