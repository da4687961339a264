// teleop_run on|off SECONDS: the first of the simulated teleoperations of the tests, with or without its control, as a
// CSV with a row each 5 ms, for scripts/figures.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "control/teleop_world.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "teleop_run: say on or off, and how many seconds\n");
    return 2;
  }
  hl::test::TeleopSetting setting;
  setting.control = std::string(argv[1]) == "on";
  hl::test::TeleopWorld world(setting);
  std::printf("time_s,hand_m,reference_m,robot_m,contact_N,felt_N,network_J\n");
  for (int i = 0; i < 1000 * std::atof(argv[2]); ++i) {
    world.step();
    if (i % 5 != 0) continue;
    std::printf("%.3f,%.6f,%.6f,%.6f,%.4f,%.4f,%.6f\n", world.time_s(), world.tip().y(), world.robot().reference_m[1],
                world.robotPlace().y(), world.contact_N().y(), world.felt_N().y(), world.network_J());
  }
  return 0;
}
