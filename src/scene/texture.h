// Texture: an image of one quantity on a surface, sampled by GL's rules of wrapping and filtering.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/vec.h"

namespace hl {

enum class Wrap : std::uint8_t { kRepeat, kClamp };
enum class Filter : std::uint8_t { kNearest, kBilinear };

/// Texel (i, j) covers u in i/width .. (i+1)/width and v in j/height .. (j+1)/height; v = 0 is the lowest row.
struct Texture {
  std::string name;
  std::size_t width = 0, height = 0;  ///< each >= 1
  std::vector<float> texels;          ///< 0..1, row by row
  Wrap wrap = Wrap::kRepeat;
  Filter filter = Filter::kBilinear;

  /// The value at (u, v). RT-safe.
  double sample(const Vec2& uv) const;
  /// The slope of a bump map, per unit of u and v: half the difference of a texel's neighbours at its centre, bilinear
  /// between centres. Continuous, so that the normal turns without jumps; 0 for a pattern of two texels. RT-safe.
  Vec2 gradient(const Vec2& uv) const;

 private:
  std::size_t column(std::ptrdiff_t i) const;  ///< wrapped
  std::size_t row(std::ptrdiff_t j) const;     ///< wrapped; the index of its first texel
};

/// Throws hl::Error unless sizes and texels agree and every texel is in 0..1.
void checkTexture(const Texture& texture);

/// "checker", "lines", "sine" or "noise": one tile of `size` x `size` texels, to be repeated. lines: a fraction `duty`
/// (0..1) of the tile is 1, the rest 0; sine: 1/2 + 1/2 sin(2 pi u). Throws hl::Error for another name.
Texture makeTexture(const std::string& kind, std::size_t size, double duty = 0.5);

}  // namespace hl
