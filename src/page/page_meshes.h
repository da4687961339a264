// PageMeshes: the meshes that pages are shown: one for each shape and look, however often it is placed, and its
// message, made once, on a thread of its own, and shared by all pages.
#pragma once

#include <cstdint>
#include <future>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/memory_budget.h"
#include "page/surface_images.h"
#include "scene/snapshot.h"

namespace hl {

/// A whole WebSocket message, shared by the pages it is sent to.
using PageMessage = std::shared_ptr<const std::string>;

/// Used by one thread.
class PageMeshes {
 public:
  /// Protobuf takes no more.
  static constexpr std::uint64_t kMaxMessage_bytes = (std::uint64_t{1} << 31) - 1024;

  /// Messages are counted against `memory`. A mesh for which there is none, or whose message would be larger than
  /// `most_bytes`, has a message without primitives.
  explicit PageMeshes(MemoryBudget memory = {}, std::uint64_t most_bytes = kMaxMessage_bytes)
      : memory_(std::move(memory)), most_bytes_(most_bytes) {}

  /// A surface that replaced another one is drawn coarsely at first, and in full when it has been the same for so long.
  static constexpr std::int64_t kStill_ns = 1'000'000'000;

  /// The number of the mesh of each instance; new ones start to be made ready.
  std::vector<std::uint32_t> numbersOf(const Snapshot& snapshot, std::int64_t now_ns);
  /// Whether numbersOf() would have another number for one of them: it is to be drawn in full now.
  bool refines(std::int64_t now_ns) const;
  /// Whether all the meshes have their messages; never waits for one.
  bool ready();
  /// Of one that is ready.
  const PageMessage& message(std::uint32_t number) const { return meshes_.at(number).message; }
  /// Why one of them is not shown, in one line; empty when all are.
  std::string lacking() const;
  /// Drops all others.
  void keep(const std::set<std::uint32_t>& numbers);

 private:
  /// What distinguishes meshes, by the shape's geometry; the mesh holds the textures.
  using Identity = std::pair<std::uint64_t, std::vector<const Texture*>>;
  struct Mesh {
    std::shared_ptr<const Shape> shape;  // until there is a message
    Look look;
    bool replaced = false, refined = false;
    std::int64_t since_ns = 0;
    PageMessage message{};
    std::string lacking{};
    bool dueAt(std::int64_t now_ns) const { return replaced && !refined && now_ns - since_ns >= kStill_ns; }
  };
  struct Made {
    std::uint32_t number = 0;
    PageMessage message;
    std::string lacking;
  };

  std::uint32_t numberOf(const Instance& instance, std::int64_t now_ns);
  Made make(std::uint32_t number, const Mesh& mesh) const;
  Made make(std::uint32_t number, const Mesh& mesh, std::size_t most_drawn) const;
  void takeMade();

  const MemoryBudget memory_;
  const std::uint64_t most_bytes_;
  std::map<Identity, std::uint32_t> numbers_;
  std::map<std::uint32_t, Mesh> meshes_;
  std::uint32_t last_number_ = 0;          // never falls: a number is never used again
  std::future<std::vector<Made>> making_;  // its destructor waits for the thread
};

}  // namespace hl
