// Item content: what an object is like, between an instance of a scene and what servers of a shared world send of it.
// Where it is, and how fast, is not a part of it. What comes back is touched bit for bit as it was.
#pragma once

#include <share.pb.h>

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "base/memory_budget.h"
#include "record/recorded_scene.h"
#include "scene/snapshot.h"
#include "share/contents.h"

namespace hl {

/// A large part of an object, as it is sent.
struct NamedContent {
  ContentName name;
  Content bytes;
};

struct WrittenItem {
  std::shared_ptr<const proto::ShareContent> content;
  NamedContent shape, surfaces;
};

/// Writes objects of this server. Shape and surfaces are written once for all objects that have them, and kept as long
/// as those are there. One thread.
class ItemWriter {
 public:
  /// A mesh that deforms: as it is at the end. `jointed`: joints hold it. Throws hl::Error, in one line, for what is
  /// too large to be shared. It may take long where the shape is new.
  WrittenItem write(const Instance& instance, bool jointed);

 private:
  template <typename Part>
  struct Kept {
    std::weak_ptr<const Part> part;
    NamedContent content;
  };
  template <typename Part>
  using KeptMap = std::map<const Part*, Kept<Part>>;
  template <typename Part, typename Encode>
  static NamedContent contentOf(KeptMap<Part>& kept, const std::shared_ptr<const Part>& part, const Encode& encode);

  KeptMap<Shape> shapes_;
  KeptMap<Surfaces> surfaces_;
};

/// Reads objects of others. Shape and surfaces are made once for all objects that have them. One thread.
class ItemReader {
 public:
  /// What shapes and surfaces take is counted against `memory`, from before they are made until their last owner is
  /// gone.
  explicit ItemReader(MemoryBudget memory = {}) : memory_(std::move(memory)) {}
  /// An instance at the origin: key, session, object and motion are for the caller to set. What a body of its shape
  /// needs is made as well. Throws hl::Error for what makes no sense, or takes more memory than is left. It may take
  /// long where the shape is new.
  Instance read(const proto::ShareContent& content, const std::string& shape, const std::string& surfaces);

 private:
  bool isHere(const proto::ShareContent& content) const;
  Instance make(const proto::ShareContent& content, const std::string& shape, const std::string& surfaces);

  const MemoryBudget memory_;
  // By the SHA-256 of their contents, while somebody has them.
  std::map<std::string, std::weak_ptr<const Shape>> shapes_;
  std::map<std::string, std::weak_ptr<const Surfaces>> surfaces_;
};

}  // namespace hl
