#include "scene/scene_limits.h"

#include "base/error.h"
#include "scene/placed_shape.h"

namespace hl {

std::size_t bytesInWorld() {
  constexpr std::size_t kSnapshots = 5;
  constexpr std::size_t kInSnapshot = sizeof(Instance) + sizeof(Box) + 64;  // with the leaf of the tree over instances
  constexpr std::size_t kInLayout = 768;    // poses and positions, and the message to the page
  constexpr std::size_t kWhileGrowing = 3;  // while a list is doubled, old and new exist
  return kWhileGrowing * sizeof(PlacedShape) + kSnapshots * kInSnapshot + kInLayout;
}

void ModelSizes::add(const Model& model, const std::string& where) { add(bytesToMake(model), where); }

void ModelSizes::add(std::size_t bytes, const std::string& where) {
  bytes_ += bytes;
  if (bytes_ <= most_bytes_) return;
  throw Error(where + "the shapes need more than the " + std::to_string(most_bytes_) +
              " bytes that one client may have");
}

}  // namespace hl
