#include "ros/teleop_clutch.h"

namespace hl {

void TeleopClutch::follow(const Vec3& place_D, std::uint64_t buttons, bool makes_force) {
  const bool pressed = settings_.clutch_button && (buttons >> *settings_.clutch_button & 1U) != 0;
  pressed_once_ = pressed_once_ || pressed || !settings_.clutch_button;
  const bool leads = makes_force && pressed_once_ && !pressed && place_D.allFinite();
  if (leads && !engaged_) zero_ = set_point_ - settings_.scale * place_D;
  engaged_ = leads;
  if (engaged_) set_point_ = zero_ + settings_.scale * place_D;
}

}  // namespace hl
