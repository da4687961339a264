// The long run of the two queries: the first impact of a moving sphere, and the primitives within a distance. On small
// soups both hierarchies are compared with testing every primitive, on large ones with a grid of cells; each also with
// the primitives in another order. Every answer must be the judge's to the bit. The pieces take turns in using the
// instruction sets that the machine has. Ends with code 1 when an answer differs.
#include <fmt/core.h>
#include <hwy/highway.h>
#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "geometry/brute_force.h"
#include "geometry/queries.h"
#include "geometry/sphere_tree.h"
#include "geometry/wide_bvh.h"
#include "soak/grid_index.h"
#include "soak/run_options.h"

namespace hl::soak {

namespace {

constexpr std::uint64_t kQueriesPerPiece = 4'000;  // on one small soup, or on a part of the large one

struct Options : RunOptions {
  double queries = 1e6, large_queries = 1e5, triangles = 1e6;
};

struct Query {
  Vec3 from, motion;
  double radius, touching;
};

// Both hierarchies over the primitives in one order.
struct Ordered {
  std::vector<Primitive> primitives;
  SphereTree spheres;
  WideBvh boxes;
  explicit Ordered(std::vector<Primitive> given)
      : primitives(std::move(given)), spheres(SphereTree::build(primitives)), boxes(WideBvh::build(primitives)) {}
};

using Near = std::vector<std::pair<std::uint32_t, ClosestPoint>>;  // by source

bool sameBits(const ClosestPoint& a, const ClosestPoint& b) {
  return a.point == b.point && a.normal == b.normal && a.distance == b.distance && a.feature == b.feature &&
         a.weights == b.weights;
}

bool sameBits(const Impact& a, const Impact& b) {
  return a.t == b.t && a.feature == b.feature && a.normal == b.normal && a.weights == b.weights;
}

// What an index answers, in terms that do not depend on the order of the primitives.
struct Answer {
  bool hit = false;
  FirstImpact first;
  std::uint32_t first_source = 0;
  Near near;

  Answer(const SpatialIndex& index, const std::vector<Primitive>& primitives, const Query& query) {
    hit = firstImpact(index, primitives, query.from, query.motion, query.radius, query.touching, first);
    if (hit) first_source = primitives[first.primitive].source;
    primitivesWithin(index, primitives, query.from, query.radius, [&](std::uint32_t i, const ClosestPoint& nearest) {
      near.emplace_back(primitives[i].source, nearest);
    });
    const auto before = [](const auto& a, const auto& b) { return a.first < b.first; };
    const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
    std::sort(near.begin(), near.end(), before);
    near.erase(std::unique(near.begin(), near.end(), same), near.end());
  }

  bool operator==(const Answer& other) const {
    const auto same = [](const auto& a, const auto& b) { return a.first == b.first && sameBits(a.second, b.second); };
    if (hit != other.hit || !std::equal(near.begin(), near.end(), other.near.begin(), other.near.end(), same))
      return false;
    return !hit || (first_source == other.first_source && sameBits(first.impact, other.first.impact));
  }
};

// A scene and its judge.
struct Asked {
  Ordered given, shuffled;
  std::unique_ptr<const SpatialIndex> judge;

