/* Leads a hand of HL around a circle of 2 cm, as a program of ROS 2 would: by DDS alone, without ROS and without HL.
 *
 *     hld --ros lab                 serves the hand
 *     19_ros_circle lab/hand 30     leads it, for 30 s; of the same machine
 *
 * Cyclone DDS is set to look as ROS 2 does with ROS_LOCALHOST_ONLY=1. */
#include <dds/dds.h>
#include <math.h>
#include <ros2.h>
#include <stdio.h>
#include <stdlib.h>

static const char* const kThisMachine =
    "<CycloneDDS><Domain><General><Interfaces><NetworkInterface address='127.0.0.1'/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast></General>"
    "<Discovery><ParticipantIndex>auto</ParticipantIndex><Peers><Peer address='localhost'/></Peers></Discovery>"
    "</Domain></CycloneDDS>";

static dds_entity_t topic(dds_entity_t participant, const char* hand, const char* name) {
  char full[300];
  snprintf(full, sizeof full, "rt/%s/%s", hand, name);
  return dds_create_topic(participant, &geometry_msgs_msg_dds__PoseStamped__desc, full, NULL, NULL);
}

/* Whether one has come; the newest is in `pose`. */
static int newest(dds_entity_t reader, geometry_msgs_msg_dds__PoseStamped_* pose) {
  void* sample = NULL;
  dds_sample_info_t info;
  int found = 0;
  while (dds_take(reader, &sample, &info, 1, 1) > 0) {
    if (info.valid_data) {
      *pose = *(const geometry_msgs_msg_dds__PoseStamped_*)sample;
      pose->header.frame_id = ""; /* it goes with the sample; an empty one means the hand's own */
      found = 1;
    }
    dds_return_loan(reader, &sample, 1);
    sample = NULL;
  }
  return found;
}

int main(int argc, char** argv) {
  const char* const hand = argc > 1 ? argv[1] : "lab/hand";
  const double seconds = argc > 2 ? atof(argv[2]) : 30;
  const char* const said = getenv("ROS_DOMAIN_ID");
  const dds_domainid_t domain = said == NULL ? 0 : (dds_domainid_t)atoi(said);
  dds_qos_t* const sensor = dds_create_qos();
  dds_qset_reliability(sensor, DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_create_domain(domain, kThisMachine);
  const dds_entity_t participant = dds_create_participant(domain, NULL, NULL);
  const dds_entity_t reader = dds_create_reader(participant, topic(participant, hand, "measured_cp"), sensor, NULL);
  const dds_entity_t writer = dds_create_writer(participant, topic(participant, hand, "servo_cp"), sensor, NULL);
  dds_delete_qos(sensor);
  if (reader < 0 || writer < 0) {
    fprintf(stderr, "no topics: %s\n", dds_strretcode(reader < 0 ? reader : writer));
    return 1;
  }

  const double kRadius_m = 0.02, kTurn_s = 4;
  geometry_msgs_msg_dds__PoseStamped_ pose, home;
  int found = 0;
  double farthest_m = 0;
  const dds_time_t begin = dds_time();
  for (double t = 0; t < seconds; t = 1e-9 * (double)(dds_time() - begin)) {
    if (newest(reader, &pose)) {
      if (!found)
        printf("found: %s at %.3f %.3f %.3f m\n", hand, pose.pose.position.x, pose.pose.position.y,
               pose.pose.position.z);
      if (!found) home = pose;
      found = 1;
      farthest_m = fmax(
          farthest_m, hypot(pose.pose.position.x - home.pose.position.x, pose.pose.position.y - home.pose.position.y));
    }
    if (found) {
      geometry_msgs_msg_dds__PoseStamped_ goal = home;
      goal.pose.position.x += kRadius_m * sin(6.2831853 * t / kTurn_s);
      goal.pose.position.y += kRadius_m * (1 - cos(6.2831853 * t / kTurn_s));
      dds_write(writer, &goal);
    }
    dds_sleepfor(DDS_MSECS(10)); /* a set-point counts for 50 ms */
  }
  if (found) printf("led: as far as %.1f mm\n", 1e3 * farthest_m);
  if (!found) fprintf(stderr, "no hand %s in domain %u: hld --ros must run on this machine\n", hand, domain);
  dds_delete(participant);
  return found ? 0 : 1;
}
