/* A robot that a hand of HL leads: by DDS alone, as a program of ROS 2 would, and with the header hl_teleop.h of HL.
 * The robot is simulated: 1 kg on a spring of 1 kN/m to its reference, and 10 mm below it a wall of 5 kN/m.
 *
 *     hld --ros lab --teleop hand --teleop-clutch none     serves the hand
 *     20_robot lab/hand 30                                 is the robot, for 30 s; of the same machine
 *
 * Of another machine: CYCLONEDDS_URI says where to look and which keys to use. docs/teleoperation.md has an example. */
#define _POSIX_C_SOURCE 200809L
#include <dds/dds.h>
#include <hl/hl_teleop.h>
#include <math.h>
#include <ros2.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static const char* const kThisMachine =
    "<CycloneDDS><Domain><General><Interfaces><NetworkInterface address='127.0.0.1'/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast></General>"
    "<Discovery><ParticipantIndex>auto</ParticipantIndex><Peers><Peer address='localhost'/></Peers></Discovery>"
    "</Domain></CycloneDDS>";
static const double kPeriod_s = 1e-3, kMass_kg = 1, kSpring_N_m = 1000, kWall_N_m = 5000, kWall_m = -0.010;
static const int kSendSteps = 4; /* 250 times a second */

/* What the robot has of DDS. */
typedef struct {
  dds_entity_t set_points, energies_in;    /* readers */
  dds_entity_t forces, energies;           /* writers */
  dds_instance_handle_t hand, energy_hand; /* who sends set-points and energies; 0: nobody yet */
} Topics;

typedef struct {
  HLteleopRobot side;
  double place_m[3], speed_m_s[3], force_N[3]; /* force: of the wall on the robot */
} Robot;

static dds_entity_t topic(dds_entity_t participant, const dds_topic_descriptor_t* type, const char* hand,
                          const char* name) {
  char full[300];
  snprintf(full, sizeof full, "rt/%s/teleop/%s", hand, name);
  return dds_create_topic(participant, type, full, NULL, NULL);
}

static Topics open_topics(dds_entity_t participant, const char* hand) {
  const dds_topic_descriptor_t* const pose = &geometry_msgs_msg_dds__PoseStamped__desc;
  const dds_topic_descriptor_t* const wrench = &geometry_msgs_msg_dds__WrenchStamped__desc;
  const dds_topic_descriptor_t* const number = &std_msgs_msg_dds__Float64__desc;
  dds_qos_t* const sensor = dds_create_qos();
  Topics topics = {0};
  dds_qset_reliability(sensor, DDS_RELIABILITY_BEST_EFFORT, 0);
  topics.set_points = dds_create_reader(participant, topic(participant, pose, hand, "setpoint_cp"), sensor, NULL);
  topics.energies_in = dds_create_reader(participant, topic(participant, number, hand, "energy_in"), sensor, NULL);
  topics.forces = dds_create_writer(participant, topic(participant, wrench, hand, "remote_cf"), sensor, NULL);
  topics.energies = dds_create_writer(participant, topic(participant, number, hand, "remote_energy_in"), sensor, NULL);
  dds_delete_qos(sensor);
  return topics;
}

/* Takes what has come. A new sender is an hld that has begun anew. */
static void hear(Topics* topics, HLteleopRobot* side) {
  void* sample = NULL;
  dds_sample_info_t info;
  while (dds_take(topics->set_points, &sample, &info, 1, 1) > 0) {
    if (info.valid_data) {
      const geometry_msgs_msg_dds__Point_* const p = &((geometry_msgs_msg_dds__PoseStamped_*)sample)->pose.position;
      const double set_point_m[3] = {p->x, p->y, p->z};
      hlTeleopSetPoint(side, set_point_m, info.publication_handle != topics->hand);
      topics->hand = info.publication_handle;
    }
    dds_return_loan(topics->set_points, &sample, 1);
    sample = NULL;
  }
  while (dds_take(topics->energies_in, &sample, &info, 1, 1) > 0) {
    if (info.valid_data) {
      const double total_J = ((std_msgs_msg_dds__Float64_*)sample)->data;
      if (info.publication_handle != topics->energy_hand) hlTeleopReceiveAnew(&side->port, total_J);
      topics->energy_hand = info.publication_handle;
      hlTeleopReceive(&side->port, total_J);
    }
    dds_return_loan(topics->energies_in, &sample, 1);
    sample = NULL;
  }
}

