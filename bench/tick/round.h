// Round: one scene of one size, every motion and radius, all on the same mesh.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "tick/peers/peers.h"
#include "tick/suite.h"

namespace hl::bench {

/// One motion with one radius, and what HL took for it: what all else is compared with.
struct Case {
  FingerMotion motion;
  RadiusMode mode;
  double radius_m;
  Path path{};
  Timing plain{};  ///< of the ticks without surface effects
  std::vector<Probe> probes{};
  std::array<Answers, kOwnQuestions.size()> own{};  ///< of HL's queries to the probes

  /// HL's answers to a question or to one with the same answers; null where it is not asked.
  const Answers* ownTo(Question question) const;
};

class Round {
 public:
  /// What is given must outlive it. Throws hl::Error for a scene that cannot be touched.
  Round(const SuitePlan& plan, const SuiteOutput& output, const BenchScene& scene, std::size_t size);

  void run();

  const std::vector<Case>& cases() const { return cases_; }
  std::size_t primitives() const { return plain_->primitives; }

 private:
  void say(const std::string& what) const;
  Row rowOf(const Case& of, const std::string& who, const std::string& question) const;
  void putTicks(const Case& of, HierarchyKind hierarchy, Feel feel, const TickTimes& ticks, const Cost& cost) const;
  void measureTicks(FingerMotion motion, RadiusMode mode);
  // The case that effects and other hierarchies are measured on; null when it was not asked for.
  const Case* slide() const;
  void measureEffects() const;
  void measureHierarchies() const;
  void measurePeers();
  void measureOwnQueries(Case& of) const;
  void measurePeer(const PeerKind& kind) const;
  void measureAnswers(const Case& of, const std::string& who, Peer& peer, Question question, double build_ns) const;

  const SuitePlan& plan_;
  const SuiteOutput& output_;
  const BenchScene& scene_;
  std::shared_ptr<const Shape> shape_;
  std::shared_ptr<const Snapshot> plain_;
  Mesh mesh_;
  double mean_edge_m_ = 0;
  Cost cost_;
  std::vector<Case> cases_;
};

}  // namespace hl::bench
