#include "session/placed_client.h"

namespace hl {

namespace {

// Nobody waits for what becomes of frames, as there are none.
FrameCallbacks noCallbacks() {
  return {[](std::uint64_t, double) {}, [](std::uint64_t, std::size_t, const std::vector<std::string>&) {},
          [](std::uint64_t, const std::string&) {}};
}

}  // namespace

PlacedClient::PlacedClient(ClientTable& clients, std::uint32_t session, const MemoryBudget& memory)
    : clients_(clients),
      session_(session),
      memory_(memory),
      scene_(clients.join(session, SceneLimits{}, memory, noCallbacks())) {}

}  // namespace hl
