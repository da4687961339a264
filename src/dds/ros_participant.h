// RosParticipant: hands as ROS 2 sees them, by Cyclone DDS. In the program hl-ros only.
#pragma once

#include <functional>
#include <memory>

#include "ros/packets.h"
#include "ros/ros_task.h"

namespace hl {

class RosParticipant {
 public:
  /// Called by threads of Cyclone DDS, one for each topic at a time; it may throw nothing.
  using Send = std::function<void(const HandCommand&)>;

  /// Others can find its topics when it is there. Throws hl::Error when there is no room for one in this domain.
  RosParticipant(const RosTask& task, Send send);
  ~RosParticipant();
  RosParticipant(const RosParticipant&) = delete;
  RosParticipant& operator=(const RosParticipant&) = delete;

  /// A sample of each measured topic of this hand. One of a hand that there is not is left out.
  void publish(const RosHandState& state);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace hl
