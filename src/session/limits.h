// Limits: everything that a client or a page may have or send, in one place, with the reason for each default.
// What is beyond a limit is refused with a reason; it never reaches the device's loops.
#pragma once

#include <hl.pb.h>

#include <cstdint>

#include "base/machine_memory.h"
#include "scene/scene_limits.h"

namespace hl {

inline constexpr int kMaxCommandsPerMessage = 256;  ///< to bodies: a quarter of what may wait for the loops

struct Limits : SceneLimits {
  // One message.
  std::uint64_t message_bytes = std::uint64_t{4} << 20;  ///< large meshes come in parts; 4 MiB decode in milliseconds
  std::uint64_t open_bytes = std::uint64_t{16} << 10;    ///< until Open is accepted, from anybody
  double messages_Hz = 2000;  ///< per session, with bursts of one second's worth: twice what a 1 kHz client sends

  // What one session may own, beside its scene.
  std::uint64_t upload_bytes = std::uint64_t{1} << 30;  ///< of memory, not yet used by a frame: 20 M vertices
  double frames_Hz = 250;       ///< each frame builds hierarchies; no display or simulation step needs more
  double state_rate_Hz = 1000;  ///< the rate of the loops: there is nothing newer to send

  // The server as a whole.
  /// Of all that clients and pages make the server keep, beside what it takes when nobody is there: a MemoryBudget with
  /// a part set aside for each session and each kept one. Half of the machine's: other programs run on it too.
  std::uint64_t memory_bytes = machineMemory_bytes() / 2;
  std::uint32_t sessions = 32;  ///< HL clients; the SessionHost counts them
  std::uint32_t kept = 32;      ///< clients that have gone and whose objects stay: as many as may come again at once
  std::uint32_t pages = 16;     ///< viewer WebSockets at once; each costs a copy of the scene while it is sent
  std::uint64_t page_message_bytes = 4096;  ///< a page sends a few hundred
  double page_messages_Hz = 500;            ///< a pointer moves 60 to 240 times a second
  std::uint32_t connections = 256;  ///< sockets, whatever they are: far below a process's usual 1024 descriptors
  std::uint32_t workers = 2;        ///< threads that take in large messages, beside one for small ones and replies

  // Patience, in seconds.
  double handshake_s = 5;  ///< TLS, the WebSocket's upgrade, and then Open, each
  double idle_s = 10;      ///< silence: pinged after half of it, ended after one to two of it
  double write_s = 20;     ///< a client that reads nothing for so long while there is something to send is ended
};

/// What Welcome gives a client.
proto::Limits toProto(const Limits& limits);

}  // namespace hl
