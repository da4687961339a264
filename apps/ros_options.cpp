#include "ros_options.h"

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "dds_options.h"
#include "ros/ros_process.h"
#include "value_checks.h"

namespace hl {

namespace {

constexpr double kMaxStates_Hz = 1000;

// "none", or the number of a button.
std::string setClutch(const std::string& said, TeleopSettings& teleop) {
  teleop.clutch_button.reset();
  if (said == "none") return {};
  const bool is_button = said.size() == 1 && said[0] >= '0' && said[0] < '0' + static_cast<char>(kRosButtons);
  if (!is_button) return "'" + said + "' is no button: say 0 to " + std::to_string(kRosButtons - 1) + ", or none";
  teleop.clutch_button = static_cast<std::uint32_t>(said[0] - '0');
  return {};
}

void addTeleopOptions(CLI::App& app, RosOptions& options) {
  const auto add = [&](const char* name, double& value, const char* what, double least, double most) {
    app.add_option(name, value, what)
        ->check(within(least, most))
        ->needs("--teleop")
        ->capture_default_str()
        ->group("ROS 2");
  };
  app.add_option("--teleop", options.teleop_hand,
                 "this hand leads a robot far away, by the topics NAMESPACE/HAND/teleop: docs/teleoperation.md")
      ->needs("--ros")
      ->option_text("HAND")
      ->group("ROS 2");
  add("--teleop-scale", options.teleop.scale, "way of the robot by that of the hand", 1e-3, 1e3);
  add("--teleop-force-scale", options.teleop.force_scale, "force on the hand by that on the robot", 1e-3, 1e3);
  add("--teleop-max-age", options.teleop.max_age_s,
      "a robot's force that was so much longer on the way than the fastest is left out, s", 0.05, 10);
  app.add_option_function<std::string>(
         "--teleop-clutch",
         [&options](const std::string& said) {
           if (const std::string why = setClutch(said, options.teleop); !why.empty()) throw CLI::ValidationError(why);
         },
         "the robot stays while this button is down, and before it was down once; none: it always follows [0]")
      ->needs("--teleop")
      ->option_text("BUTTON")
      ->group("ROS 2");
}

std::optional<TeleopOfHand> teleopOf(const RosOptions& options, const std::vector<std::string>& hands) {
  if (options.teleop_hand.empty()) return std::nullopt;
  const std::string name = options.name_space + "/" + options.teleop_hand;
  const auto found = std::find(hands.begin(), hands.end(), name);
  if (found == hands.end()) {
    std::string all;
    for (const std::string& hand : hands) all += (all.empty() ? "" : ", ") + hand.substr(options.name_space.size() + 1);
    throw Error("--teleop " + options.teleop_hand + ": there is no such hand, but " + all);
  }
  return TeleopOfHand{static_cast<std::size_t>(found - hands.begin()), options.teleop};
}

}  // namespace

void addRosOptions(CLI::App& app, RosOptions& options) {
  app.add_option_function<std::string>(
         "--ros", [&options](const std::string& name) { options.name_space = rosNamespace(name); },
         "serve topics of ROS 2 under this namespace, in the domain ROS_DOMAIN_ID: needs hl-ros")
      ->type_name("NAMESPACE")
      ->group("ROS 2");
  app.add_option("--ros-rate", options.rate_Hz, "samples a second of each measured topic")
      ->check(within(1, kMaxStates_Hz))
      ->needs("--ros")
      ->capture_default_str()
      ->group("ROS 2");
  addReachOptions(
      app, options.reach, kRosUse,
      {"ROS 2", "keys for topics that only those with keys of the same authority read and write: see hl keys",
       "network interface of the topics"});
  addTeleopOptions(app, options);
}

std::unique_ptr<RosBridge> makeRosBridge(const RosOptions& options, TouchServer& server, RosBridge::ReportLine report) {
  if (options.name_space.empty()) return nullptr;
  checkReach(options.reach, kRosUse);
  std::vector<TouchSession*> hands;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < server.devices(); ++i) {
    hands.push_back(&server.device(i));
    names.push_back(server.device(i).label().name);
  }
  const RosTask task{HL_VERSION, ddsDomain(), rosHands(options.name_space, names), options.reach};
  const std::optional<TeleopOfHand> teleop = teleopOf(options, task.hands);
  return std::make_unique<RosBridge>(std::make_unique<RosProcess>(task), hands, options.rate_Hz, std::move(report),
                                     teleop);
}

std::string rosPresence() { return presenceOf(kRosProgram, "--ros NAMESPACE", "topics"); }

}  // namespace hl
