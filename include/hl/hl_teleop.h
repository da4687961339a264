/* The robot's side of a teleoperation: docs/teleoperation.md. C99 and C++; this header and hl_types.h alone, no
 * library.
 *
 * A robot's program takes set-points of hld and sends back the force of what it touches. HLteleopRobot says where the
 * robot is to be led, so that hand, line and robot give no more energy than they were given, whatever the line delays
 * and loses.
 *
 * Units. Metres, newtons, joules, seconds, at the robot; vectors are x y z in the frame of the topics, HAND/base.
 *
 * Errors. There are none: what is no number is left out.
 *
 * Threads. Each structure is used by one thread at a time. No call uses memory, a lock or the system. */
#ifndef HL_HL_TELEOP_H
#define HL_HL_TELEOP_H

#include <math.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Energy of a side ------------------------------------------------------------------------------------------ */

/** What each side may give of its own, J. What is put in fills it up again; what is beyond it goes to the other. */
#define HL_TELEOP_TANK_J 0.010
/** So much of the tank is never planned to be given, J: a force is known when it has been made. */
#define HL_TELEOP_RESERVE_J 0.002
/** The tank never holds more, J: what the other side has given up beyond it is forgotten. */
#define HL_TELEOP_MOST_J 0.5

/** The energy of one side, J. At any time tank_J = HL_TELEOP_TANK_J + put_in_J - given_J - sent_J + received. */
typedef struct HLteleopPort {
  double tank_J;      /**< what this side may still give; below zero it is a debt */
  double sent_J;      /**< total given up to the other side, to be sent to it: it never goes down */
  double received_J;  /**< the total of the other side, as last taken */
  double forgotten_J; /**< what of it found no room in the tank */
  double put_in_J;    /**< total of work done at this side against the force */
  double given_J;     /**< total of work that the force has done at this side */
} HLteleopPort;

/** The port at its start: a full tank. */
static inline HLteleopPort hlTeleopPort(void) {
  const HLteleopPort port = {HL_TELEOP_TANK_J, 0, 0, 0, 0, 0};
  return port;
}

/** The force has done this work, J, at this side; below zero, work was done against it. */
static inline void hlTeleopBook(HLteleopPort* port, double work_J) {
  double over_J;
  if (!isfinite(work_J)) return;
  port->tank_J -= work_J;
  if (work_J >= 0) {
    port->given_J += work_J;
    return;
  }
  port->put_in_J -= work_J;
  over_J = fmin(port->tank_J - HL_TELEOP_TANK_J, -work_J);
  if (over_J <= 0) return;
  port->tank_J -= over_J;
  port->sent_J += over_J;
}

/** The other side's total has come. One that is not above the last, being late or sent twice, changes nothing. */
static inline void hlTeleopReceive(HLteleopPort* port, double total_J) {
  double come_J, kept_J;
  if (!isfinite(total_J) || total_J <= port->received_J) return;
  come_J = total_J - port->received_J;
  kept_J = fmax(0, fmin(come_J, HL_TELEOP_MOST_J - port->tank_J));
  port->tank_J += kept_J;
  port->forgotten_J += come_J - kept_J;
  port->received_J = total_J;
}

/** The other side has begun anew, with this total: from now on what it adds to it counts. */
static inline void hlTeleopReceiveAnew(HLteleopPort* port, double total_J) {
  if (isfinite(total_J)) port->received_J = total_J;
}

/* ---- Robot ----------------------------------------------------------------------------------------------------- */

/** The reference follows its goal so late, s: set-points that come unevenly do not shake the robot. */
#define HL_TELEOP_LAG_S 0.020

