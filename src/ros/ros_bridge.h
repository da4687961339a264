// RosBridge: the hands of a server as topics of ROS 2, by hl-ros. One thread, "ros", sends hl-ros how the hands are, at
// a fixed rate, and gives what comes for them to their servos. The servos never wait for it. When hl-ros ends by
// itself, hands feel what they feel when commands stay away, and it is started again.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/guarded_thread.h"
#include "ros/command_judge.h"
#include "ros/hand_motion.h"
#include "ros/remote_judge.h"
#include "ros/ros_link.h"
#include "ros/ros_task.h"
#include "ros/start_pauses.h"
#include "ros/teleop_clutch.h"
#include "touch/touch_session.h"

namespace hl {

/// Of the hand that leads a robot far away.
struct TeleopView {
  bool engaged = false;  ///< its clutch holds
  RemotePort port{};     ///< its energy, J at the hand
};

/// Since the start.
struct RosCounts {
  bool running = false;           ///< hl-ros is there
  std::uint64_t states = 0;       ///< given to hl-ros; each is a sample of every measured topic of its hand
  std::uint64_t states_lost = 0;  ///< hl-ros was behind
  std::array<std::uint64_t, kRosInputs> received{};  ///< commands by RosInput
  std::array<std::uint64_t, static_cast<std::size_t>(CommandVerdict::kVerdicts)> verdicts{};
  std::uint64_t ends = 0;    ///< times that a hand was let go, as no other command came in time
  std::uint64_t starts = 0;  ///< times that hl-ros was started again
  std::optional<TeleopView> teleop{};
};

/// Which hand leads a robot far away, by its place.
struct TeleopOfHand {
  std::size_t hand = 0;
  TeleopSettings settings{};
};

/// The names of hands, as their devices are called, with the namespace in front; "hand" of one without a name. What ROS
/// 2 does not allow in a name becomes a _, of which none follows another.
std::vector<std::string> rosHands(const std::string& name_space, const std::vector<std::string>& devices);

/// Constructed, started, stopped and destroyed by one thread; started once. counts(): any thread.
class RosBridge {
 public:
  /// For what a person should know: a line without its end. Called by the thread of the bridge.
  using ReportLine = std::function<void(const std::string&)>;

  /// `hands` by their place in the task of `link`; they outlive it.
  RosBridge(std::unique_ptr<RosLink> link, const std::vector<TouchSession*>& hands, double rate_Hz, ReportLine report,
            const std::optional<TeleopOfHand>& teleop = std::nullopt);
  ~RosBridge() { stop(); }
  void start();
  void stop();  ///< lets go of the hands; safe to call twice
  RosCounts counts() const;

 private:
  /// Of a hand that leads a robot.
  struct Leading {
    TeleopSettings settings;
    RemoteJudge judge;
    TeleopClutch clutch;
    RemotePort port{};
  };
  struct Hand {
    TouchSession* session;
    CommandJudge judge;
    std::optional<Leading> leading{};
    std::int64_t published_ns = 0;  ///< the time of the moment last published
  };
  using Count = std::atomic<std::uint64_t>;

  void run();
  void startAgain();
  void takeCommands();
  CommandVerdict take(Hand& hand, const HandCommand& command);
  void publishHands();
  void lead(Hand& hand, const HandMotion& motion, RosHandState& state);
  void giveInput(const Hand& hand);
  void reportRefusal(CommandVerdict verdict);

  const std::unique_ptr<RosLink> link_;
  std::vector<Hand> hands_;
  const std::int64_t period_ns_;
  const ReportLine report_;
  std::array<Count, kRosInputs> received_{};
  std::array<Count, static_cast<std::size_t>(CommandVerdict::kVerdicts)> verdicts_{};
  Count states_{0}, states_lost_{0}, ends_{0}, starts_{0};
  StartPauses pauses_;
  std::atomic<bool> linked_{true};
  mutable std::mutex teleop_mutex_;
  std::optional<TeleopView> teleop_;
  LoopThread thread_;
};

}  // namespace hl
