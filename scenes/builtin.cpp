#include "builtin.h"

#include <array>
#include <charconv>
#include <string_view>

#include "base/error.h"
#include "soup.h"
#include "surfaces.h"
#include "teapot.h"
#include "walker.h"

namespace hl {

namespace {

constexpr std::size_t kMostTriangles = 50'000'000;

struct Builtin {
  std::string_view name;
  std::size_t usual;  ///< N when none is given; 0: the name takes no N
  Model (*make)(std::size_t n);
};

constexpr std::array<Builtin, 8> kBuiltins{{
    {"teapot", 1,
     [](std::size_t n) { return n == 1 ? makeTeapot() : makeTeapot(static_cast<int>(n), static_cast<int>(n)); }},
    {"walker", 0, [](std::size_t) { return makeWalker(); }},
    {"terrain", 100'000, makeTerrain},
    {"sphere", 20'000, makeBumpySphere},
    {"plane", 20'000, makePlane},
    {"pipe", 100'000, makeHalfPipe},
    {"pits", 20'000, makePits},
    {"soup", 20'000, makeSoup},
}};

const Builtin* find(std::string_view name) {
  for (const Builtin& builtin : kBuiltins) {
    if (builtin.name == name) return &builtin;
  }
  return nullptr;
}

}  // namespace

bool isBuiltinScene(const std::string& spec) {
  return find(std::string_view(spec).substr(0, spec.find(':'))) != nullptr;
}

Model makeBuiltinScene(const std::string& spec) {
  const std::size_t colon = spec.find(':');
  const Builtin* builtin = find(std::string_view(spec).substr(0, colon));
  if (builtin == nullptr) {
    throw Error("no built-in scene '" + spec +
                "'; there are teapot[:N], walker, terrain:N, sphere:N, plane:N, pipe:N, pits:N, soup:N");
  }
  std::size_t n = builtin->usual;
  if (colon != std::string::npos && builtin->usual == 0)
    throw Error("'" + spec + "': there is one " + std::string(builtin->name) + ", which takes no number");
  if (colon != std::string::npos) {
    const std::string_view digits = std::string_view(spec).substr(colon + 1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), n);
    const std::size_t most = builtin->name == "teapot" ? 500 : kMostTriangles;
    if (error != std::errc() || end != digits.data() + digits.size() || n < 1 || n > most) {
      throw Error("'" + spec + "': N must be a whole number from 1 to " + std::to_string(most) +
                  ", as in terrain:100000");
    }
  }
  Model model = builtin->make(n);
  model.name = spec;
  return model;
}

}  // namespace hl