/** The robot's side. */
typedef struct HLteleopRobot {
  HLteleopPort port;     /**< its energy */
  double reference_m[3]; /**< where the robot is to be led: by its own controller, as stiff as that can */
  double goal_m[3];      /**< where the hand wants it */
  double zero_m[3];      /**< where that is for a set-point of 0 0 0 */
  double way_m[3];       /**< of the reference in the last step */
  double force_N[3];     /**< of the last step */
  double speed_m_s;      /**< the reference is never faster */
  int has_goal;          /**< 0: no set-point has come */
} HLteleopRobot;

/** A robot that stays at `place_m` until set-points come. */
static inline HLteleopRobot hlTeleopRobot(const double* place_m, double speed_m_s) {
  HLteleopRobot robot = {{0, 0, 0, 0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0, 0};
  int i;
  robot.port = hlTeleopPort();
  robot.speed_m_s = speed_m_s;
  for (i = 0; i < 3; ++i) robot.reference_m[i] = robot.goal_m[i] = robot.zero_m[i] = place_m[i];
  return robot;
}

/** A set-point has come. The first one, and the first of another sender, with `anew`, is where the reference is now, so
 * that the robot never jumps. */
static inline void hlTeleopSetPoint(HLteleopRobot* robot, const double* set_point_m, int anew) {
  int i;
  for (i = 0; i < 3; ++i)
    if (!isfinite(set_point_m[i])) return;
  for (i = 0; i < 3; ++i) {
    if (anew || !robot->has_goal) robot->zero_m[i] = robot->reference_m[i] - set_point_m[i];
    robot->goal_m[i] = robot->zero_m[i] + set_point_m[i];
  }
  robot->has_goal = 1;
}

/** Books the last step of the reference under the force that it has led to. */
static inline void hlTeleopBookStep(HLteleopRobot* robot, const double* force_N) {
  double work_J = 0;
  int i;
  for (i = 0; i < 3; ++i) work_J -= 0.5 * (robot->force_N[i] + force_N[i]) * robot->way_m[i];
  hlTeleopBook(&robot->port, work_J);
}

/** Moves the reference toward its goal: along the force, or across it, as it likes; against it as far as the tank pays.
 * The force counts as it will be if it goes on to change as in the last step. */
static inline void hlTeleopMove(HLteleopRobot* robot, const double* force_N, double period_s) {
  double next_N[3], square_N2 = 0, square_m2 = 0, work_J = 0, part, unpaid_J;
  int i;
  for (i = 0; i < 3; ++i) {
    next_N[i] = 2 * force_N[i] - robot->force_N[i];
    robot->way_m[i] = robot->goal_m[i] - robot->reference_m[i];
    square_N2 += next_N[i] * next_N[i];
    square_m2 += robot->way_m[i] * robot->way_m[i];
  }
  part = period_s / (HL_TELEOP_LAG_S + period_s);
  if (square_m2 > 0) part = fmin(part, robot->speed_m_s * period_s / sqrt(square_m2));
  for (i = 0; i < 3; ++i) work_J -= part * next_N[i] * robot->way_m[i];
  unpaid_J = work_J - fmax(0, robot->port.tank_J - HL_TELEOP_RESERVE_J);
  for (i = 0; i < 3; ++i) {
    robot->way_m[i] *= part;
    if (work_J > 0 && unpaid_J > 0) robot->way_m[i] += unpaid_J * next_N[i] / square_N2;
    robot->reference_m[i] += robot->way_m[i];
  }
}

/** One step of the robot's loop. `force_N` is that of what it touches on the robot: the force that is sent to the hand,
 * and not one of the robot's own controller, which also moves the robot where it touches nothing. */
static inline void hlTeleopStep(HLteleopRobot* robot, const double* force_N, double period_s) {
  double known_N[3];
  int i;
  for (i = 0; i < 3; ++i) known_N[i] = isfinite(force_N[i]) ? force_N[i] : 0;
  hlTeleopBookStep(robot, known_N);
  hlTeleopMove(robot, known_N, period_s);
  for (i = 0; i < 3; ++i) robot->force_N[i] = known_N[i];
}

#ifdef __cplusplus
}
#endif

#endif
