// RosBridge: the hands of a server as topics of ROS 2, by hl-ros. One thread, "ros", tells hl-ros how the hands are, at
// a fixed rate, and gives what comes for them to their servos. The servos never wait for it.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "ros/command_judge.h"
#include "ros/ros_link.h"
#include "ros/ros_task.h"
#include "touch/touch_session.h"

namespace hl {

/// Since the start.
struct RosCounts {
  bool running = false;                     ///< hl-ros is there
  std::uint64_t states = 0;                 ///< given to hl-ros; each is a sample of every measured topic of its hand
  std::uint64_t states_lost = 0;            ///< hl-ros was behind
  std::array<std::uint64_t, 2> received{};  ///< commands by RosInput
  std::array<std::uint64_t, static_cast<std::size_t>(CommandVerdict::kVerdicts)> verdicts{};
  std::uint64_t ends = 0;  ///< times that a hand was let go, as no other command came in time
};

/// The names of hands, as their devices are called, with the namespace in front; "hand" of one without a name. What ROS
/// 2 does not allow in a name becomes a _, of which none follows another.
std::vector<std::string> rosHands(const std::string& name_space, const std::vector<std::string>& devices);

/// Constructed, started, stopped and destroyed by one thread; started once. counts(): any thread.
class RosBridge {
 public:
  /// For what a person should know: a line without its end. Called by the thread of the bridge.
  using TellPerson = std::function<void(const std::string&)>;

  /// `hands` by their place in the task of `link`; they outlive it.
  RosBridge(std::unique_ptr<RosLink> link, const std::vector<TouchSession*>& hands, double rate_Hz, TellPerson tell);
  ~RosBridge() { stop(); }
  void start();
  void stop();  ///< lets go of the hands; safe to call twice
  RosCounts counts() const;

 private:
  struct Hand {
    TouchSession* session;
    CommandJudge judge;
    std::int64_t told_ns = 0;  ///< the time of the moment told last
  };
  using Count = std::atomic<std::uint64_t>;

  void run();
  void takeCommands();
  void tellHands();
  void tellRefusal(CommandVerdict verdict);

  const std::unique_ptr<RosLink> link_;
  std::vector<Hand> hands_;
  const std::int64_t period_ns_;
  const TellPerson tell_;
  std::array<Count, 2> received_{};
  std::array<Count, static_cast<std::size_t>(CommandVerdict::kVerdicts)> verdicts_{};
  Count states_{0}, states_lost_{0}, ends_{0};
  std::atomic<bool> running_{false}, linked_{true};
  std::thread thread_;
};

}  // namespace hl
