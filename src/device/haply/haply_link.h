// HaplyLink: the conversation with Haply's Inverse Service, on a thread of its own. One message with a force goes out,
// one with the state comes back; the servo thread takes and gives the newest of each without waiting.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "device/device.h"

namespace hl {

struct HaplyAddress {
  std::string host = "localhost";
  std::uint16_t port = 10001;
  std::string device_id;  ///< of an Inverse3; empty: the first

  /// From ws://HOST[:PORT][/ID], ID alone for the service of this machine, or nothing. Throws hl::Error.
  static HaplyAddress parse(const std::string& text);
  std::string text() const;  ///< of the service
};

class HaplyLink {
 public:
  /// Connects, and comes back by itself whenever the service has gone. Throws hl::Error when it cannot be had at first.
  explicit HaplyLink(const HaplyAddress& address);
  /// Commands the service to let go of the tip, then ends.
  ~HaplyLink();
  HaplyLink(const HaplyLink&) = delete;
  HaplyLink& operator=(const HaplyLink&) = delete;

  const std::string& deviceId() const;
  /// Whether there was a grip, which reports how it is turned, when the conversation began.
  bool hasGrip() const;
  /// Servo thread, RT-safe. What came last.
  DeviceSample newest(std::int64_t now_ns);
  /// Servo thread, RT-safe. Held until the next, and not for long.
  void pull(const Vec3& force_D);

 private:
  class Conversation;
  std::unique_ptr<Conversation> conversation_;
};

}  // namespace hl
