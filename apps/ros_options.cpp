#include "ros_options.h"

#include "base/error.h"
#include "commands.h"
#include "ros/ros_process.h"

namespace hl {

namespace {

constexpr double kMostStates_Hz = 1000;

}  // namespace

void addRosOptions(CLI::App& app, RosOptions& options) {
  app.add_option_function<std::string>(
         "--ros", [&options](const std::string& name) { options.name_space = rosNamespace(name); },
         "serve topics of ROS 2 under this namespace, in the domain ROS_DOMAIN_ID: needs hl-ros")
      ->type_name("NAMESPACE")
      ->group("ROS 2");
  app.add_option("--ros-rate", options.rate_Hz, "samples a second of each measured topic")
      ->check(within(1, kMostStates_Hz))
      ->needs("--ros")
      ->capture_default_str()
      ->group("ROS 2");
  app.add_option("--ros-security", options.reach.enclave,
                 "keys for topics that only those with keys of the same authority read and write: see hl keys")
      ->needs("--ros")
      ->option_text("FOLDER")
      ->group("ROS 2");
  app.add_option("--ros-interface", options.reach.interface_name,
                 "network interface of the topics; lo is this machine alone, another needs --ros-security")
      ->needs("--ros")
      ->option_text("NAME")
      ->group("ROS 2");
  app.add_option("--ros-peer", options.reach.peers,
                 "where another machine is, if multicast does not reach it; several times for several")
      ->needs("--ros")
      ->allow_extra_args(false)
      ->option_text("ADDRESS")
      ->group("ROS 2");
}

std::unique_ptr<RosBridge> makeRosBridge(const RosOptions& options, TouchServer& server, RosBridge::TellPerson tell) {
  if (options.name_space.empty()) return nullptr;
  checkReach(options.reach);
  std::vector<TouchSession*> hands;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < server.devices(); ++i) {
    hands.push_back(&server.device(i));
    names.push_back(server.device(i).label().name);
  }
  const RosTask task{HL_VERSION, rosDomain(), rosHands(options.name_space, names), options.reach};
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
