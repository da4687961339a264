// The long run of surfaces that make their triangles: fields, volumes and expressions that nothing can go around. Each
// has a judge that shares no code with the tick and its triangles: the samples around a place, or the sign of the
// function. Looks for a proxy that falls through or is not finite. Ends with code 1 when it has seen one.
#include <fmt/core.h>

#include <array>
#include <string>

#include "proxy/proxy.h"
#include "soak/closed_surfaces.h"
#include "soak/finger.h"
#include "soak/run_options.h"

namespace hl::soak {

namespace {

constexpr int kTicksPerPiece = 10'000, kTicksPerLife = 1'000;  // then a new proxy begins elsewhere

struct Seen {
  std::uint64_t ticks = 0, touching = 0, capped = 0, out_of_work = 0;
  std::string fault;

  void add(const Seen& other) {
    ticks += other.ticks;
    touching += other.touching;
    capped += other.capped;
    out_of_work += other.out_of_work;
  }
};

// One surface: one proxy after another on it.
class Piece {
 public:
  Piece(std::uint64_t seed, std::uint64_t number)
      : random_(generatorOf(seed, number)),
        surface_(drawClosed(random_, number % kClosedKinds.size())),
        finger_(random_, Vec3::Constant(surface_.half), surface_.marks) {}

  Seen run() {
    while (seen_.ticks < kTicksPerPiece && seen_.fault.empty()) live();
    return seen_;
  }

 private:
  Vec3 toWorld(const Vec3& radii) const {
    return surface_.confined(surface_.centre + surface_.settings.radius * radii);
  }
  Vec3 toRadii(const Vec3& place) const { return (place - surface_.centre) / surface_.settings.radius; }

  void live() {
    do {
      state_ = startProxy(*surface_.snapshot, surface_.settings, toWorld(finger_.anywhere()));
    } while (!state_.free || surface_.siteOf(state_.position) != Site::kOpen);
    for (int i = 0; i < kTicksPerLife && seen_.fault.empty(); ++i) tickOnce();
  }

  void tickOnce() {
    const Vec3 finger = toWorld(finger_.next(toRadii(state_.position)));
    const TickReport report = tick(state_, {*surface_.snapshot, 0, recent_}, surface_.settings, finger);
    ++seen_.ticks;
    seen_.touching += report.contacts.empty() ? 0 : 1;
    seen_.capped += report.capped() ? 1 : 0;
    seen_.out_of_work += report.ending == Ending::kOutOfWork ? 1 : 0;
    if (!state_.position.allFinite() || !report.target.allFinite()) blame("the proxy is not finite");
    if (surface_.siteOf(state_.position) == Site::kMatter) blame("the proxy fell through");
  }

  void blame(const std::string& what) {
    const Vec3& p = state_.position;
    seen_.fault = fmt::format("tick {}: {}, at ({:.17g}, {:.17g}, {:.17g}) m", seen_.ticks, what, p.x(), p.y(), p.z());
  }

  test::Random random_;
  const ClosedSurface surface_;
  Finger finger_;
  ProxyState state_;
  ManyRecentPrimitives recent_;
  Seen seen_;
};

struct Options : RunOptions {
  double ticks = 1e7;
};

Options parse(int argc, char** argv) {
  Options options;
  CLI::App app("The long run of surfaces that make their triangles.", "soak_surfaces");
  app.add_option("--ticks", options.ticks, "How many, rounded up to pieces of 10000")->capture_default_str();
  addRunOptions(app, options);
  parseOrExit(app, argc, argv);
  return options;
}

int run(const Options& options) {
  const Pieces pieces = piecesOf(options, options.ticks, kTicksPerPiece);
  std::array<Seen, kClosedKinds.size()> of_kind;
  Faults faults;
  Progress progress(pieces.count());
  runPieces(
      pieces, progress, [&](std::uint64_t number) { return Piece(options.seed, number).run(); },
      [&](std::uint64_t number, const Seen& seen) {
        of_kind[number % kClosedKinds.size()].add(seen);
        if (seen.fault.empty()) return;
        addFault(faults, number,
                 fmt::format("FAULT in {}, {}; again: soak_surfaces --seed {} --piece {}",
                             kClosedKinds[number % kClosedKinds.size()], seen.fault, options.seed, number));
      });
  for (std::size_t kind = 0; kind < kClosedKinds.size(); ++kind) {
    const Seen& seen = of_kind[kind];
    fmt::print("{}: {} ticks, {} in contact, {} at the cap, {} out of work\n", kClosedKinds[kind], seen.ticks,
               seen.touching, seen.capped, seen.out_of_work);
  }
  return report(faults);
}

}  // namespace

}  // namespace hl::soak

int main(int argc, char** argv) { return hl::soak::run(hl::soak::parse(argc, argv)); }
