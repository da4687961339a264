// SharedWorld: the objects that several servers have in common, as one of them knows them: who owns what, where it is,
// what becomes of it when its owner is lost. A state machine: packets and times go in, packets and replicas come out.
// It knows no sockets, threads or clocks, so that tests run it in a time and a network of their own.
//
// Each object has one owner at a time, which alone sends where it is: the server that defines it while that is there,
// and after that whoever takes it over. A change of owner is an item of a higher epoch; of two that are sent the
// greater (epoch, owner, change) counts everywhere alike.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "share/contents.h"
#include "share/peers.h"
#include "share/playout.h"
#include "share/share_link.h"
#include "share/share_messages.h"

namespace hl {

/// An object that this server publishes, as it is now.
struct LocalItem {
  /// Of one that this server defines; its large parts are among the contents. Null: it has taken the object over.
  std::shared_ptr<const proto::ShareContent> content;
  ItemMotion motion;
};
using LocalItems = std::map<ItemId, LocalItem>;

/// An object that other servers define.
struct Replica {
  ItemId id = 0;
  ServerId owner = 0;
  std::shared_ptr<const proto::ShareContent> content;
  Pose pose;         ///< where it is shown now
  bool own = false;  ///< this server has taken it over
  ItemMotion begin;  ///< of an own one: where it was, and how fast, when it was taken over
};

/// A body of this server that another one had meanwhile: it is to be placed so.
struct ReturnedItem {
  ItemId id = 0;
  ItemMotion motion;
};

/// What hands of another server have pressed on a body of this one.
struct ItemPush {
  ItemId id = 0;
  Vec3 impulse_N_s = Vec3::Zero();  ///< on the body, W
  Vec3 point_O = Vec3::Zero();      ///< m
  double duration_s = 0;
};

/// Since the start, but where it says otherwise.
struct ShareCounts {
  std::size_t peers = 0, items = 0, own_items = 0;  ///< now; own: also those that were taken over
  std::size_t fetching = 0;                         ///< contents, now
  std::uint64_t adopted = 0;                        ///< objects that were taken over
  std::uint64_t returned = 0;                       ///< that were taken back
  std::uint64_t lost_claims = 0;                    ///< that another server had claimed as well, which counts
  std::uint64_t refused = 0;                        ///< packets that make no sense
  std::uint64_t left_out = 0;                       ///< objects of others, each time, that there was no room for
  std::uint64_t pushes_sent = 0, pushes_taken = 0;
  std::uint64_t fetched_bytes = 0;
  double playout_ms = 0, round_trip_ms = 0;  ///< the longest of all peers, now
  double join_s = 0;                         ///< from the start until all that was sent first was here; 0: not yet
};

/// One thread.
class SharedWorld {
 public:
  /// False: the link takes none now.
  using Send = std::function<bool(const SharePacket& packet)>;
  /// That one server publishes.
  static constexpr std::size_t kMaxItems = 10'000;
  /// Of all servers together, those that were deleted of late among them: all of one may be replaced at once.
  static constexpr std::size_t kMaxRecords = 2 * kMaxItems;

  SharedWorld(const ShareSelf& self, std::int64_t now_ns, Send send);

  Contents& contents() { return contents_; }
  const Peers& peers() const { return peers_; }

  void hear(const SharePacket& packet, std::int64_t now_ns);
  /// The link was away since `deaf_ns` and knows nothing of what was sent: all is sent again, and who was there then is
  /// not lost yet.
  void linkAgain(std::int64_t deaf_ns, std::int64_t now_ns);
  /// The objects of this server as they are now, 120 times a second; `complete`: no other one is still being prepared.
  void publish(const LocalItems& local, bool complete, std::int64_t now_ns);
  void publishHand(std::uint32_t number, const proto::OtherDevice& hand, std::int64_t now_ns);
  /// A hand has pressed on a replica whose owner has it as a body.
  void press(const ItemPush& push);
  /// Beats, adoptions, contents; after publish(), and as often as packets come.
  void step(std::int64_t now_ns);

  /// By rising ids. Contents may not be here yet.
  std::vector<Replica> replicas(std::int64_t now_ns) const;
  /// Whether one of them has gone elsewhere at once since the last call, as another server owns it.
  bool takeJumped() { return std::exchange(jumped_, false); }
  std::vector<ReturnedItem> takeReturned() { return std::exchange(returned_, {}); }
  std::vector<ItemPush> takePushes() { return std::exchange(pushes_, {}); }
  ShareCounts counts(std::int64_t now_ns) const;

 private:
  /// What was last sent of an object that this server owns.
  struct Sent {
    ItemMotion motion;
    std::int64_t time_ns = 0;
    std::int64_t item_ns = 0;  // of the last item
    int still = 0;             // looks without a motion
    bool dirty = false;        // its item is to be sent
  };
  struct Record {
    proto::ShareItem item;  // the newest
    std::shared_ptr<const proto::ShareContent> content;
    std::int64_t heard_ns = 0;
    Track track;  // of its owner's poses, if that is another server
    Sent sent;
    ItemMotion begin;                            // when this server took it over
    std::map<ServerId, std::uint64_t> pushed{};  // numbers of the last pushes
  };

  bool isOwn(const Record& record) const { return record.item.owner() == self_.id; }
  void hearItem(const proto::ShareItem& item, std::int64_t now_ns);
  void sendWinner(const proto::ShareItem& winner, const proto::ShareItem& older);
  void post(ServerId to, proto::ShareMessage message);
  void hearPoses(const proto::SharePoses& poses, std::int64_t now_ns);
  void hearPush(const proto::SharePush& push);
  void define(ItemId id, const LocalItem& local, std::int64_t now_ns);
  void own(Record& record, std::uint64_t epoch, const ItemMotion& motion, std::int64_t now_ns);
  static void setMotion(Record& record, const ItemMotion& motion, std::int64_t time_ns, bool moving);
  static void change(Record& record);
  static void look(Record& record, const ItemMotion& motion, std::int64_t now_ns);
  void endDeleted(const LocalItems& local, bool complete, std::int64_t now_ns);
  void streamMoving(std::int64_t now_ns);
  void adoptOrphans(std::int64_t now_ns);
  void forget(std::int64_t now_ns);
  void forgetDeleted(std::int64_t before_ns);
  bool hasRoom();
  void sendItems();
  void sendInbox();
  void chooseContents(std::int64_t now_ns);
  bool sendTo(Lane lane, std::uint64_t key, const proto::ShareMessage& message) const;

  const ShareSelf self_;
  const Send send_;
  const std::int64_t begin_ns_;
  Peers peers_;
  Contents contents_;
  std::map<ItemId, Record> records_;
  std::deque<std::pair<ServerId, proto::ShareMessage>> inbox_out_;  // by receiver
  std::map<ItemId, std::uint64_t> push_numbers_;
  std::vector<ReturnedItem> returned_;
  std::vector<ItemPush> pushes_;
  std::int64_t beat_ns_;
  bool jumped_ = false;
  bool full_ = false;          // since the last beat
  bool names_changed_ = true;  // of contents that objects have
  ShareCounts counts_;
};

}  // namespace hl
