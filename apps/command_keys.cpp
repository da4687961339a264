// hl keys: keys with which programs of ROS 2 on other machines may reach a hand, and nobody else.
#include <fmt/core.h>

#include <optional>
#include <string>
#include <vector>

#include "base/printable.h"
#include "commands.h"
#include "ros/governance.h"
#include "ros/keystore.h"
#include "ros/ros_task.h"

namespace hl {

namespace {

struct KeysOptions {
  std::string folder;
  std::vector<std::string> names;
  std::optional<std::uint32_t> domain;  // absent: that of the environment
};

void runKeys(const KeysOptions& options) {
  checkPrintable(options.folder, "the folder of keys");
  const std::uint32_t domain = options.domain ? *options.domain : ddsDomain();
  std::vector<std::string> names;
  for (const std::string& name : options.names) names.push_back(rosNamespace(name));
  makeEnclaves(options.folder, names, domain);
  for (const std::string& name : names)
    fmt::print("{}/enclaves/{}: keys for domain {}\n", options.folder, name, domain);
  fmt::print("keep {}/private to yourself: whoever has it may let others in\n", options.folder);
}

}  // namespace

void addKeysCommand(CLI::App& app) {
  CLI::App* const command =
      app.add_subcommand("keys", "Make keys for topics of ROS 2 and shared worlds beyond this machine");
  const auto options = std::make_shared<KeysOptions>();
  command->add_option("FOLDER", options->folder, "a keystore, as of ros2 security; made where there is none")
      ->required();
  command->add_option("--name", options->names, "of who gets keys, as hand or lab/camera; several times for several")
      ->required()
      ->allow_extra_args(false)
      ->option_text("NAME");
  command->add_option("--domain", options->domain, "of DDS, in which they count; ROS_DOMAIN_ID or 0 without it")
      ->check(CLI::Range(0U, kMaxKeysDomain))
      ->option_text("N");
  command->callback([options] { runKeys(*options); });
}

}  // namespace hl
