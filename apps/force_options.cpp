#include "force_options.h"

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "value_checks.h"

namespace hl {

namespace {

constexpr const char* kGroup = "Force";

// Numbers with commas between them; anything else is not as many as asked for.
std::vector<double> numbersOf(std::string_view text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    double number = 0;
    const auto [rest, error] = std::from_chars(at, end, number);
    if (error != std::errc() || !std::isfinite(number) || (rest != end && *rest != ',')) return {};
    numbers.push_back(number);
    at = rest == end ? end : rest + 1;
  }
  return numbers;
}

// An option whose text is `count` numbers, which `set` gets.
template <typename Set>
void addNumbers(CLI::App& app, const std::string& name, const std::string& form, std::size_t count,
                const std::string& what, Set set) {
  app.add_option_function<std::string>(
         name,
         [name, form, count, set](const std::string& text) {
           const std::vector<double> numbers = numbersOf(text);
           if (numbers.size() != count) throw CLI::ValidationError(name, "'" + text + "' is not " + form);
           set(numbers);
         },
         what)
      ->option_text(form)
      ->group(kGroup);
}

void setDeadMan(ServoOptions& options, const std::string& text) {
  options.dead_man = text == "off" ? DeadMan::kNone : text == "held" ? DeadMan::kHeld : DeadMan::kButton;
  if (options.dead_man != DeadMan::kButton) return;
  const std::string_view number = std::string_view(text).substr(std::min<std::size_t>(text.size(), 7));
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), options.dead_man_button);
  if (text.rfind("button:", 0) != 0 || error != std::errc() || end != number.data() + number.size() ||
      options.dead_man_button > 31)
    throw CLI::ValidationError("--dead-man", "'" + text + "' is not off, held or button:N, N from 0 to 31");
}

void setServoRate(ServoRate& rate, const std::string& text) {
  constexpr double kMin_Hz = 100, kMax_Hz = 10'000;
  rate = {};
  if (text == "highest") {
    rate.highest = true;
    return;
  }
  const std::vector<double> numbers = numbersOf(text);
  if (numbers.size() != 1 || numbers[0] < kMin_Hz || numbers[0] > kMax_Hz)
    throw CLI::ValidationError("--servo-rate", "'" + text + "' is neither 100 to 10000 nor highest");
  rate.given_Hz = numbers[0];
}

void addSafetyOptions(CLI::App& app, ServoOptions& options) {
  app.add_option("--force-limit", options.force_limit_N, "never a force above this (default: the device's limit)")
      ->check(within(kMinNumber, kMaxNumber))
      ->option_text("N")
      ->group(kGroup);
  app.add_option("--speed-limit", options.speed_limit_m_s, "a faster hand is a fault (default: the device's limit)")
      ->check(within(kMinNumber, kMaxNumber))
      ->option_text("M/S")
      ->group(kGroup);
  app.add_option_function<std::string>(
         "--dead-man", [&options](const std::string& text) { setDeadMan(options, text); },
         "force only while this is held: the device, where it can tell, or its button N")
      ->option_text("off|held|button:N (default: off)")
      ->group(kGroup);
  app.add_flag("--arm-again", options.arm_again, "when a lost device has returned, arm by itself")->group(kGroup);
}

constexpr double kHeaviestTool_kg = 10;  // its weight is far beyond what any device holds up

void addEffectOptions(CLI::App& app, ServoOptions& options) {
  Effects& effects = options.effects;
  app.add_option("--tool-mass", effects.tool_mass_kg, "of a tool at the tip, to be held up")
      ->check(within(0, kHeaviestTool_kg))
      ->option_text("KG")
      ->group(kGroup);
  app.add_option("--free-damping", effects.free_damping_Ns_m, "drag where nothing is touched")
      ->check(within(0, 100))
      ->option_text("N.s/m")
      ->group(kGroup);
  addNumbers(app, "--constant-force", "X,Y,Z", 3, "N at the hand: x right, y up, z toward the user",
             [&effects](const auto& n) { effects.constant_N = Vec3(n[0], n[1], n[2]); });
  addNumbers(app, "--spring", "K,X,Y,Z", 4, "pulls with K N/m to a place of the hand's space, m",
             [&effects](const auto& n) {
               if (n[0] < 0) throw CLI::ValidationError("--spring", "K must not be negative");
               effects.spring_N_m = n[0];
               effects.spring_D = Vec3(n[1], n[2], n[3]);
             });
  app.add_option_function<std::string>(
         "--vibration-guard", [&options](const std::string& text) { options.vibration.on = text == "on"; },
         "soften the spring when it and the hand shake each other")
      ->check(CLI::IsMember({"on", "off"}))
      ->option_text("on|off (default: on)")
      ->group(kGroup);
  app.add_flag("--passivity-guard", options.passivity.on, "damp a contact that gives more energy than it has taken")
      ->group(kGroup);
}

}  // namespace

void addForceOptions(CLI::App& app, ServoOptions& options, ServoRate& rate) {
  app.add_option_function<std::string>(
         "--servo-rate", [&rate](const std::string& text) { setServoRate(rate, text); },
         "servo steps a second; highest: as many as the device takes and this machine is measured to hold")
      ->option_text("HZ|highest (default: the device's)")
      ->group(kGroup);
  addSafetyOptions(app, options);
  addEffectOptions(app, options);
}

}  // namespace hl
