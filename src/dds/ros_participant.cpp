#include "dds/ros_participant.h"

#include <dds/dds.h>
#include <ros2.h>

#include <optional>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "dds/dds_node.h"

namespace hl {

/// Of one topic that others write to; outlives its reader.
struct TopicHearing {
  RosInput input;
  std::uint32_t hand;
  std::string frame;
  const RosParticipant::Send* send;
};

/// What one hand has of it.
struct RosHandTopics {
  std::string name, frame;
  dds_entity_t pose, twist, wrench, joy;                           // writers
  dds_entity_t gripper = 0;                                        // made when the hand is known to have one
  dds_entity_t set_point = 0, set_point_velocity = 0, energy = 0;  // made when it is known to lead a robot
};

namespace {

// That of ROS 2's sensors: a reader that is late gets the newest, and nothing is sent twice.
Qos sensorQos(std::int32_t depth) {
  Qos qos = emptyQos();
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, depth);
  const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos.get(), 1, &xcdr1);
  return qos;
}

std::array<double, 3> valueOf(const geometry_msgs_msg_dds__WrenchStamped_& message) {
  const auto& force = message.wrench.force;
  return {force.x, force.y, force.z};
}
std::array<double, 3> valueOf(const geometry_msgs_msg_dds__PoseStamped_& message) {
  const auto& place = message.pose.position;
  return {place.x, place.y, place.z};
}

std::array<double, 3> valueOf(const std_msgs_msg_dds__Float64_& message) { return {message.data, 0, 0}; }

// Empty: the message names none.
template <typename Message>
const char* frameOf(const Message& message) {
  if constexpr (requires { message.header; }) return message.header.frame_id == nullptr ? "" : message.header.frame_id;
  return "";
}

geometry_msgs_msg_dds__Vector3_ vectorOf(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

template <typename Message>
void hear(dds_entity_t reader, void* argument) {
  const TopicHearing& hearing = *static_cast<const TopicHearing*>(argument);
  void* samples[1] = {nullptr};
  dds_sample_info_t infos[1];
  while (dds_take(reader, samples, infos, 1, 1) > 0) {
    if (infos[0].valid_data) {
      const auto& message = *static_cast<const Message*>(samples[0]);
      const char* const frame = frameOf(message);
      (*hearing.send)({hearing.input, hearing.hand, *frame == 0 || hearing.frame == frame,
                       wrappedDifference_ns(dds_time(), infos[0].source_timestamp), monotonicNow_ns(), valueOf(message),
                       infos[0].publication_handle});
    }
    dds_return_loan(reader, samples, 1);
  }
}

}  // namespace

struct RosParticipant::Parts {
  explicit Parts(Send to_send) : send(std::move(to_send)) {}

  void open(const RosTask& task) {
    node.emplace(DdsNodeSettings{"hl-ros", task.domain, task.reach}, [this] {
      HandCommand malformed;
      malformed.input = RosInput::kMalformed;
      send(malformed);
    });
    for (const std::string& hand : task.hands) add(hand);
  }
  dds_entity_t topic(const dds_topic_descriptor_t& type, const std::string& hand, const char* name) const {
    return made(dds_create_topic(node->participant(), &type, ddsTopic(hand, name).c_str(), nullptr, nullptr), "topic");
  }
  dds_entity_t writer(const dds_topic_descriptor_t& type, const std::string& hand, const char* name) const {
    return made(dds_create_writer(node->participant(), topic(type, hand, name), sensorQos(5).get(), nullptr), "writer");
  }
  template <typename Message>
  void listen(const dds_topic_descriptor_t& type, const std::string& hand, const char* name, RosInput input,
              std::size_t number) {
    hearings.push_back(
        std::make_unique<TopicHearing>(TopicHearing{input, static_cast<std::uint32_t>(number), rosFrame(hand), &send}));
    const std::unique_ptr<dds_listener_t, void (*)(dds_listener_t*)> listener(
        dds_create_listener(hearings.back().get()), dds_delete_listener);
    dds_lset_data_available(listener.get(), &hear<Message>);
    made(dds_create_reader(node->participant(), topic(type, hand, name), sensorQos(1).get(), listener.get()), "reader");
  }
  void add(const std::string& hand) {
    listen<geometry_msgs_msg_dds__WrenchStamped_>(geometry_msgs_msg_dds__WrenchStamped__desc, hand, "servo_cf",
                                                  RosInput::kServoCf, hands.size());
    listen<geometry_msgs_msg_dds__PoseStamped_>(geometry_msgs_msg_dds__PoseStamped__desc, hand, "servo_cp",
                                                RosInput::kServoCp, hands.size());
    hands.push_back({hand, rosFrame(hand), writer(geometry_msgs_msg_dds__PoseStamped__desc, hand, "measured_cp"),
                     writer(geometry_msgs_msg_dds__TwistStamped__desc, hand, "measured_cv"),
                     writer(geometry_msgs_msg_dds__WrenchStamped__desc, hand, "measured_cf"),
                     writer(sensor_msgs_msg_dds__Joy__desc, hand, "buttons")});
  }

