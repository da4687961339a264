#include "share_options.h"

#include <sys/random.h>
#include <unistd.h>

#include <array>

#include "base/error.h"
#include "choice_option.h"
#include "dds_options.h"
#include "share/share_process.h"
#include "value_checks.h"

namespace hl {

namespace {

constexpr const char* kGroupOfWorlds = "Shared worlds";

std::string machineName() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

// Another one for each start, so that nobody takes what it does for what was done before.
ServerId randomId() {
  ServerId id = 0;
  while (id == 0) {
    if (getrandom(&id, sizeof id, 0) != sizeof id) throw Error("the system gives no random number");
  }
  return id;
}

CLI::Validator shareName() {
  return passing([](const std::string& name) { checkShareName(name, "the name"); });
}

}  // namespace

void addShareOptions(CLI::App& app, ShareOptions& options) {
  app.add_option("--share", options.world,
                 "share the scene and the hands with the other servers of this world, in the domain ROS_DOMAIN_ID: "
                 "needs hl-share")
      ->check(shareName())
      ->option_text("WORLD")
      ->group(kGroupOfWorlds);
  app.add_option("--share-name", options.name,
                 "what this server is called there, one in the world (default: as the machine is)")
      ->needs("--share")
      ->option_text("NAME")
      ->group(kGroupOfWorlds)
      ->check(shareName());
  addSwitch(app, "--share-adopt", options.adopt, "whether it takes over what a server leaves behind that is lost [on]")
      ->needs("--share")
      ->option_text("on|off")
      ->group(kGroupOfWorlds);
  addReachOptions(app, options.reach, kShareUse,
                  {kGroupOfWorlds, "keys: only those with keys of the same authority are in the world; see hl keys",
                   "network interface to the other servers"});
}

std::unique_ptr<ShareBridge> makeShareBridge(const ShareOptions& options, TouchServer& server,
                                             ShareBridge::ReportLine report) {
  if (options.world.empty()) return nullptr;
  checkReach(options.reach, kShareUse);
  const std::string name = options.name.empty() ? shareNameLike(machineName()) : options.name;
  const ShareSelf self{randomId(), name, options.adopt, HL_VERSION};
  const ShareTask task{HL_VERSION, ddsDomain(), options.world, self.id, options.reach};
  return std::make_unique<ShareBridge>(std::make_unique<ShareProcess>(task), options.world, self, server,
                                       std::move(report));
}

ReadShare readerOf(const ShareBridge* bridge) {
  if (bridge == nullptr) return {};
  return [bridge] { return bridge->view(); };
}

std::string sharePresence() { return presenceOf(kShareProgram, "--share WORLD", "worlds"); }

}  // namespace hl
