// SurfaceRules: how the surfaces in contact change the proxy's step. Each rule only changes the next sub-goal (the
// paper's sections 4 and 5):
//
//   shading, bump   pass 1 solves with planes turned to their shading normals; pass 2 takes the result as its goal and
//                   solves with the true planes
//   friction        the sub-goal of pass 1 is pulled back toward the proxy
//   stiffness       the proxy does not change; the target moves from the proxy toward the finger
//
// For one sub-goal the two passes are repeated on the same contacts until they converge (settle()). A step that is not
// plain descent toward the finger, but shaded, may raise the energy of the spring, and is paid from the ledger's tank.
// World frame; an "offset" is relative to the proxy at the start of the sub-goal.
#pragma once

#include "base/vec.h"
#include "proxy/adhesion_load.h"
#include "proxy/contacts.h"
#include "proxy/friction.h"
#include "proxy/friction_on_way.h"
#include "proxy/patch.h"
#include "proxy/proposal.h"
#include "proxy/proxy_state.h"
#include "proxy/solver.h"
#include "proxy/surface.h"
#include "proxy/tick_report.h"
#include "proxy/tolerances.h"

namespace hl {

/// What friction knows at the start of a tick.
struct FrictionStart {
  bool slipping = false;                 ///< the proxy slides
  PreslidingSprings springs{};           ///< as the last tick left them
  double felt_N_m = 1000;                ///< the spring, feltSpring_N_m()
  const AdhesionLoads* loads = nullptr;  ///< or none
};

class SurfaceRules {
 public:
  SurfaceRules(const SceneAt& scene, const ProxySettings& settings, const Tolerances& tolerance,
               const FrictionStart& start)
      : scene_(scene),
        settings_(settings),
        tolerance_(tolerance),
        felt_N_m_(start.felt_N_m),
        loads_(start.loads),
        slipping_(start.slipping),
        springs_(start.springs),
        as_default_(settings.surfaces.keepsDefault()) {}

  /// Whether a surface in contact has shading, a bump map or friction.
  bool any(const ContactSet& set) const;

  /// Proposes the step toward the finger, at the offset `gap` from the proxy, under the rules of the surfaces in
  /// contact. After kMaxProposals proposals in one tick the step is zero: the rest is left to the next tick.
  void propose(const ContactSet& set, const Vec3& position, const Vec3& gap, Proposal& proposal);
  bool postpones() const { return proposals_ > convergence::kMaxProposals; }
  /// As propose(), without the limit.
  void settle(const ContactSet& set, const Vec3& position, const Vec3& gap, Proposal& proposal) const;

  /// To be called when the proxy has moved by `step`, a part of the proposed step. Updates the slip or the pre-sliding
  /// springs.
  void moved(const Proposal& proposal, const Vec3& step);
  /// The same after a step without the rules: surfaces without friction hold no springs.
  void movedPlainly(const ContactSet& set) {
    if (springs_.stiffness_N_m > 0 && !set.contacts.empty() && !any(set)) springs_ = {};
  }
  const PreslidingSprings& springs() const { return springs_; }
  /// J, what the whole proposed step takes out of them, >= 0.
  double released_J(const Proposal& proposal) const;
  bool hasSlipped() const { return slip_.length > 0; }

  /// The contact with its surface properties, for the tick report.
  ProxyContact describe(const ContactSet& set, const ActiveContact& active) const;
  /// Stiffness s of the surface at `place`, 0..1.
  double stiffnessAt(const SurfacePoint& place) const;
  bool stiffnessTextured(PrimitiveId primitive) const {
    return !plain(primitive) && surfaceOf(primitive).textured(Quantity::kStiffness);
  }

 private:
  /// State of one contact during the passes.
  struct Touched {
    Patch patch;
    Vec3 patch_offset;  ///< offset of the proxy for which the patch was made
    Vec2 moved;         ///< change of the weights since then (patch.h)
    ShadingNormal shading_normal;
    bool shaded;
    SurfaceFriction friction;  ///< used only if some contact has friction
  };
  using TouchedSet = FixedVector<Touched, kMaxContacts>;

  /// Whether the surface of the primitive has no rules, known without reading its material.
  bool plain(PrimitiveId primitive) const { return as_default_ && scene_.instance(primitive).plain; }
  Surface surfaceOf(PrimitiveId primitive) const { return {scene_, settings_.surfaces, primitive}; }
  Patch patchAt(const SurfacePoint& place) const { return {scene_, surfaceOf(place.primitive), place}; }
  TouchedSet touchedNow(const ContactSet& set) const;
  bool creased(const ContactSet& set, const Contact& contact, const Vec3& normal) const;
  void moveOn(const ContactSet& set, const Vec3& position, const Vec3& offset, TouchedSet& touched) const;
  SolverResult firstPass(const ContactSet& set, const TouchedSet& touched, const Vec3& gap, const Vec3& offset) const;
  Vec3 aboveTruePlanes(const ContactSet& set, const Vec3& goal) const;
  Vec3 secondPass(const ContactSet& set, const Vec3& goal) const;
  Vec3 toStep(const ContactSet& set, const Vec3& goal, const SolverResult& held, const Proposal& proposal) const;
  double mobilityOf_m_Ns(const Contact& contact) const;
  FrictionOnWay frictionOf(const ContactSet& set, const TouchedSet& touched, const SolverResult& held) const;
  double adhesionLoad_m(const Contact& contact) const;
  Vec3 resistedStep(FrictionOnWay resistance, const Vec3& way, const Vec3& offset, Proposal& proposal) const;
  void listActive(const TouchedSet& touched, const SolverResult& held, Proposal& proposal) const;
  bool slipsAtOnce(const TouchedSet& touched, const Proposal& proposal) const;
  bool staysOnFaces(const ContactSet& set, const TouchedSet& touched, const Vec3& step) const;
  Vec3 slip(FrictionOnWay& resistance, const SlipResistance& drag, const Vec3& way, const Slip& before,
            Proposal& proposal) const;

  const SceneAt& scene_;
  const ProxySettings& settings_;
  const Tolerances& tolerance_;
  const double felt_N_m_;
  const AdhesionLoads* const loads_;
  Slip slip_;
  bool slipping_;
  PreslidingSprings springs_;
  int proposals_ = 0;
  bool as_default_;  // no user setting changes the default material
};

}  // namespace hl
