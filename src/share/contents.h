// Contents: the large parts of objects (meshes, samples, textures) by their SHA-256: those that this server has, and
// those that it fetches from others. Whoever asks says how much it takes at once, so a slow line is never flooded; what
// comes is checked against its name, so it may come from any server that has it.
#pragma once

#include <share.pb.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "share/share_link.h"

namespace hl {

/// SHA-256, 32 bytes, and its size.
struct ContentName {
  std::string sha256;
  std::uint64_t bytes = 0;
  bool operator==(const ContentName&) const = default;
};
using Content = std::shared_ptr<const std::string>;

ContentName nameOf(std::string_view content);

/// One thread.
class Contents {
 public:
  static constexpr std::size_t kPart_bytes = 16'384;
  /// Parts that are asked for and not here yet: a megabyte for each round trip.
  static constexpr std::uint64_t kWindow = 64;
  /// Without a part for so long it is asked for again, of the next server that may have it.
  static constexpr std::int64_t kPatience_ns = 1'000'000'000;
  /// Of all contents together. About fifteen million triangles.
  static constexpr std::uint64_t kMax_bytes = std::uint64_t{1} << 30;

  /// Sends to the inbox of a server; false: not now.
  using Send = std::function<bool(ServerId to, const proto::ShareMessage& message)>;

  Contents(ServerId self, Send send) : self_(self), send_(std::move(send)) {}

  /// The one that is kept: that which was here before, if there was one.
  Content keep(const ContentName& name, const Content& content) {
    return here_.try_emplace(name.sha256, content).first->second;
  }
  /// Null: it is not here.
  Content find(const ContentName& name) const;
  /// From now on it is fetched, from the first of these servers that has it. False: there is no room for it.
  bool want(const ContentName& name, const std::vector<ServerId>& from, std::int64_t now_ns);
  /// All but those of these names go, and are not fetched any more. What was kept and is held elsewhere too stays: an
  /// object that is written is published a moment later.
  void keepOnly(const std::function<bool(const std::string& sha256)>& wanted);

  void hear(const proto::ShareRequest& request);
  void hear(const proto::SharePart& part, std::int64_t now_ns);
  /// Answers and asks; often.
  void step(std::int64_t now_ns);

  std::uint64_t fetched_bytes() const { return fetched_bytes_; }  ///< since the start
  std::size_t fetching() const { return fetches_.size(); }

 private:
  struct Fetch {
    std::uint64_t bytes = 0;
    std::vector<ServerId> from;
    std::size_t source = 0;  // which of them is asked
    std::string so_far;
    std::uint64_t asked = 0;  // parts
    std::int64_t heard_ns = 0;
    std::uint64_t parts() const { return (bytes + kPart_bytes - 1) / kPart_bytes; }
  };
  struct Answer {
    ServerId to;
    std::string sha256;
    std::uint64_t next, end;  // parts
  };
  bool answerOne(Answer& answer);
  void ask(const std::string& sha256, Fetch& fetch, std::int64_t now_ns);
  std::uint64_t used_bytes() const;

  const ServerId self_;
  const Send send_;
  std::map<std::string, Content> here_;
  std::map<std::string, Fetch> fetches_;
  std::vector<Answer> answers_;
  std::uint64_t fetched_bytes_ = 0;
};

}  // namespace hl
