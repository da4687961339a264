// FrameBuilders: the threads that decode frames and build their shapes, each client's in order, several clients at
// once. Where a refitted hierarchy has become slow they build it anew, one at a time, once it is shown and its client
// has no frame waiting.
#pragma once

#include <thread>
#include <vector>

#include "session/client_table.h"

namespace hl {

class FrameBuilders {
 public:
  static constexpr int kThreads = 2;

  /// The clients outlive it.
  explicit FrameBuilders(ClientTable& clients) : clients_(clients) {}
  void start();
  void join();  ///< after the table has stopped; safe to call twice

 private:
  void run();
  void build(ClientScene& client, WaitingFrame waiting);
  BuiltFrame built(ClientScene& client, WaitingFrame& waiting) const;
  void refuse(ClientScene& client, std::uint64_t number, const char* why);
  void rebuild(ClientScene& client);

  ClientTable& clients_;
  std::vector<std::thread> threads_;
};

}  // namespace hl
