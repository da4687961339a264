// Peers: the other servers of a shared world: which are there, what they are called, and how their clocks are set.
#pragma once

#include <share.pb.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "share/peer_clock.h"
#include "share/playout.h"
#include "share/share_link.h"
#include "share/share_task.h"

namespace hl {

/// Who this server is in the world.
struct ShareSelf {
  ServerId id = 0;
  std::string name;     ///< 1 to kMaxShareName letters, one in the world
  bool adopts = true;   ///< it takes over objects whose owner is lost
  std::string version;  ///< of HL
};

struct Peer {
  std::string name, version;
  bool adopts = false;
  std::int64_t first_ns = 0, heard_ns = 0;  ///< the first and the last packet of it
  std::int64_t begin_ns = 0;                ///< since when it is there, as it says
  PeerClock clock;
  PlayoutDelay delay;
  SteadyLag lag;
  std::map<std::uint32_t, proto::ShareHand> hands;  ///< by number, as last received
  proto::ShareEcho echo;                            ///< of its last beat
};

/// One thread. Times are this server's, but where a name says otherwise.
class Peers {
 public:
  /// A server that is not heard for so long is lost: five beats in a row.
  static constexpr std::int64_t kLease_ns = 500'000'000;
  static constexpr std::int64_t kBeat_ns = 100'000'000;
  static constexpr std::size_t kMaxPeers = 64;

  Peers(const ShareSelf& self, std::int64_t begin_ns) : self_(self), begin_ns_(begin_ns) {}

  /// A packet of this server has come. False: it is none of the world, as there are too many, or it is this one.
  bool hear(ServerId from, std::int64_t now_ns);
  void hear(const proto::ShareBeat& beat, std::int64_t now_ns);
  void hear(const proto::ShareHand& hand, std::int64_t now_ns);
  /// A packet of the stream was sent at this time of its clock.
  void addTransit(ServerId from, std::int64_t sent_there_ns, std::int64_t now_ns);

  /// What this server publishes ten times a second.
  proto::ShareBeat beat(std::int64_t now_ns) const;

  bool isThere(ServerId id, std::int64_t now_ns) const;
  /// The time of its clock of which things are to be shown now; nothing before its clock is known.
  std::optional<std::int64_t> shownTimeThere_ns(ServerId id, std::int64_t now_ns) const;
  /// Whether this server, of all that are there, takes over what is left without an owner: the one with the lowest
  /// number.
  bool isAdopter(std::int64_t now_ns) const;
  /// Another server is called as this one: nothing until it has been there for three seconds, as one that has ended a
  /// moment ago is no other one.
  const Peer* sameName(std::int64_t now_ns) const;
  /// That one has been there before this one, which therefore leaves.
  bool isSecondOfItsName(std::int64_t now_ns) const;
  std::vector<ServerId> there(std::int64_t now_ns) const;
  const std::map<ServerId, Peer>& all() const { return peers_; }
  /// The times that are shown go on; often.
  void followClocks(std::int64_t now_ns);
  /// Since `deaf_ns` nothing could be heard: those that were there then keep a whole lease from now.
  void hearAgain(std::int64_t deaf_ns, std::int64_t now_ns);
  /// Those that have been lost for a minute go.
  void forget(std::int64_t now_ns);

 private:
  const ShareSelf self_;
  const std::int64_t begin_ns_;
  std::map<ServerId, Peer> peers_;
};

}  // namespace hl
