// Peer: what answers questions of a tick on a mesh: HL's own queries, and those of other libraries.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/vec.h"
#include "tick/finger_motion.h"
#include "tick/mesh.h"
#include "tick/timing.h"

namespace hl::bench {

/// What is asked at one place of the proxy.
struct Probe {
  Vec3 centre;      ///< of the proxy, whose surroundings are asked for
  double near_m;    ///< how far they reach
  Vec3 finger;      ///< what the tick that led there began with
  Vec3 from;        ///< where the sphere starts whose first impact is asked for: clear of what holds the proxy
  Vec3 motion;      ///< of that sphere, to the next place of the finger
  double radius_m;  ///< of it
};

enum class Question : std::uint8_t {
  kNear,     ///< the distance of the nearest primitive within near_m
  kNearest,  ///< the same at any distance: of who does not know, as a tick does, how near it is
  kFinger,  ///< the same of the finger: what a method without a proxy asks, which knows no more than a tick begins with
  kImpact,  ///< how far the sphere comes
};
/// "near", "nearest", "finger" or "impact".
const char* nameOf(Question question);
/// Those of HL itself: where something is within near_m, its answer to the first is that to the second.
inline constexpr std::array kOwnQuestions{Question::kNear, Question::kImpact};

class Peer {
 public:
  virtual ~Peer() = default;
  /// Those that it has an answer to.
  virtual std::span<const Question> questions() const = 0;
  /// Metres; infinite when nothing is near, or nothing is hit.
  virtual double ask(Question question, const Probe& probe) = 0;
};

/// One for each tick of the path after its approach.
std::vector<Probe> probesOf(const Path& path, double radius_m);

struct Answers {
  PassTimes times;
  std::vector<double> metres;  ///< one for each probe that was asked
};

/// Asks one probe after the other, in kPasses passes; a pass stops early after its part of `most_s` seconds, but not
/// before the first hundred.
Answers timeAnswers(Peer& peer, Question question, std::span<const Probe> probes, double most_s);

struct Agreement {
  std::size_t compared = 0;   ///< answers where ours found something
  std::size_t different = 0;  ///< of these, by more than kAgreement_m
};
inline constexpr double kAgreement_m = 1e-5;

/// Of a peer's answers with ours to the same question and probes.
Agreement compare(std::span<const double> ours, std::span<const double> theirs);

}  // namespace hl::bench