  bool agree(const Query& query) const {
    const Answer judged(*judge, given.primitives, query);
    for (const Ordered* order : {&given, &shuffled}) {
      if (!(Answer(order->spheres, order->primitives, query) == judged)) return false;
      if (!(Answer(order->boxes, order->primitives, query) == judged)) return false;
    }
    return true;
  }
};

std::vector<Primitive> shuffledCopy(test::Random& random, std::vector<Primitive> primitives) {
  std::shuffle(primitives.begin(), primitives.end(), random.engine());
  return primitives;
}

Query randomQuery(test::Random& random, const Vec3& near, double size) {
  const Vec3 from = near + size * std::pow(10.0, random.uniform(-3, 0.5)) * random.direction();
  const Vec3 motion = size * std::pow(10.0, random.uniform(-2, 1)) * random.direction();
  const double radius = size * std::pow(10.0, random.uniform(-2, 0.3));
  return {from, motion, radius, random.below(3) == 0 ? 0.3 * radius : 0.0};
}

const Vec3& someVertex(test::Random& random, const std::vector<Primitive>& primitives) {
  return primitives[static_cast<std::size_t>(random.below(static_cast<int>(primitives.size())))].vertex[0];
}

// What a piece has seen: how many questions it asked, and the first that got a wrong answer.
struct Seen {
  std::uint64_t queries = 0;
  std::string fault;
};

Seen ask(test::Random& random, const Asked& asked, double size) {
  Seen seen;
  while (seen.queries < kQueriesPerPiece && seen.fault.empty()) {
    const Query query = randomQuery(random, someVertex(random, asked.given.primitives), size);
    seen.queries += 2;
    if (!asked.agree(query)) seen.fault = fmt::format("query {}", seen.queries);
  }
  return seen;
}

// A soup of up to two hundred primitives at some scale, or a small sheet.
Seen askSmall(std::uint64_t seed, std::uint64_t piece) {
  test::Random random = generatorOf(seed, piece);
  const bool sheet = random.below(8) == 0;
  const double scale = sheet || random.below(2) == 0 ? 1 : std::pow(10.0, random.uniform(-6, 6));
  const auto count = static_cast<std::size_t>(1 + random.below(200));
  std::vector<Primitive> scene =
      sheet ? test::terrain(1 + random.below(10)) : test::soup(random, count, scale, 0.2 * scale);
  std::vector<Primitive> mixed = shuffledCopy(random, scene);
  auto judge = std::make_unique<BruteForceIndex>(scene.size());
  return ask(random, {Ordered(std::move(scene)), Ordered(std::move(mixed)), std::move(judge)}, 0.2 * scale);
}

// Half of them a hilly sheet, half of them a soup in a cube around it.
constexpr double kLargeCube = 1;

double sizeOfLarge(double triangles) { return kLargeCube / std::cbrt(triangles); }

Asked makeLarge(std::uint64_t seed, double triangles) {
  test::Random random(seed);
  std::vector<Primitive> scene = test::terrain(static_cast<int>(std::sqrt(0.25 * triangles)));
  while (static_cast<double>(scene.size()) < triangles) {
    const auto source = static_cast<std::uint32_t>(scene.size());
    scene.push_back(test::randomPrimitive(random, kLargeCube, sizeOfLarge(triangles), source));
  }
  std::vector<Primitive> mixed = shuffledCopy(random, scene);
  auto grid = std::make_unique<GridIndex>(scene, 2 * sizeOfLarge(triangles));
  return {Ordered(std::move(scene)), Ordered(std::move(mixed)), std::move(grid)};
}

Options parse(int argc, char** argv) {
  Options options;
  CLI::App app("The long run of the queries: every answer of the hierarchies against plain judges.", "soak_queries");
  app.add_option("--queries", options.queries, "How many on small soups")->capture_default_str();
  app.add_option("--large-queries", options.large_queries, "How many on the large scene")->capture_default_str();
  app.add_option("--triangles", options.triangles, "Of the large scene")->capture_default_str();
  addRunOptions(app, options);
  parseOrExit(app, argc, argv);
  return options;
}

std::vector<std::int64_t> instructionSets() {
  hwy::SetSupportedTargetsForTest(0);  // all again
  std::vector<std::int64_t> sets;
  for (std::int64_t rest = hwy::SupportedTargets() | HWY_SCALAR; rest != 0; rest &= rest - 1)
    sets.push_back(rest & -rest);
  return sets;
}

// The pieces of one run: first those of small soups, then those of the large scene.
class Run {
 public:
  explicit Run(const Options& options)
      : options_(options), small_(piecesOf(options.queries)), end_(small_ + piecesOf(options.large_queries)) {
    if (options.piece >= 0) {
      first_ = static_cast<std::uint64_t>(options.piece);
      end_ = first_ + 1;
    }
    if (end_ > small_) large_ = std::make_unique<const Asked>(makeLarge(options.seed, options.triangles));
  }

  /// The instruction set is the whole program's, so the pieces of one set run together: piece k has set k modulo their
  /// number.
  void run() {
    const auto sets = instructionSets();
    Progress progress(end_ - first_);
    for (std::size_t i = 0; i < sets.size(); ++i) {
      hwy::SetSupportedTargetsForTest(sets[i]);
      hwy::GetChosenTarget().Update(sets[i]);
      const std::uint64_t begin = first_ + (i + sets.size() - first_ % sets.size()) % sets.size();
      const auto collect = [&](std::uint64_t piece, const Seen& seen) {
        asked_[piece < small_ ? 0 : 1] += seen.queries;
        if (!seen.fault.empty()) faults_[piece] = fmt::format("{}, {}", seen.fault, hwy::TargetName(sets[i]));
      };
      runPieces(
          {begin, end_, sets.size(), options_.threads}, progress, [&](std::uint64_t piece) { return runPiece(piece); },
          collect);
    }
  }

  /// Prints what was seen; the exit code.
  int report() const {
    fmt::print("{} queries on small soups, {} among {:.0f} triangles, {} instruction sets\n", asked_[0], asked_[1],
               options_.triangles, instructionSets().size());
    for (const auto& [piece, fault] : faults_) {
      fmt::print(
          "FAULT in {}; again: soak_queries --seed {} --queries {} --large-queries {} --triangles {} --piece {}\n",
          fault, options_.seed, options_.queries, options_.large_queries, options_.triangles, piece);
    }
    fmt::print("{} faults\n", faults_.size());
    return faults_.empty() ? 0 : 1;
  }

 private:
  static std::uint64_t piecesOf(double queries) {
    return static_cast<std::uint64_t>(std::ceil(queries / static_cast<double>(kQueriesPerPiece)));
  }

  Seen runPiece(std::uint64_t piece) const {
    if (piece < small_) return askSmall(options_.seed, piece);
    test::Random random = generatorOf(options_.seed, piece);
    return ask(random, *large_, sizeOfLarge(options_.triangles));
  }

  const Options options_;
  std::uint64_t small_, first_ = 0, end_;
  std::unique_ptr<const Asked> large_;
  std::array<std::uint64_t, 2> asked_{};
  std::map<std::uint64_t, std::string> faults_;
};

}  // namespace

}  // namespace hl::soak

int main(int argc, char** argv) {
  hl::soak::Run run(hl::soak::parse(argc, argv));
  run.run();
  return run.report();
}
