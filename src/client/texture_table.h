// TextureTable: the texture objects of a context, with their images: changing a parameter sends the image again.
#pragma once

#include <hl/hl_types.h>

#include <map>
#include <set>
#include <string>

#include "client/free_numbers.h"
#include "client/table_changes.h"

namespace hl::client {

/// Most texels along a side; the whole image must also fit into one message of the server's.
inline constexpr HLsizei kMaxTextureSide = 8192;

struct Texture {
  HLenum wrap = HL_REPEAT;
  HLenum filter = HL_LINEAR;
  HLsizei width = 0, height = 0;  ///< 0: no image yet
  std::string texels;             ///< one byte each, the row of v = 0 first
  bool hasImage() const { return width != 0; }
};

class TextureTable {
 public:
  /// A number > 0 that is not in use.
  HLuint generate() { return numbers_.next(textures_, "textures"); }
  /// Makes the texture if there is none of this number; 0 is none.
  void bind(HLuint texture);
  bool contains(HLuint texture) const { return textures_.contains(texture); }
  /// Unknown textures are ignored.
  void remove(HLuint texture);
  bool hasImage(HLuint texture) const;
  /// There must be one.
  const Texture& image(HLuint texture) const { return textures_.at(texture); }
  /// There must be one. Its image, if it has one, goes with the next changes.
  Texture& change(HLuint texture);

  /// The images that were made or changed since the last time, and the textures that were removed. A removed texture
  /// stays with the server while there is something drawn with it there: `used`.
  struct Changes {
    std::map<HLuint, Texture> images;
    std::set<HLuint> removed;
    TableChanges<Texture> before;  ///< the table's entries, to be undone later
  };
  Changes takeChanges(const std::set<HLuint>& used);
  bool hasRemoved() const { return !removed_.empty(); }
  /// As it was after the last takeChanges().
  void undoChanges();
  /// Undoes changes that were taken, but for textures that have changed since. `removed`: those that they removed.
  void takeBack(TableChanges<Texture> taken, const std::set<HLuint>& removed);

 private:
  std::set<HLuint> changed_, removed_;
  std::map<HLuint, Texture> textures_;
  TableChanges<Texture> changes_;
  std::set<HLuint> removed_before_;
  FreeNumbers numbers_;
};

/// The texels of an image in the application's memory (HL_LUMINANCE; null: zeros). Throws Fault HL_INVALID_ENUM for
/// another type, HL_INVALID_VALUE for NaN.
std::string readTexels(HLsizei width, HLsizei height, HLenum type, const void* texels);

}  // namespace hl::client
