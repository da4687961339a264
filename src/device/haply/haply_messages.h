// What HL and Haply's Inverse Service say to each other, as JSON text. Pure functions.
// The service's frame: x to the right, y forward (away from the user), z up; metres, newtons.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.h"
#include "device/stylus.h"

namespace hl {

/// How a force is written: service 3.5 documents "vector", older ones take "values".
enum class HaplyDialect : std::uint8_t { kValues, kVector };

/// From the answer to GET /version, whatever surrounds the number; kValues when there is none.
HaplyDialect haplyDialectOf(std::string_view version);

/// One Inverse3 of the service, with the buttons of its grip: the first device has the first grip, the second the
/// second. Frame D.
struct HaplyState {
  std::string device_id;  ///< which; empty: the first that the next message has, if any
  bool located = false;   ///< the last message gave its position
  Vec3 position = Vec3::Zero();
  std::uint32_t buttons = 0;
  bool calibrated = true;  ///< unless the service says otherwise
  bool has_grip = false;   ///< a grip has reported how it is turned
  Stylus stylus;
};

/// The ids of all Inverse3 that a message of the service names.
std::vector<std::string> haplyDevicesOf(std::string_view text);

/// Takes in a message of the service. False when it is none.
bool readHaplyMessage(std::string_view text, HaplyState& state);

/// Commands the service to hold `force_D`; the first message also introduces HL.
std::string haplyForceMessage(const std::string& device_id, HaplyDialect dialect, const Vec3& force_D, bool first);

}  // namespace hl