  void publishGripper(RosHandTopics& hand, const std_msgs_msg_dds__Header_& header, const RosHandState& state) const {
    if (hand.gripper == 0)
      hand.gripper = writer(sensor_msgs_msg_dds__JointState__desc, hand.name, "gripper/measured_js");
    char name[] = "gripper";
    char* names[] = {name};
    double position = state.gripper_rad, effort = state.gripper_N;
    sensor_msgs_msg_dds__JointState_ joint{};
    joint.header = header;
    joint.name._maximum = joint.name._length = joint.position._maximum = joint.position._length = 1;
    joint.effort._maximum = joint.effort._length = 1;
    joint.name._buffer = names;
    joint.position._buffer = &position;
    joint.effort._buffer = &effort;
    dds_write(hand.gripper, &joint);
  }

  // The topics of a hand that leads a robot far away.
  void addTeleop(RosHandTopics& hand, std::size_t number) {
    hand.set_point = writer(geometry_msgs_msg_dds__PoseStamped__desc, hand.name, "teleop/setpoint_cp");
    hand.set_point_velocity = writer(geometry_msgs_msg_dds__TwistStamped__desc, hand.name, "teleop/setpoint_cv");
    hand.energy = writer(std_msgs_msg_dds__Float64__desc, hand.name, "teleop/energy_in");
    listen<geometry_msgs_msg_dds__WrenchStamped_>(geometry_msgs_msg_dds__WrenchStamped__desc, hand.name,
                                                  "teleop/remote_cf", RosInput::kRemoteCf, number);
    listen<std_msgs_msg_dds__Float64_>(std_msgs_msg_dds__Float64__desc, hand.name, "teleop/remote_energy_in",
                                       RosInput::kRemoteEnergy, number);
  }
  void publishTeleop(RosHandTopics& hand, const std_msgs_msg_dds__Header_& header, const RosHandState& state) {
    if (hand.set_point == 0) addTeleop(hand, state.hand);
    const auto& p = state.set_point;
    const geometry_msgs_msg_dds__PoseStamped_ pose{header, {{p[0], p[1], p[2]}, {0, 0, 0, 1}}};
    const geometry_msgs_msg_dds__TwistStamped_ twist{header, {vectorOf(state.set_point_velocity), {0, 0, 0}}};
    const std_msgs_msg_dds__Float64_ energy{state.given_up_J};
    dds_write(hand.set_point, &pose);
    dds_write(hand.set_point_velocity, &twist);
    dds_write(hand.energy, &energy);
  }

  const Send send;
  std::vector<std::unique_ptr<TopicHearing>> hearings;
  std::vector<RosHandTopics> hands;
  std::optional<DdsNode> node;  // its listeners have ended when it is gone
};

RosParticipant::RosParticipant(const RosTask& task, Send send) : parts_(std::make_unique<Parts>(std::move(send))) {
  parts_->open(task);
}

RosParticipant::~RosParticipant() = default;

void RosParticipant::publish(const RosHandState& state) {
  if (state.hand >= parts_->hands.size()) return;
  RosHandTopics& hand = parts_->hands[state.hand];
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  const std_msgs_msg_dds__Header_ header{
      {static_cast<std::int32_t>(state.time_ns / kSecond_ns), static_cast<std::uint32_t>(state.time_ns % kSecond_ns)},
      hand.frame.data()};
  const auto& p = state.position;
  const auto& q = state.orientation;
  const geometry_msgs_msg_dds__PoseStamped_ pose{header, {{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}}};
  const geometry_msgs_msg_dds__TwistStamped_ twist{header,
                                                   {vectorOf(state.velocity), vectorOf(state.angular_velocity)}};
  const geometry_msgs_msg_dds__WrenchStamped_ wrench{header, {vectorOf(state.force), vectorOf(state.torque)}};
  std::array<std::int32_t, kRosButtons> buttons{};
  for (std::size_t i = 0; i < buttons.size(); ++i) buttons[i] = static_cast<std::int32_t>(state.buttons >> i & 1U);
  sensor_msgs_msg_dds__Joy_ joy{};
  joy.header = header;
  joy.buttons._maximum = joy.buttons._length = kRosButtons;
  joy.buttons._buffer = buttons.data();
  dds_write(hand.pose, &pose);
  dds_write(hand.twist, &twist);
  dds_write(hand.wrench, &wrench);
  dds_write(hand.joy, &joy);
  if (state.has_gripper != 0) parts_->publishGripper(hand, header, state);
  if (state.leads_robot != 0) parts_->publishTeleop(hand, header, state);
}

}  // namespace hl
