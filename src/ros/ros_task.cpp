#include "ros/ros_task.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "base/error.h"
#include "base/printable.h"

namespace hl {

namespace {

constexpr std::uint32_t kMaxDomain = 232;  // more have no UDP ports: DDSI-RTPS 9.6.1.1
constexpr const char* kServe = "--serve";
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
  if (error != std::errc() || rest != end || domain > kMaxDomain)
    throw Error(std::string(what) + " is '" + text + "': it is a number from 0 to " + std::to_string(kMaxDomain));
  return domain;
}

}  // namespace

std::vector<std::string> wordsOf(const RosTask& task) {
  std::vector<std::string> words{kServe, task.version, std::to_string(task.domain)};
  words.insert(words.end(), task.hands.begin(), task.hands.end());
  return words;
}

RosTask rosTaskOf(const std::vector<std::string>& words) {
  const bool fits = words.size() >= 4 && words.size() <= 3 + kMaxHands && words[0] == kServe &&
                    std::all_of(words.begin() + 3, words.end(), isRosName);
  if (!fits) throw Error("it speaks ROS 2's topics for hld and hl, which start it by themselves: try hld --ros hl");
  return {words[1], domainOf(words[2], "the domain"), {words.begin() + 3, words.end()}};
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
