#include "device/haply/haply_messages.h"
#include "base/text.h"

#include <algorithm>
#include <boost/json/parse.hpp>
#include <boost/json/serialize.hpp>
#include <boost/json/value.hpp>
#include <boost/json/value_to.hpp>
#include <cstdlib>
#include <utility>

namespace hl {

namespace json = boost::json;

namespace {

// In the service's frame: where the vendor's own examples put the middle of what they show. It becomes D's origin.
const Vec3& centre_H() {
  static const Vec3 centre(0, -0.14, 0.2);
  return centre;
}

Vec3 haplyToDevice(const Vec3& v_H) { return {v_H.x(), v_H.z(), -v_H.y()}; }
Vec3 toHaply(const Vec3& v_D) { return {v_D.x(), -v_D.z(), v_D.y()}; }

const json::value* memberOf(const json::value* value, std::string_view name) {
  const json::object* object = value != nullptr ? value->if_object() : nullptr;
  return object != nullptr ? object->if_contains(name) : nullptr;
}

const json::value* itemOf(const json::value* value, std::size_t number) {
  const json::array* array = value != nullptr ? value->if_array() : nullptr;
  return array != nullptr && number < array->size() ? &(*array)[number] : nullptr;
}

// Empty: it has none.
std::string idOf(const json::value* device) {
  const json::value* id = memberOf(device, "device_id");
  return id != nullptr && id->is_string() ? json::value_to<std::string>(*id) : "";
}

// The number of the device that is wanted, among those of a message. One that has no id is the only one.
std::size_t numberOf(const json::value* devices, const std::string& wanted) {
  std::size_t number = 0;
  if (wanted.empty()) return number;
  while (itemOf(devices, number) != nullptr && idOf(itemOf(devices, number)) != wanted) ++number;
  const bool only_one = number == 1 && idOf(itemOf(devices, 0)).empty();
  return only_one ? 0 : number;
}

bool readNumber(const json::value* value, double& number) {
  if (value == nullptr || !value->is_number()) return false;
  number = value->to_number<double>();
  return true;
}

bool readVector(const json::value* value, Vec3& vector) {
  Vec3 read = Vec3::Zero();
  const bool complete = readNumber(memberOf(value, "x"), read.x()) && readNumber(memberOf(value, "y"), read.y()) &&
                        readNumber(memberOf(value, "z"), read.z());
  if (complete) vector = read;
  return complete;
}

// Buttons are called a, b, c.. or button_0, button_1..; 32 for what is neither.
std::size_t buttonNumber(std::string_view name) {
  if (name.size() == 1 && name[0] >= 'a' && name[0] <= 'z') return static_cast<std::size_t>(name[0] - 'a');
  constexpr std::string_view kPrefix = "button_";
  if (name.size() != kPrefix.size() + 1 || !name.starts_with(kPrefix) || name.back() < '0' || name.back() > '9')
    return 32;
  return static_cast<std::size_t>(name.back() - '0');
}

void readButtons(const json::value* grip, std::uint32_t& buttons) {
  const json::value* reported = memberOf(memberOf(grip, "state"), "buttons");
  const json::object* object = reported != nullptr ? reported->if_object() : nullptr;
  if (object == nullptr) return;
  buttons = 0;
  for (const auto& [name, value] : *object) {
    const std::size_t number = buttonNumber({name.data(), name.size()});
    const bool down = value.is_bool() && value.get_bool();
    if (number < 32 && down) buttons |= 1U << number;
  }
}

// A quaternion of the service's frame: its axis is a direction there.
void readTurn(const json::value* grip, HaplyState& state) {
  const json::value* reported = memberOf(memberOf(grip, "state"), "orientation");
  Vec3 axis_H;
  double w = 0;
  if (!readVector(reported, axis_H) || !readNumber(memberOf(reported, "w"), w)) return;
  state.stylus.turned.vec() = haplyToDevice(axis_H);
  state.stylus.turned.w() = w;
  state.has_grip = true;
}

}  // namespace

HaplyDialect haplyDialectOf(std::string_view version) {
  const auto is_digit = [](char c) { return isDigit(c); };
  const std::string text(std::find_if(version.begin(), version.end(), is_digit), version.end());
  char* dot = nullptr;
  const long major = std::strtol(text.c_str(), &dot, 10);
  const long minor = *dot == '.' ? std::strtol(dot + 1, nullptr, 10) : 0;
  return major > 3 || (major == 3 && minor >= 5) ? HaplyDialect::kVector : HaplyDialect::kValues;
}

std::vector<std::string> haplyDevicesOf(std::string_view text) {
  std::vector<std::string> ids;
  json::error_code error;
  const json::value message = json::parse({text.data(), text.size()}, error);
  if (error) return ids;
  const json::value* devices = memberOf(&message, "inverse3");
  for (std::size_t i = 0; itemOf(devices, i) != nullptr; ++i) {
    if (std::string id = idOf(itemOf(devices, i)); !id.empty()) ids.push_back(std::move(id));
  }
  return ids;
}

bool readHaplyMessage(std::string_view text, HaplyState& state) {
  json::error_code error;
  const json::value message = json::parse({text.data(), text.size()}, error);
  state.located = false;
  if (error || !message.is_object()) return false;
  const json::value* devices = memberOf(&message, "inverse3");
  const std::size_t number = numberOf(devices, state.device_id);
  const json::value* device = itemOf(devices, number);
  if (state.device_id.empty()) state.device_id = idOf(device);
  Vec3 position_H;
  state.located = readVector(memberOf(memberOf(device, "state"), "cursor_position"), position_H);
  if (state.located) state.position = haplyToDevice(position_H - centre_H());
  if (const json::value* flag = memberOf(memberOf(device, "status"), "calibrated"); flag != nullptr && flag->is_bool())
    state.calibrated = flag->get_bool();
  for (const char* grips : {"verse_grip", "wireless_verse_grip"}) {
    const json::value* grip = itemOf(memberOf(&message, grips), number);
    readButtons(grip, state.buttons);
    readTurn(grip, state);
  }
  return true;
}

std::string haplyForceMessage(const std::string& device_id, HaplyDialect dialect, const Vec3& force_D, bool first) {
  const Vec3 force = toHaply(force_D);
  const json::object vector{{"x", force.x()}, {"y", force.y()}, {"z", force.z()}};
  const json::object set{{dialect == HaplyDialect::kVector ? "vector" : "values", vector}};
  json::object message{{"inverse3", json::array{json::object{{"device_id", device_id},
                                                             {"commands", json::object{{"set_cursor_force", set}}}}}}};
  if (first) message["session"] = json::object{{"configure", json::object{{"profile", json::object{{"name", "hl"}}}}}};
  return json::serialize(message);
}

}  // namespace hl
