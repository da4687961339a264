// HandMover: where a simulated hand wants to be, 60 times a second: as a person says, a script, or the exploration.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "base/guarded_thread.h"
#include "device/device.h"
#include "device/hand_script.h"
#include "device/simulated_hand.h"
#include "scene/snapshot.h"
#include "scene/still_scene.h"
#include "touch/exploration.h"
#include "touch/live_settings.h"
#include "touch/loop_exchange.h"

namespace hl {

/// Constructed, started, stopped and destroyed by one thread. The other functions: any thread; they change nothing
/// when a person holds the device.
class HandMover {
 public:
  /// Gives the scene that is shown. Any thread.
  using SceneNow = std::function<std::shared_ptr<const Snapshot>()>;

  /// All but `settings` must outlive it.
  HandMover(Device& device, const TouchSettings& settings, const LiveSettings& live, LoopExchange& exchange,
            SceneNow scene);
  ~HandMover() { stop(); }

  /// Before start(): brings the hand to a place clear of the scene, on a virtual clock.
  void bringToStart();
  void start(std::int64_t begin_ns);  ///< time zero of script and exploration
  void stop();                        ///< safe to call twice

  bool hasHand() const { return hand_ != nullptr; }
  void setGoal(const Vec3& goal_W);  ///< a person takes over from the exploration
  void release();
  /// To a place above everything that is no higher than `top_D` (m, device frame), whatever else it is commanded, until
  /// free(). Waits until it is there, `most_s` at most: the scene may hold it. Whether it is there, or there is no
  /// hand.
  bool moveAside(double top_D, double most_s);
  /// Ends moveAside(). Goals that were set meanwhile are dropped.
  void free();
  /// Bit i: button i of the device is down, for a second from now: a page that has gone presses nothing.
  void press(std::uint32_t buttons);
  void turn(const Eigen::Quaterniond& turned_W);  ///< of any length but 0; else it changes nothing
  void openGripper(double gripper_rad);
  void setExplore(bool on);
  void setFirm(bool firm) { firm_ = firm; }
  bool exploring() const { return exploring_.load(); }
  bool firm() const { return firm_.load(); }

 private:
  static constexpr double kFree = -1;

  struct Commands {
    std::optional<Vec3> goal_W;
    bool release = false;
    std::optional<bool> explore;
    std::optional<std::uint32_t> buttons;
    std::optional<Eigen::Quaterniond> turn;
    std::optional<double> gripper_rad;
  };

  struct Aside {
    std::atomic<double> top_D{kFree};  // m; kFree: the hand is where it is commanded to be
    std::atomic<bool> reached{false};
  };

  void run();
  Commands takeCommands();
  void follow(const Commands& commands);
  void follow(std::optional<std::uint32_t> buttons, std::int64_t now_ns);
  std::optional<Vec3> strokingGoal();
  ExploringHand exploringHand();
  void turnAsScripted() const;
  Vec3 above(double top_D) const;
  void holdAside();
  Vec3 clampToWorkspace(const Vec3& goal_D) const;

  Device& device_;
  SimulatedHand* const hand_;  // of the device; null when a person holds it
  const std::optional<HandScript> script_;
  const LiveSettings& live_;
  LoopExchange& exchange_;
  const SceneNow scene_;
  std::int64_t begin_ns_ = 0, pressed_ns_ = 0;
  std::atomic<bool> exploring_, firm_;
  Exploration exploration_;  // of the thread that moves the hand
  StillScene still_;         // of the thread that moves the hand
  std::mutex mutex_;         // of commands_; the real-time loops never lock it
  Commands commands_;
  Aside aside_;
  LoopThread thread_;
};

}  // namespace hl
