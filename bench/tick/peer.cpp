#include "tick/peer.h"

#include <algorithm>
#include <cmath>

#include "base/clock.h"

namespace hl::bench {

namespace {

// Of the radius: how far around the proxy a tick looks for contacts, with room for the peers' single precision.
constexpr double kNear = 1.01;
// Of the radius: how far out of the surface the swept sphere starts.
constexpr double kLift = 1;
constexpr std::size_t kMin = 100;

}  // namespace

const char* nameOf(Question question) {
  constexpr std::array<const char*, 4> kNames{"near", "nearest", "finger", "impact"};
  return kNames[static_cast<std::size_t>(question)];
}

std::vector<Probe> probesOf(const Path& path, double radius_m) {
  std::vector<Probe> probes;
  for (std::size_t i = path.approach; i < path.fingers.size(); ++i) {
    const Vec3& proxy = path.proxies[i];
    const Vec3& next = path.fingers[std::min(i + 1, path.fingers.size() - 1)];
    // The surface pushes the proxy this way; nothing does where it is where the finger is.
    const Vec3 push = proxy - path.fingers[i];
    const Vec3 from = push.norm() > kAgreement_m ? Vec3(proxy + kLift * radius_m * push.normalized()) : proxy;
    probes.push_back({proxy, kNear * radius_m, path.fingers[i], from, next - from, radius_m});
  }
  return probes;
}

Answers timeAnswers(Peer& peer, Question question, std::span<const Probe> probes, double most_s) {
  Answers answers;
  answers.metres.reserve(probes.size());
  const auto timed = [&](int pass, const Probe& probe) {
    const std::int64_t start_ns = monotonicNow_ns();
    const double metres = peer.ask(question, probe);
    answers.times.add(pass, monotonicNow_ns() - start_ns);
    return metres;
  };
  const std::int64_t begin_ns = monotonicNow_ns();
  for (const Probe& probe : probes) {
    answers.metres.push_back(timed(0, probe));
    const auto since_ns = static_cast<double>(monotonicNow_ns() - begin_ns);
    if (answers.metres.size() >= kMin && since_ns > 1e9 * most_s / kPasses) break;
  }
  for (int pass = 1; pass < kPasses; ++pass) {
    for (const Probe& probe : probes.first(answers.metres.size())) timed(pass, probe);
  }
  return answers;
}

Agreement compare(std::span<const double> ours, std::span<const double> theirs) {
  Agreement agreement;
  for (std::size_t i = 0; i < std::min(ours.size(), theirs.size()); ++i) {
    if (!std::isfinite(ours[i])) continue;
    ++agreement.compared;
    if (!(std::abs(ours[i] - theirs[i]) <= kAgreement_m)) ++agreement.different;
  }
  return agreement;
}

}  // namespace hl::bench
