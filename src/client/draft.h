// Draft: a frame before it becomes messages. A draft that has to wait takes in those that are flushed after it.
#pragma once

#include <hl/hl_types.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "client/frame_changes.h"
#include "client/item_list.h"
#include "client/texture_table.h"

namespace hl::client {

/// Vertices of one item of an object, from number `first` on, and where they are now.
struct VertexUpdate {
  HLuint object = 0;
  std::uint32_t item = 0, first = 0;
  Vertices vertices;  ///< without texture coordinates; without normals: those stay
};

/// An object, and the number of one of its items.
using ObjectItem = std::pair<HLuint, std::uint32_t>;

/// How an object yields, and for which force on the hand its mesh was computed. World axes.
inline constexpr double kMaxSentCompliance = 1e9;  // m/N and N: what a server takes
struct ObjectCompliance {
  double normal_m_N = 0, tangential_m_N = 0;
  std::array<double, 3> computed_for_N{};
};

struct Draft {
  std::optional<ItemList> world;                   ///< absent: the calls stay as they are
  std::map<HLuint, ItemList> objects;              ///< new or overwritten
  std::set<HLuint> deleted_objects;                ///< in none of `objects`
  std::vector<VertexUpdate> moved;                 ///< of objects that are defined, after all definitions
  std::map<ObjectItem, double> isos;               ///< values of surfaces of volumes, as moved
  std::map<HLuint, ObjectCompliance> compliances;  ///< of objects that are defined
  std::map<HLuint, Texture> textures;              ///< new or overwritten; all with images
  std::set<HLuint> deleted_textures;               ///< in none of `textures`

  std::optional<std::array<double, 3>> gravity_m_s2;  ///< absent: unchanged

  FrameChanges changes;  ///< what all this has changed in the context's tables

  bool isEmpty() const;
  bool hasBodies() const;
  /// Forgets an earlier update that it covers, so that a draft that waits long does not grow.
  void move(VertexUpdate update);
  /// The object is another one now, or none.
  void forgetUpdates(HLuint object);
  /// The object is none now.
  void forgetCompliance(HLuint object) { compliances.erase(object); }
  /// As if both frames were shown at the same moment.
  void merge(Draft&& later);
};

}  // namespace hl::client
