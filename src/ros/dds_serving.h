// What hl-ros and hl-share do alike for the server that has started them.
#pragma once

#include <cstdint>
#include <string>

namespace hl {

/// Throws hl::Error unless both are of one version. Closes all but the standard files: sockets of the server that came
/// along.
void beginServing(const std::string& own_version, const std::string& version_of_server);

/// To the server, once, before any other packet: others can find what is served from now on.
struct DdsReady {
  std::uint64_t ready = 1;
};

}  // namespace hl