static void publish(const Topics* topics, const Robot* robot) {
  geometry_msgs_msg_dds__WrenchStamped_ wrench = {0};
  const std_msgs_msg_dds__Float64_ energy = {robot->side.port.sent_J};
  wrench.header.frame_id = ""; /* the hand's own */
  wrench.wrench.force.x = robot->force_N[0];
  wrench.wrench.force.y = robot->force_N[1];
  wrench.wrench.force.z = robot->force_N[2];
  dds_write(topics->forces, &wrench);
  dds_write(topics->energies, &energy);
}

/* A millisecond of the robot: critically damped, by its own controller. */
static void move(Robot* robot) {
  const double damping_Ns_m = 2 * sqrt(kSpring_N_m * kMass_kg), kPart_s = kPeriod_s / 4;
  int part, i;
  for (part = 0; part < 4; ++part) {
    const double depth_m = kWall_m - robot->place_m[1];
    robot->force_N[1] = depth_m > 0 ? fmax(0, kWall_N_m * depth_m - 5 * robot->speed_m_s[1]) : 0;
    for (i = 0; i < 3; ++i) {
      const double led_N = kSpring_N_m * (robot->side.reference_m[i] - robot->place_m[i]) +
                           damping_Ns_m * (robot->side.way_m[i] / kPeriod_s - robot->speed_m_s[i]);
      robot->speed_m_s[i] += kPart_s / kMass_kg * (led_N + robot->force_N[i]);
      robot->place_m[i] += kPart_s * robot->speed_m_s[i];
    }
  }
}

/* The end of the next step; a program that was held up does not catch up. */
static void wait_for(struct timespec* next) {
  struct timespec now;
  next->tv_nsec += 1000000;
  if (next->tv_nsec >= 1000000000) {
    next->tv_nsec -= 1000000000;
    ++next->tv_sec;
  }
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (now.tv_sec > next->tv_sec || (now.tv_sec == next->tv_sec && now.tv_nsec > next->tv_nsec)) *next = now;
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, next, NULL);
}

int main(int argc, char** argv) {
  const char* const hand = argc > 1 ? argv[1] : "lab/hand";
  const double seconds = argc > 2 ? atof(argv[2]) : 30;
  const char* const said = getenv("ROS_DOMAIN_ID");
  const dds_domainid_t domain = said == NULL ? 0 : (dds_domainid_t)atoi(said);
  const double place_m[3] = {0, 0, 0};
  Robot robot = {hlTeleopRobot(place_m, 0.5), {0}, {0}, {0}};
  double least_tank_J = HL_TELEOP_TANK_J, most_N = 0;
  struct timespec next;
  long step;
  if (getenv("CYCLONEDDS_URI") == NULL) dds_create_domain(domain, kThisMachine);
  const dds_entity_t participant = dds_create_participant(domain, NULL, NULL);
  Topics topics = open_topics(participant, hand);
  if (topics.set_points < 0 || topics.energies_in < 0 || topics.forces < 0 || topics.energies < 0) {
    fprintf(stderr, "no topics: %s\n", dds_strretcode(topics.set_points));
    return 1;
  }
  clock_gettime(CLOCK_MONOTONIC, &next);
  for (step = 0; step * kPeriod_s < seconds; ++step) {
    hear(&topics, &robot.side);
    hlTeleopStep(&robot.side, robot.force_N, kPeriod_s);
    if (step % kSendSteps == 0) publish(&topics, &robot);
    move(&robot);
    least_tank_J = fmin(least_tank_J, robot.side.port.tank_J);
    most_N = fmax(most_N, robot.force_N[1]);
    if (step % 1000 == 999 && topics.hand != 0)
      printf("at %.1f mm, led to %.1f mm, pressed with %.2f N; put in %.1f mJ, given %.1f mJ, in the tank %.1f mJ\n",
             1e3 * robot.place_m[1], 1e3 * robot.side.reference_m[1], robot.force_N[1], 1e3 * robot.side.port.put_in_J,
             1e3 * robot.side.port.given_J, 1e3 * robot.side.port.tank_J);
    fflush(stdout);
    wait_for(&next);
  }
  printf("led: pressed with %.1f N at the most; least in the tank %.2f mJ\n", most_N, 1e3 * least_tank_J);
  if (topics.hand == 0) fprintf(stderr, "no hand %s in domain %u: hld --ros --teleop must run\n", hand, domain);
  dds_delete(participant);
  return topics.hand == 0;
}
