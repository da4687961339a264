// Names and domains of ROS 2, and the words that hl-ros is started with.
#include "ros/ros_task.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "base/error.h"

namespace hl::test_ros_task {
namespace {

TEST(RosTask, ItsWordsAreReadAgain) {
  const RosTask task{"1.2.3", 42, {"lab/left", "lab/right"}, {"lo", "my keys", {}}};
  const RosTask again = rosTaskOf(wordsOf(task));
  EXPECT_EQ(again.version, task.version);
  EXPECT_EQ(again.domain, task.domain);
  EXPECT_EQ(again.hands, task.hands);
  EXPECT_EQ(again.reach.interface_name, "lo");
  EXPECT_EQ(again.reach.enclave, "my keys");
}

TEST(RosTask, OtherMachinesAreReachedWithKeysAlone) {
  const auto refusalOf = [](const DdsReach& reach) -> std::string {
    try {
      checkReach(reach, kRosUse);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(refusalOf({}), "");
  EXPECT_EQ(refusalOf({"lo", "keys", {}}), "");
  EXPECT_NE(refusalOf({"eth0", "", {}}).find("--ros-security FOLDER"), std::string::npos);
  EXPECT_NE(refusalOf({"nowhere0", "keys", {}}).find("there is no network interface 'nowhere0'"), std::string::npos);
  EXPECT_NE(refusalOf({"lo", "keys", {"10.0.0.1"}}).find("--ros-interface"), std::string::npos);
  EXPECT_NE(refusalOf({"lo\n", "keys", {}}).find("control character"), std::string::npos);
}

TEST(RosTask, OtherWordsAreRefused) {
  const std::vector<std::string> good{"--serve", "1", "0", "hl/hand"};
  EXPECT_NO_THROW(rosTaskOf(good));
  EXPECT_THROW(rosTaskOf({}), Error);
  EXPECT_THROW(rosTaskOf({good.begin(), good.end() - 1}), Error);
  EXPECT_THROW(rosTaskOf({"--help"}), Error);
  for (const auto& [place, word] : std::vector<std::pair<std::size_t, std::string>>{
           {0, "--read"}, {2, "233"}, {2, "-1"}, {2, "1x"}, {2, ""}, {3, "/hl"}, {3, "a b"}, {3, ""}}) {
    std::vector<std::string> words = good;
    words[place] = word;
    EXPECT_THROW(rosTaskOf(words), Error) << word;
  }
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
           {"--interface"}, {"--interface", "eth0"}, {"--peer", "10.0.0.1"}, {"--other", "word"}}) {
    std::vector<std::string> words = good;
    words.insert(words.begin() + 3, more.begin(), more.end());
    EXPECT_THROW(rosTaskOf(words), Error) << more[0];
  }
  std::vector<std::string> many = good;
  many.insert(many.end(), 16, "hl/more");
  EXPECT_THROW(rosTaskOf(many), Error);
}

TEST(RosTask, NamespacesAreThoseOfRos) {
  EXPECT_EQ(rosNamespace("lab"), "lab");
  EXPECT_EQ(rosNamespace("/lab"), "lab");
  EXPECT_EQ(rosNamespace("lab_2/Table"), "lab_2/Table");
  for (const char* name :
       {"", "/", "//lab", "lab/", "lab//x", "2lab", "lab/2", "lab-x", "a__b", "lab x", "lab\n", "l\xc3\xa4"})
    EXPECT_THROW(rosNamespace(name), Error) << name;
  EXPECT_THROW(rosNamespace(std::string(300, 'a')), Error);
}

TEST(RosTask, TopicsAndFramesOfAHand) {
  EXPECT_EQ(ddsTopic("lab/left", "measured_cp"), "rt/lab/left/measured_cp");
  EXPECT_EQ(rosFrame("lab/left"), "lab/left/base");
}

TEST(RosTask, TheDomainIsThatOfTheEnvironment) {
  unsetenv("ROS_DOMAIN_ID");
  EXPECT_EQ(ddsDomain(), 0u);
  setenv("ROS_DOMAIN_ID", "", 1);
  EXPECT_EQ(ddsDomain(), 0u);
  setenv("ROS_DOMAIN_ID", "232", 1);
  EXPECT_EQ(ddsDomain(), 232u);
  for (const char* said : {"233", "-1", "home", "1 ", "99999999999999999999"}) {
    setenv("ROS_DOMAIN_ID", said, 1);
    EXPECT_THROW(ddsDomain(), Error) << said;
  }
  unsetenv("ROS_DOMAIN_ID");
}

}  // namespace
}  // namespace hl::test_ros_task
