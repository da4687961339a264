// Attributes: the part of GL's state that decides what the next primitive feels like. A quantity that was never set
// stays "not set", so that a definition can leave it to its caller.
#pragma once

#include <hl/hl_types.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "base/quantities.h"
#include "base/vec.h"

namespace hl::client {

/// Of each number of a surface, in the order of the table.
inline constexpr std::array<HLenum, kNumbers> kQuantityEnums{
#define HL_QUANTITY(quantity, field, NAME, ...) HL_##NAME,
#include "base/quantities.def"
#undef HL_QUANTITY
};
/// Its place in the table; none: it is no number of a surface.
std::optional<std::size_t> numberOf(HLenum quantity);

/// One for each quantity that a texture can modulate: more could not be felt apart.
inline constexpr std::size_t kTextureUnits = 5;
inline constexpr std::size_t kAttribDepth = 16;  ///< as GL demands
inline constexpr std::size_t kNameDepth = 64;    ///< as GL demands

struct Surface {
  std::array<std::optional<double>, kNumbers> quantities;  ///< in the order of the table
  std::optional<HLenum> shade;                             ///< HL_FLAT or HL_SMOOTH
  bool operator==(const Surface&) const = default;
};

/// The quantity is low + (high - low) * texel.
struct TextureUse {
  HLuint texture = 0;
  HLenum quantity = HL_STIFFNESS;
  double low = 0, high = 1;
  bool operator==(const TextureUse&) const = default;
};

struct TextureUnits {
  std::array<TextureUse, kTextureUnits> uses;
  std::array<bool, kTextureUnits> enabled{};
  bool decided = false;  ///< hlEnable or hlDisable was called: with no unit in use a caller's do not count
  std::size_t active = 0;
};

/// What the next vertex gets besides its position.
struct VertexExtras {
  std::array<double, 3> normal{};    ///< 0 0 0: none
  std::array<double, 2> texcoord{};  ///< before the texture matrix
  bool has_normal = false;           ///< it is not 0 0 0
  bool has_texcoord = false;         ///< hlTexCoord was called

  void setNormal(const std::array<double, 3>& to) {
    normal = to;
    has_normal = to != std::array<double, 3>{};
  }
  void setTexcoord(const std::array<double, 2>& to) {
    texcoord = to;
    has_texcoord = true;
  }
};

struct Attributes {
  Surface surface;
  TextureUnits textures;
  VertexExtras vertex;
  HLuint name = 0;  ///< 0: not set
  HLenum matrix_mode = HL_MODELVIEW;
};

/// What a primitive or a call takes from the attributes.
struct Look {
  Surface surface;
  std::vector<TextureUse> textures;  ///< at most one for each quantity
  bool untextured = false;           ///< no textures, not even the caller's
  HLuint name = 0;                   ///< 0: not set
  bool operator==(const Look&) const = default;
};
Look lookOf(const Attributes& attributes);

/// Whether lookOf(attributes) has textures.
bool hasTextures(const Attributes& attributes);

/// The range of a quantity of hlMaterial or hlTexEnv: HL_HEIGHT, or one of kQuantityEnums. Throws Fault
/// HL_INVALID_VALUE.
void requireInRange(HLenum quantity, double value);

/// Attributes with GL's attribute and name stacks.
class AttributeStack {
 public:
  Attributes now;

  void push(HLbitfield mask);
  void pop();
  std::size_t depth() const { return saved_.size(); }
  void pushName(HLuint name);
  void popName();
  std::size_t nameDepth() const { return names_.size(); }

 private:
  struct Saved {
    HLbitfield mask;
    Attributes attributes;
  };
  std::vector<Saved> saved_;
  std::vector<HLuint> names_;
};

}  // namespace hl::client
