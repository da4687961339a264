#include "ros/dds_reach.h"

#include <arpa/inet.h>
#include <net/if.h>

#include <charconv>
#include <cstdlib>

#include "base/error.h"
#include "base/printable.h"

namespace hl {

namespace {

constexpr const char *kInterface = "--interface", *kSecurity = "--security", *kPeer = "--peer";
constexpr const char* kLoopback = "lo";

}  // namespace

void checkReach(const DdsReach& reach, const DdsUse& use) {
  const std::string option = use.option;
  const std::string& name = reach.interface_name;
  checkPrintable(name, (option + "-interface").c_str());
  checkPrintable(reach.enclave, ("the folder of " + option + "-security").c_str());
  if (name != kLoopback && reach.enclave.empty())
    throw Error("without keys no other machine is reached, as anybody there could " + std::string(use.danger) +
                ": say " + option + "-security FOLDER, which hl keys makes, or leave " + option + "-interface out");
  if (if_nametoindex(name.c_str()) == 0)
    throw Error("there is no network interface '" + name + "': ip link lists them");
  if (name == kLoopback && !reach.peers.empty())
    throw Error(option + "-peer is of another machine, which lo does not reach: say " + option + "-interface NAME");
  for (const std::string& peer : reach.peers) {
    in_addr address{};
    checkPrintable(peer, (option + "-peer").c_str());
    if (inet_pton(AF_INET, peer.c_str(), &address) != 1)
      throw Error(option + "-peer '" + peer + "' is no address, such as 192.168.1.20");
  }
}

std::vector<std::string> wordsOf(const DdsReach& reach) {
  std::vector<std::string> words{kInterface, reach.interface_name};
  if (!reach.enclave.empty()) words.insert(words.end(), {kSecurity, reach.enclave});
  for (const std::string& peer : reach.peers) words.insert(words.end(), {kPeer, peer});
  return words;
}

bool readReach(const std::vector<std::string>& words, std::vector<std::string>::const_iterator& word, DdsReach& reach) {
  for (; words.end() - word >= 2 && word->starts_with("--"); word += 2) {
    if (*word == kInterface) {
      reach.interface_name = word[1];
    } else if (*word == kSecurity) {
      reach.enclave = word[1];
    } else if (*word == kPeer) {
      reach.peers.push_back(word[1]);
    } else {
      return false;
    }
  }
  return true;
}

std::uint32_t ddsDomainOf(const std::string& text, const char* what) {
  checkPrintable(text, what);
  std::uint32_t domain = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, domain);
  if (error != std::errc() || rest != end || domain > kMaxDdsDomain)
    throw Error(std::string(what) + " is '" + text + "': it is a number from 0 to " + std::to_string(kMaxDdsDomain));
  return domain;
}

std::uint32_t ddsDomain() {
  const char* const said = std::getenv("ROS_DOMAIN_ID");
  return said == nullptr || *said == 0 ? 0 : ddsDomainOf(said, "ROS_DOMAIN_ID");
}

}  // namespace hl
