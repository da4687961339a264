// The long run of the proxy's tick: random motion over soup, thin plates, slots, corners, rough terrain and apexes.
// Looks for what must never happen: a proxy that falls through, that is nearer to a surface than its radius (also where
// the iteration cap has ended the tick), or that is not finite. Ends with code 1 when it has seen any of it.
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "soak/clearance.h"
#include "soak/finger.h"
#include "soak/run_options.h"
#include "soak/world.h"

namespace hl::soak {

namespace {

constexpr std::uint64_t kTicksPerPiece = 10'000;
constexpr int kTicksPerLife = 1'000;  // then a new proxy begins elsewhere
constexpr int kTicksPerLook = 4;      // at the clearance; ticks at the cap are all looked at
// Where two edges of a needle or of a very thin plate are equally near to rounding, the plane of the wrong one leans by
// about the root of that rounding, eps extent / radius; in so many radii of way the proxy comes nearer by as much.
constexpr double kMaxWay = 20;

struct Options : RunOptions {
  double ticks = 1e7;
};

// What pieces have seen. `fault` is empty as long as nothing was wrong.
struct Seen {
  std::uint64_t pieces = 0, ticks = 0, touching = 0, capped = 0, out_of_work = 0, looks = 0;
  int most_iterations = 0;
  std::uint64_t most_capped = 0, most_capped_piece = 0;  // of the pieces
  double least_above = 1;                                // of clearance / radius - 1
  std::string fault;

  void add(const Seen& other) {
    pieces += other.pieces;
    ticks += other.ticks;
    touching += other.touching;
    capped += other.capped;
    out_of_work += other.out_of_work;
    looks += other.looks;
    most_iterations = std::max(most_iterations, other.most_iterations);
    if (other.most_capped > most_capped) {
      most_capped = other.most_capped;
      most_capped_piece = other.most_capped_piece;
    }
    least_above = std::min(least_above, other.least_above);
  }
};

// One piece: a world, and one proxy after another in it.
class Piece {
 public:
  Piece(std::uint64_t seed, std::uint64_t number)
      : number_(number),
        random_(generatorOf(seed, number)),
        world_(makeWorld(random_, number % kKinds.size())),
        clearance_(world_.primitives),
        finger_(random_, world_.rooms.half, world_.rooms.marks) {}

  Seen run() {
    seen_.pieces = 1;
    while (seen_.ticks < kTicksPerPiece && seen_.fault.empty()) live();
    seen_.most_capped = seen_.capped;
    seen_.most_capped_piece = number_;
    return seen_;
  }

 private:
  void live() {
    do {
      state_ = startProxy(*world_.snapshot, world_.settings, world_.toWorld(finger_.anywhere()));
    } while (!state_.free);
    room_ = world_.rooms.room(world_.toRooms(state_.position));
    for (int i = 0; i < kTicksPerLife && seen_.fault.empty(); ++i) tickOnce();
  }

  void tickOnce() {
    const Vec3 finger = world_.toWorld(finger_.next(world_.toRooms(state_.position)));
    const TickReport report = tick(state_, {*world_.snapshot, 0, recent_}, world_.settings, finger);
    ++seen_.ticks;
    seen_.touching += state_.touching ? 1 : 0;
    seen_.capped += report.capped() ? 1 : 0;
    seen_.out_of_work += report.ending == Ending::kOutOfWork ? 1 : 0;
    seen_.most_iterations = std::max(seen_.most_iterations, report.iterations);
    judge(report);
  }

  void judge(const TickReport& report) {
    const Vec3& p = state_.position;
    if (!p.allFinite() || !report.target.allFinite()) return blame("the proxy is not finite");
    if (world_.rooms.room(world_.toRooms(p)) != room_) return blame("the proxy fell through");
    if (!report.capped() && seen_.ticks % kTicksPerLook != 0) return;
    const double radius = world_.settings.radius;
    const double above = clearance_.at(p, 2 * radius) / radius - 1;
    ++seen_.looks;
    seen_.least_above = std::min(seen_.least_above, above);
    if (above < -rounding()) blame(fmt::format("the proxy is too near by {:.3g} radii", -above));
  }

  // Of the clearance, in radii.
  double rounding() const {
    constexpr double kEps = std::numeric_limits<double>::epsilon();
    return kMaxWay * std::sqrt(kEps * world_.snapshot->extent / world_.settings.radius);
  }

  void blame(const std::string& what) {
    const Vec3 p = world_.toRooms(state_.position);
    seen_.fault =
        fmt::format("tick {}: {}, at ({:.17g}, {:.17g}, {:.17g}) radii", seen_.ticks, what, p.x(), p.y(), p.z());
  }

  const std::uint64_t number_;
  test::Random random_;
  const World world_;
  const Clearance clearance_;
  Finger finger_;
  ProxyState state_;
  ManyRecentPrimitives recent_;
  int room_ = 0;
  Seen seen_;
};

Options parse(int argc, char** argv) {
  Options options;
  CLI::App app(
      "The long run of the proxy's tick: random motion over soup, thin plates, slots, corners, rough terrain and "
      "apexes.",
      "soak");
  app.add_option("--ticks", options.ticks, "How many, rounded up to pieces of 10000")->capture_default_str();
  addRunOptions(app, options);
  parseOrExit(app, argc, argv);
  return options;
}

using OfKind = std::array<Seen, kKinds.size()>;

void print(const OfKind& of_kind) {
  for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
    const Seen& seen = of_kind[kind];
    if (seen.pieces == 0) continue;
    const std::string most =
        seen.capped > 0 ? fmt::format(" ({} of them in piece {})", seen.most_capped, seen.most_capped_piece) : "";
    fmt::print(
        "{}: {} ticks in {} scenes, {:.0f} % in contact, {} at the cap{}, {} out of work, at most {} iterations; "
        "clearance >= radius (1 + {:.2g}) at {} looks\n",
        kKinds[kind], seen.ticks, seen.pieces,
        100.0 * static_cast<double>(seen.touching) / static_cast<double>(seen.ticks), seen.capped, most,
        seen.out_of_work, seen.most_iterations, seen.least_above, seen.looks);
  }
}

int run(const Options& options) {
  const Pieces pieces = piecesOf(options, options.ticks, kTicksPerPiece);
  OfKind of_kind;
  Faults faults;
  Progress progress(pieces.count());
  const auto collect = [&](std::uint64_t number, const Seen& seen) {
    const std::size_t kind = number % kKinds.size();
    of_kind[kind].add(seen);
    if (seen.fault.empty()) return;
    addFault(faults, number,
             fmt::format("FAULT in {}, {}; again: soak --seed {} --piece {}", kKinds[kind], seen.fault, options.seed,
                         number));
  };
  runPieces(
      pieces, progress, [&](std::uint64_t number) { return Piece(options.seed, number).run(); }, collect);
  print(of_kind);
  return report(faults);
}

}  // namespace

}  // namespace hl::soak

int main(int argc, char** argv) { return hl::soak::run(hl::soak::parse(argc, argv)); }
