#include "builtin.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <string_view>

#include "base/error.h"
#include "clouds.h"
#include "depth_table.h"
#include "fields.h"
#include "phantom.h"
#include "rough.h"
#include "sdf.h"
#include "snap_board.h"
#include "soup.h"
#include "surfaces.h"
#include "teapot.h"
#include "walker.h"
#include "workshop.h"

namespace hl {

namespace {

constexpr std::size_t kMaxMember = 1'000'000'000;

constexpr std::string_view kSnaps = "snaps", kWorkshop = "workshop", kField = "field", kScan = "ct", kCloud = "points",
                           kDepth = "depth", kSdf = "sdf";
constexpr std::size_t kUsualField = 1'000'000, kMaxField = std::min(100'000'000'000ULL, 0ULL + SIZE_MAX),
                      kUsualScan = 161, kMaxScan = 1025, kUsualCloud = 100'000, kMaxCloud = 100'000'000;

struct Builtin {
  std::string_view name;
  std::size_t usual;  ///< default N; 0: the name takes no N
  Model (*make)(std::size_t n, std::size_t member);
  std::size_t most = 50'000'000;  ///< maximum N
  bool family = false;            ///< also takes the number of a member
};

// Makes a scene of a kind without members.
template <Model (*kMake)(std::size_t)>
Model alone(std::size_t n, std::size_t) {
  return kMake(n);
}

constexpr std::array<Builtin, 11> kBuiltins{{
    {"teapot", 1,
     [](std::size_t n, std::size_t) {
       return n == 1 ? makeTeapot() : makeTeapot(static_cast<int>(n), static_cast<int>(n));
     },
     500},
    {"walker", 0, [](std::size_t, std::size_t) { return makeWalker(); }},
    {"terrain", 100'000, alone<makeTerrain>},
    {"rough", 100'000, [](std::size_t n, std::size_t member) { return makeRough(n, member); }, 50'000'000, true},
    {"sphere", 20'000, alone<makeBumpySphere>},
    {"plane", 20'000, alone<makePlane>},
    {"pipe", 100'000, alone<makeHalfPipe>},
    {"pits", 20'000, alone<makePits>},
    {"soup", 20'000, alone<makeSoup>},
    {kSnaps, 0, [](std::size_t, std::size_t) { return asOneModel(makeSnapBoard()); }},
    {kWorkshop, 0, [](std::size_t, std::size_t) { return asOneModel(makeWorkshop()); }},
}};

const Builtin* find(std::string_view name) {
  for (const Builtin& builtin : kBuiltins) {
    if (builtin.name == name) return &builtin;
  }
  return nullptr;
}

// A whole number from 1 to `most`.
bool read(std::string_view digits, std::size_t most, std::size_t& number) {
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return error == std::errc() && end == digits.data() + digits.size() && number >= 1 && number <= most;
}

[[noreturn]] void refuseNumber(const std::string& spec, std::size_t most, const char* example) {
  throw Error("'" + spec + "': N must be a whole number from 1 to " + std::to_string(most) + ", as in " + example);
}

SceneModel makeField(const std::string& spec) {
  const std::string_view rest = std::string_view(spec).substr(kField.size());
  std::size_t n = kUsualField;
  if (!rest.empty()) {
    constexpr std::string_view kTerrain = ":terrain";
    const std::string_view number = rest.substr(std::min(rest.size(), kTerrain.size()));
    if (!rest.starts_with(kTerrain)) throw Error("'" + spec + "': the one generated field is field:terrain:N");
    if (!number.empty() && (number[0] != ':' || !read(number.substr(1), kMaxField, n)))
      refuseNumber(spec, kMaxField, "field:terrain:1000000");
  }
  SceneModel scene;
  scene.model.name = spec;
  scene.surfaces.push_back({spec, makeTerrainField(n)});
  return scene;
}

SceneModel makePoints(const std::string& spec) {
  constexpr std::string_view kSphere = "sphere", kTerrain = "terrain";
  const std::size_t first = spec.find(':'), second = first == std::string::npos ? first : spec.find(':', first + 1);
  const std::string_view name =
      first == std::string::npos ? kSphere : std::string_view(spec).substr(first + 1, second - first - 1);
  if (name != kSphere && name != kTerrain)
    throw Error("'" + spec + "': the generated clouds are points:sphere:N and points:terrain:N");
  std::size_t n = kUsualCloud;
  if (second != std::string::npos && !read(std::string_view(spec).substr(second + 1), kMaxCloud, n))
    refuseNumber(spec, kMaxCloud, "points:sphere:100000");
  SceneModel scene;
  scene.model.name = spec;
  scene.surfaces.push_back({spec, name == kSphere ? makeSphereCloud(n) : makeTerrainCloud(n)});
  return scene;
}

SceneModel makeScan(const std::string& spec) {
  constexpr std::string_view kPhantom = ":phantom";
  const std::string_view rest = std::string_view(spec).substr(kScan.size());
  const std::string_view number = rest.substr(std::min(rest.size(), kPhantom.size()));
  if (!rest.empty() && !rest.starts_with(kPhantom))
    throw Error("'" + spec + "': the one generated scan is ct:phantom:N");
  std::size_t n = kUsualScan;
  if (!number.empty() && (number[0] != ':' || !read(number.substr(1), kMaxScan, n) || n < 8))
    throw Error("'" + spec + "': N must be a whole number from 8 to " + std::to_string(kMaxScan) +
                ", as in ct:phantom:161");
  SceneModel scene = makePhantom(static_cast<std::uint32_t>(n));
  scene.model.name = spec;
  return scene;
}

SceneModel makeDepth(const std::string& spec) {
  if (spec != "depth" && spec != "depth:table")
    throw Error("'" + spec + "': the one generated depth image is depth:table");
  SceneModel scene;
  scene.model.name = "depth:table";
  scene.surfaces.push_back({scene.model.name, makeDepthTable()});
  scene.surfaces.back().material.smooth = true;
  return scene;
}

}  // namespace

bool isBuiltinSurface(const std::string& spec) {
  const std::string_view name = std::string_view(spec).substr(0, spec.find(':'));
  return name == kField || name == kScan || name == kCloud || name == kDepth || name == kSdf;
}

bool hasBuiltinBodies(const std::string& spec) { return spec == kSnaps || spec == kWorkshop; }

bool isBuiltinScene(const std::string& spec) {
  return isBuiltinSurface(spec) || find(std::string_view(spec).substr(0, spec.find(':'))) != nullptr;
}

Model makeBuiltinScene(const std::string& spec) {
  if (isBuiltinSurface(spec)) throw Error("'" + spec + "' is no mesh");
  const std::size_t colon = spec.find(':');
  const Builtin* builtin = find(std::string_view(spec).substr(0, colon));
  if (builtin == nullptr) throw Error("no built-in scene '" + spec + "'; there are " + kBuiltinScenes);
  const std::string_view numbers = colon == std::string::npos ? "" : std::string_view(spec).substr(colon + 1);
  const std::size_t second = builtin->family ? numbers.find(':') : std::string_view::npos;
  if (colon != std::string::npos && builtin->usual == 0)
    throw Error("'" + spec + "': there is one " + std::string(builtin->name) + ", which takes no number");
  std::size_t n = builtin->usual, member = 1;
  if (colon != std::string::npos && !read(numbers.substr(0, second), builtin->most, n))
    refuseNumber(spec, builtin->most, "terrain:100000");
  if (second != std::string_view::npos && !read(numbers.substr(second + 1), kMaxMember, member))
    throw Error("'" + spec + "': MEMBER must be a whole number from 1 to " + std::to_string(kMaxMember) +
                ", as in rough:100000:7");
  Model model = builtin->make(n, member);
  model.name = spec;
  return model;
}

SceneModel makeBuiltinWorld(const std::string& spec) {
  if (spec == kSnaps) return makeSnapBoard();
  if (spec == kWorkshop) return makeWorkshop();
  if (isBuiltinSurface(spec)) {
    if (spec.starts_with(kDepth)) return makeDepth(spec);
    if (spec.starts_with(kCloud)) return makePoints(spec);
    if (spec.starts_with(kSdf)) return makeSdf(spec);
    return spec.starts_with(kField) ? makeField(spec) : makeScan(spec);
  }
  return makeBuiltinScene(spec);
}

}  // namespace hl
