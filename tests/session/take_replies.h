// Takes what a server sends to a session, until something is so.
#pragma once

#include <chrono>
#include <functional>
#include <thread>

#include "session/client_session.h"

namespace hl::test {

inline constexpr auto kPatience = std::chrono::seconds(60);  // no test waits so long unless it fails

/// `remember` is given each reply. False: it was not reached in time.
template <typename Remember>
bool takeUntil(ClientSession& session, const Remember& remember, const std::function<bool()>& reached) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!reached()) {
    proto::ServerReply reply;
    while (session.take(reply)) remember(reply);
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace hl::test
