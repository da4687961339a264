#include "ros_options.h"

#include "base/error.h"
#include "commands.h"
#include "ros/ros_process.h"

namespace hl {

namespace {

constexpr double kMostStates_Hz = 1000;

// An option, so that who looks for it reads why.
std::string refuseInterface(const std::string& name) {
  if (name == "lo" || name == "127.0.0.1") return {};
  return "topics of ROS 2 stay on this machine, as beyond it anybody could pull the hand: they would need DDS "
         "Security, "
         "which hl-ros does not have. Leave the option out, and run what reads the topics here";
}

}  // namespace

void addRosOptions(CLI::App& app, RosOptions& options) {
  app.add_option_function<std::string>(
         "--ros", [&options](const std::string& name) { options.name_space = rosNamespace(name); },
         "serve topics of ROS 2 under this namespace, on this machine alone, in the domain ROS_DOMAIN_ID: needs hl-ros")
      ->type_name("NAMESPACE")
      ->group("ROS 2");
  app.add_option("--ros-rate", options.rate_Hz, "samples a second of each measured topic")
      ->check(within(1, kMostStates_Hz))
      ->needs("--ros")
      ->capture_default_str()
      ->group("ROS 2");
  app.add_option("--ros-interface", "network interface of the topics: lo alone, there is no DDS Security")
      ->check(CLI::Validator([](const std::string& name) { return refuseInterface(name); }, ""))
      ->option_text("NAME")
      ->group("ROS 2");
}

std::unique_ptr<RosBridge> makeRosBridge(const RosOptions& options, TouchServer& server, RosBridge::TellPerson tell) {
  if (options.name_space.empty()) return nullptr;
  std::vector<TouchSession*> hands;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < server.devices(); ++i) {
    hands.push_back(&server.device(i));
    names.push_back(server.device(i).label().name);
  }
  const RosTask task{HL_VERSION, rosDomain(), rosHands(options.name_space, names)};
  return std::make_unique<RosBridge>(std::make_unique<RosProcess>(task), hands, options.rate_Hz, std::move(tell));
}

std::string rosPresence() {
  if (rosProgram().empty()) return kNoRosProgram;
  try {
    return "hl-ros is here, for --ros NAMESPACE; topics would be in domain " + std::to_string(rosDomain());
  } catch (const Error& error) {
    return error.what();
  }
}

}  // namespace hl
