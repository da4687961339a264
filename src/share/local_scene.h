// LocalScene: the objects of this server's own scene and clients, as the other servers of a shared world receive
// them. Those of servers far away are left out.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "share/background_work.h"
#include "share/item_content.h"
#include "share/shared_world.h"

namespace hl {

/// The numbers of a server's objects: the same from scene to scene, and those of its own scene when it is started anew.
class ItemIds {
 public:
  explicit ItemIds(const ShareSelf& self);
  ItemId of(const Instance& instance) const;

 private:
  const std::uint64_t scene_, clients_;
};

/// One thread.
class LocalScene {
 public:
  /// For what a person should know: a line without its end.
  using ReportLine = std::function<void(const std::string&)>;
  /// A mesh that deforms is sent again so often.
  static constexpr std::int64_t kDeformed_ns = 500'000'000;

  /// `others`: the client session whose objects are those of other servers. `work` and `contents` outlive it.
  LocalScene(const ShareSelf& self, std::uint32_t others, BackgroundWork& work, Contents& contents, ReportLine report);

  /// The scene as it is now. What is new is published once it is written, by the background work.
  void look(const Snapshot& scene, std::int64_t now_ns);
  const LocalItems& items() const { return items_; }
  /// Nothing is still being written.
  bool complete() const { return writing_ == 0; }
  /// Whether it is one of this server's, published already or not.
  bool has(ItemId id) const { return rows_.contains(id); }
  /// Of an object that moves as a body: its key in the scene.
  std::optional<std::uint64_t> bodyOf(ItemId id) const;

 private:
  enum class Written : std::uint8_t { kNever, kBeing, kDone, kRefused };
  struct Row {
    Instance instance;  // as it was written last, or is being written
    bool jointed = false;
    Written written = Written::kNever;
    std::int64_t begun_ns = 0;
    std::uint64_t look = 0;  // the last one that has found it
    std::shared_ptr<const proto::ShareContent> content{};
    Content shape{}, surfaces{};  // of the content: held, so that others can fetch them once they are published
  };
  Row* rowOf(ItemId id, const Instance& instance);
  void lookAt(const Instance& instance, bool jointed, std::int64_t now_ns);
  void write(ItemId id, Row& row);
  void take(ItemId id, const WrittenItem& written);
  void refuse(ItemId id, const std::string& why);

  const ItemIds ids_;
  const std::uint32_t others_;
  BackgroundWork& work_;
  Contents& contents_;
  const ReportLine report_;
  const std::shared_ptr<ItemWriter> writer_ = std::make_shared<ItemWriter>();  // of the background work
  std::map<ItemId, Row> rows_;
  LocalItems items_;
  std::size_t writing_ = 0;
  std::uint64_t looks_ = 0;
  bool reported_many_ = false;
};

}  // namespace hl
