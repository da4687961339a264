// A worker for test_worker_pool.cpp: does what the first word of an order says.
#include <fmt/core.h>
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <new>

#include "base/error.h"
#include "fleet/worker_pool.h"

int main(int, char** argv) {
  const std::string folder = argv[1];
  hl::answerOrders([&](const hl::FleetOrderText& order) {
    const std::string& what = order.words.at(0);
    std::printf("on standard output, where it disturbs nobody\n");
    std::fflush(stdout);
    if (what == "fail") throw hl::Error("it is\nbroken");
    if (what == "memory") throw std::bad_alloc();
    if (what == "leave") _exit(3);
    if (what == "die") {
      fmt::print(stderr, "first line\nlast words\n");
      raise(SIGKILL);
    }
    if (order.scene_sha256 != "scene" || order.path_sha256 != "path") throw hl::Error("hashes got lost");
    std::ofstream(folder + "/" + order.name) << order.rows << " " << getpid() << " " << getppid();
  });
  return 0;
}
