// The cases of the golden hash: every built-in scene as it is, and one surface with each effect.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "proxy/proxy.h"
#include "scene/snapshot.h"

namespace hl::golden {

struct Case {
  std::string name;
  std::string scene;                  ///< a built-in one
  void (*change)(Model& model) = {};  ///< what its surface is to be; null: as the scene is
  bool moves = false;                 ///< the scene lies on a plate that turns and glides
};

const std::vector<Case>& cases();

/// How many primitives its scene has.
std::size_t elementsOf(const Case& which);

/// The hash over all bits that come out of `ticks` ticks along a path over the scene, at the end of each wanted number.
std::vector<std::uint64_t> hashesOf(const Case& which, HierarchyKind hierarchy, const std::vector<std::int64_t>& ticks);

}  // namespace hl::golden
