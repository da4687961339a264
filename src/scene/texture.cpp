#include "scene/texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/plain_math.h"
#include "base/splitmix64.h"

namespace hl {

namespace {

std::size_t wrapped(std::ptrdiff_t i, std::size_t size, Wrap wrap) {
  const auto n = static_cast<std::ptrdiff_t>(size);
  if (i >= 0 && i < n) return static_cast<std::size_t>(i);  // usual; a division costs more than all the rest
  if (wrap == Wrap::kClamp) return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, n - 1));
  const std::ptrdiff_t rest = i % n;
  return static_cast<std::size_t>(rest < 0 ? rest + n : rest);
}

// Coordinates far out of range have no fractional digits; they read the first texel.
double bounded(double x) { return std::abs(x) < 1e9 ? x : 0.0; }

// std::floor of a bounded x, without a function call.
std::ptrdiff_t floored(double x) {
  const auto toward_zero = static_cast<std::ptrdiff_t>(x);
  return toward_zero - (x < static_cast<double>(toward_zero) ? 1 : 0);
}

struct Cell {
  std::ptrdiff_t i, j;
  double s, t;  // 0..1 within the cell between four texel centres
};

Cell cellOf(const Texture& texture, const Vec2& uv) {
  const double x = bounded(uv.x() * static_cast<double>(texture.width)) - 0.5;
  const double y = bounded(uv.y() * static_cast<double>(texture.height)) - 0.5;
  const std::ptrdiff_t i = floored(x), j = floored(y);
  return {i, j, x - static_cast<double>(i), y - static_cast<double>(j)};
}

// A hash of the texel's position, mapped to 0..1.
float noiseAt(std::size_t i, std::size_t j) {
  const std::uint64_t x = splitmix64((static_cast<std::uint64_t>(i) << 32) + j);
  return static_cast<float>(static_cast<double>(x >> 40) / 16777215.0);
}

}  // namespace

double Texture::sample(const Vec2& uv) const {
  if (filter == Filter::kNearest) {
    const std::ptrdiff_t i = floored(bounded(uv.x() * static_cast<double>(width)));
    const std::ptrdiff_t j = floored(bounded(uv.y() * static_cast<double>(height)));
    return static_cast<double>(texels[row(j) + column(i)]);
  }
  const Cell c = cellOf(*this, uv);
  const std::array<std::size_t, 2> columns{column(c.i), column(c.i + 1)}, rows{row(c.j), row(c.j + 1)};
  const auto at = [&](std::size_t i, std::size_t j) { return static_cast<double>(texels[rows[j] + columns[i]]); };
  const double low = (1 - c.s) * at(0, 0) + c.s * at(1, 0);
  const double high = (1 - c.s) * at(0, 1) + c.s * at(1, 1);
  return (1 - c.t) * low + c.t * high;
}

Vec2 Texture::gradient(const Vec2& uv) const {
  const Cell c = cellOf(*this, uv);
  std::array<std::size_t, 4> columns{}, rows{};  // from one before the cell to one after it
  for (std::size_t k = 0; k < 4; ++k) {
    const auto off = static_cast<std::ptrdiff_t>(k) - 1;
    columns[k] = column(c.i + off);
    rows[k] = row(c.j + off);
  }
  const auto at = [&](std::size_t i, std::size_t j) { return static_cast<double>(texels[rows[j] + columns[i]]); };
  // Central differences over two texels, interpolated in the cell: along u of the interpolated rows, along v of the
  // interpolated columns.
  const auto along_u = [&](std::size_t i) { return (1 - c.t) * at(i, 1) + c.t * at(i, 2); };
  const auto along_v = [&](std::size_t j) { return (1 - c.s) * at(1, j) + c.s * at(2, j); };
  const double u = (1 - c.s) * (along_u(2) - along_u(0)) + c.s * (along_u(3) - along_u(1));
  const double v = (1 - c.t) * (along_v(2) - along_v(0)) + c.t * (along_v(3) - along_v(1));
  return {0.5 * static_cast<double>(width) * u, 0.5 * static_cast<double>(height) * v};
}

std::size_t Texture::column(std::ptrdiff_t i) const { return wrapped(i, width, wrap); }
std::size_t Texture::row(std::ptrdiff_t j) const { return width * wrapped(j, height, wrap); }

void checkTexture(const Texture& texture) {
  const std::string name = texture.name.empty() ? "a texture" : texture.name;
  if (texture.width == 0 || texture.height == 0 || texture.texels.size() != texture.width * texture.height)
    throw Error(name + ": its size and its number of texels do not agree");
  const auto in_range = [](float x) { return x >= 0 && x <= 1; };
  if (!std::all_of(texture.texels.begin(), texture.texels.end(), in_range))
    throw Error(name + ": texels must be between 0 and 1");
}

Texture makeTexture(const std::string& kind, std::size_t size, double duty) {
  Texture texture;
  texture.name = kind;
  texture.width = texture.height = size;
  const auto value = [&](std::size_t i, std::size_t j) -> float {
    const double u = (static_cast<double>(i) + 0.5) / static_cast<double>(size);
    if (kind == "checker") return (2 * i < size) == (2 * j < size) ? 1.0f : 0.0f;
    if (kind == "lines") return u < duty ? 1.0f : 0.0f;
    if (kind == "sine") return static_cast<float>(0.5 + 0.5 * plain::sin(2 * M_PI * u));
    if (kind == "noise") return noiseAt(i, j);
    throw Error("there is no procedural texture '" + kind + "'; there are checker, lines, sine and noise");
  };
  texture.texels.reserve(size * size);
  for (std::size_t j = 0; j < size; ++j) {
    for (std::size_t i = 0; i < size; ++i) texture.texels.push_back(value(i, j));
  }
  if (kind == "checker" || kind == "lines") texture.filter = Filter::kNearest;
  return texture;
}

}  // namespace hl
