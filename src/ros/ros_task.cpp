#include "ros/ros_task.h"

#include <algorithm>

#include "base/error.h"
#include "base/printable.h"

namespace hl {

namespace {

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

}  // namespace

std::vector<std::string> wordsOf(const RosTask& task) {
  std::vector<std::string> words{kServe, task.version, std::to_string(task.domain)};
  const std::vector<std::string> reach = wordsOf(task.reach);
  words.insert(words.end(), reach.begin(), reach.end());
  words.insert(words.end(), task.hands.begin(), task.hands.end());
  return words;
}

RosTask rosTaskOf(const std::vector<std::string>& words) {
  const Error none("it speaks ROS 2's topics for hld and hl, which start it by themselves: try hld --ros hl");
  if (words.size() < 4 || words[0] != kServe) throw none;
  RosTask task{words[1], ddsDomainOf(words[2], "the domain"), {}};
  auto word = words.begin() + 3;
  if (!readReach(words, word, task.reach)) throw none;
  task.hands.assign(word, words.end());
  if (task.hands.empty() || task.hands.size() > kMaxHands || !std::all_of(word, words.end(), isRosName)) throw none;
  checkReach(task.reach, kRosUse);
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

std::string ddsTopic(const std::string& hand, const std::string& name) { return "rt/" + hand + "/" + name; }

std::string rosFrame(const std::string& hand) { return hand + "/base"; }

}  // namespace hl
