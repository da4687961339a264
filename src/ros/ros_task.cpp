#include "ros/ros_task.h"

#include <arpa/inet.h>
#include <net/if.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "base/error.h"
#include "base/printable.h"

namespace hl {

namespace {

constexpr const char *kServe = "--serve", *kInterface = "--interface", *kSecurity = "--security", *kPeer = "--peer";
constexpr const char* kLoopback = "lo";
constexpr std::size_t kMaxHands = 16, kMaxName = 200;  // ROS 2 takes topics of at most 248 characters

bool begins(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool continues(char c) { return begins(c) || (c >= '0' && c <= '9'); }

bool isRosName(const std::string& name) {
  char before = '/';
  for (const char c : name) {
    if (before == '/' ? !begins(c) : !continues(c) && c != '/') return false;
    if (before == '_' && c == '_') return false;
    before = c;
  }
  return before != '/' && name.size() <= kMaxName;
}

std::uint32_t domainOf(const std::string& text, const char* what) {
  checkPrintable(text, what);
  std::uint32_t domain = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, domain);
  if (error != std::errc() || rest != end || domain > kMaxRosDomain)
    throw Error(std::string(what) + " is '" + text + "': it is a number from 0 to " + std::to_string(kMaxRosDomain));
  return domain;
}

}  // namespace

void checkReach(const RosReach& reach) {
  const std::string& name = reach.interface_name;
  checkPrintable(name, "the interface of ROS 2's topics");
  checkPrintable(reach.enclave, "the folder of --ros-security");
  if (name != kLoopback && reach.enclave.empty())
    throw Error(
        "topics of ROS 2 stay on this machine without keys, as beyond it anybody could pull the hand: say "
        "--ros-security FOLDER, which hl keys makes, or leave --ros-interface out");
  if (if_nametoindex(name.c_str()) == 0)
    throw Error("there is no network interface '" + name + "': ip link lists them");
  if (name == kLoopback && !reach.peers.empty())
    throw Error("--ros-peer is of another machine, which lo does not reach: say --ros-interface NAME");
  for (const std::string& peer : reach.peers) {
    in_addr address{};
    checkPrintable(peer, "--ros-peer");
    if (inet_pton(AF_INET, peer.c_str(), &address) != 1)
      throw Error("--ros-peer '" + peer + "' is no address, such as 192.168.1.20");
  }
}

std::vector<std::string> wordsOf(const RosTask& task) {
  std::vector<std::string> words{kServe, task.version, std::to_string(task.domain), kInterface,
                                 task.reach.interface_name};
  if (!task.reach.enclave.empty()) words.insert(words.end(), {kSecurity, task.reach.enclave});
  for (const std::string& peer : task.reach.peers) words.insert(words.end(), {kPeer, peer});
  words.insert(words.end(), task.hands.begin(), task.hands.end());
  return words;
}

RosTask rosTaskOf(const std::vector<std::string>& words) {
  const Error none("it speaks ROS 2's topics for hld and hl, which start it by themselves: try hld --ros hl");
  if (words.size() < 4 || words[0] != kServe) throw none;
  RosTask task{words[1], domainOf(words[2], "the domain"), {}};
  auto word = words.begin() + 3;
  for (; words.end() - word >= 2 && word->starts_with("--"); word += 2) {
    if (*word == kInterface) {
      task.reach.interface_name = word[1];
    } else if (*word == kSecurity) {
      task.reach.enclave = word[1];
    } else if (*word == kPeer) {
      task.reach.peers.push_back(word[1]);
    } else {
      throw none;
    }
  }
  task.hands.assign(word, words.end());
  if (task.hands.empty() || task.hands.size() > kMaxHands || !std::all_of(word, words.end(), isRosName)) throw none;
  checkReach(task.reach);
  return task;
}

std::string rosNamespace(const std::string& name) {
  checkPrintable(name, "the namespace of ROS 2");
  const std::string bare = name.starts_with('/') ? name.substr(1) : name;
  if (!isRosName(bare))
    throw Error("'" + name +
                "' is no namespace of ROS 2: it is made of letters, digits and single _, as lab or lab/table");
  return bare;
}

std::uint32_t rosDomain() {
  const char* const said = std::getenv("ROS_DOMAIN_ID");
  return said == nullptr || *said == 0 ? 0 : domainOf(said, "ROS_DOMAIN_ID");
}

std::string ddsTopic(const std::string& hand, const std::string& name) { return "rt/" + hand + "/" + name; }

std::string rosFrame(const std::string& hand) { return hand + "/base"; }

}  // namespace hl
