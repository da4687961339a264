// Samples of ROS 2's messages, byte by byte, by the rules of XCDR1 (DDS-XTypes 1.3, 7.4.1; PLAIN_CDR of CORBA 3): each
// number stands at a multiple of its own size, at most 8, counted from behind the encapsulation, whose two bytes 00 01
// say little endian; text is its length with a 0 at its end, and that; a sequence is its length and its members.
#pragma once

#include <array>
#include <cstring>
#include <string>

#include "dds/fast_peer.h"

namespace hl::test {

class PayloadWriter {
 public:
  template <typename Number>
  PayloadWriter& number(Number value) {
    align(sizeof value);
    std::uint8_t bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);  // of a machine that is little endian itself
    payload_.insert(payload_.end(), bytes, bytes + sizeof value);
    return *this;
  }
  template <std::size_t kCount>
  PayloadWriter& numbers(const std::array<double, kCount>& values) {
    for (const double value : values) number(value);
    return *this;
  }
  PayloadWriter& text(const std::string& value) {
    number(static_cast<std::uint32_t>(value.size() + 1));
    payload_.insert(payload_.end(), value.begin(), value.end());
    payload_.push_back(0);
    return *this;
  }
  const Payload& payload() const { return payload_; }

 private:
  void align(std::size_t size) {
    while ((payload_.size() - 4) % size != 0) payload_.push_back(0);
  }
  Payload payload_{0, 1, 0, 0};
};

class PayloadReader {
 public:
  explicit PayloadReader(Payload payload) : payload_(std::move(payload)) {}
  template <typename Number>
  Number number() {
    while ((at_ - 4) % sizeof(Number) != 0) ++at_;
    Number value{};
    if (at_ + sizeof value <= payload_.size()) std::memcpy(&value, payload_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  template <std::size_t kCount>
  std::array<double, kCount> numbers() {
    std::array<double, kCount> values{};
    for (double& value : values) value = number<double>();
    return values;
  }
  std::string text() {
    const std::size_t size = number<std::uint32_t>();
    if (size == 0 || at_ + size > payload_.size()) return "no text";
    std::string value(payload_.begin() + static_cast<std::ptrdiff_t>(at_),
                      payload_.begin() + static_cast<std::ptrdiff_t>(at_ + size - 1));
    at_ += size;
    return value;
  }

 private:
  Payload payload_;
  std::size_t at_ = 4;
};

inline Payload wrenchOf(const std::string& frame, const std::array<double, 3>& force) {
  return PayloadWriter().number(0).number(0u).text(frame).numbers(force).numbers<3>({}).payload();
}
inline Payload poseOf(const std::string& frame, const std::array<double, 3>& place) {
  return PayloadWriter().number(0).number(0u).text(frame).numbers(place).numbers<4>({0, 0, 0, 1}).payload();
}

inline Payload energyOf(double total_J) { return PayloadWriter().number(total_J).payload(); }

inline constexpr const char* kNumberType = "std_msgs::msg::dds_::Float64_";
inline constexpr const char* kPoseType = "geometry_msgs::msg::dds_::PoseStamped_";
inline constexpr const char* kTwistType = "geometry_msgs::msg::dds_::TwistStamped_";
inline constexpr const char* kWrenchType = "geometry_msgs::msg::dds_::WrenchStamped_";
inline constexpr const char* kJointType = "sensor_msgs::msg::dds_::JointState_";
inline constexpr const char* kJoyType = "sensor_msgs::msg::dds_::Joy_";

}  // namespace hl::test
