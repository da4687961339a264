// SurfaceRules: what surfaces do to the proxy's way. Each is only a rule for where the next sub-goal is (the paper's
// sections 4 and 5):
//
//   shading, bump   pass 1 solves with shaded planes, pass 2 takes the result as the goal above the true planes
//   friction        the sub-goal of pass 1 is pulled back toward where the proxy is
//   stiffness       the proxy stays; the target moves from it toward the finger
// Frames: world; "offset" is relative to the proxy at the start of the sub-goal.
#pragma once

#include "base/vec.h"
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

class SurfaceRules {
 public:
  /// `presliding_m`: how far the proxy has crept from where it stuck.
  SurfaceRules(const SceneAt& scene, const ProxySettings& settings, const Tolerances& tolerance, bool slipping,
               const Vec3& presliding_m)
      : scene_(scene),
        settings_(settings),
        tolerance_(tolerance),
        slipping_(slipping),
        presliding_m_(presliding_m),
        as_default_(settings.surfaces.keepsDefault()) {}

  /// Whether a surface in contact does anything beyond holding the proxy off.
  bool any(const ContactSet& set) const;

  /// Proposes the step toward the finger, `gap` away from the proxy, under the rules of the surfaces in contact; none
  /// after so many that the rest is for the next tick.
  void propose(const ContactSet& set, const Vec3& position, const Vec3& gap, Proposal& proposal);
  bool postpones() const { return proposals_ > convergence::kMaxProposals; }
  /// The same, however many there have been.
  void settle(const ContactSet& set, const Vec3& position, const Vec3& gap, Proposal& proposal) const;

  /// The proxy has moved by `step`, a part of the proposal's: a slip, or a pre-sliding step.
  void moved(const Proposal& proposal, const Vec3& step);
  const Vec3& presliding_m() const { return presliding_m_; }
  bool hasSlipped() const { return slip_.length > 0; }

  /// A contact as the report gives it.
  ProxyContact describe(const ContactSet& set, const ActiveContact& active) const;
  /// s of the surface there, 0..1.
  double stiffnessAt(const SurfacePoint& place) const;
  bool stiffnessTextured(PrimitiveId primitive) const {
    return !plain(primitive) && surfaceOf(primitive).textured(Quantity::kStiffness);
  }

 private:
  /// A contact as it is while the passes move the proxy on.
  struct Touched {
    Patch patch;
    Vec3 patch_offset;  ///< where the proxy was when the patch was made
    Vec2 moved;         ///< since then, as the patch counts it
    ShadingNormal shading_normal;
    bool shaded;
    SurfaceFriction friction;  ///< read only when friction acts somewhere
  };
  using TouchedSet = FixedVector<Touched, kMaxContacts>;

  /// Whether its surface does nothing but hold off: then nobody needs to ask what it is made of.
  bool plain(PrimitiveId primitive) const { return as_default_ && scene_.instance(primitive).plain; }
  Surface surfaceOf(PrimitiveId primitive) const { return {scene_, settings_.surfaces, primitive}; }
  Patch patchAt(const SurfacePoint& place) const { return {scene_, surfaceOf(place.primitive), place}; }
  TouchedSet touchedNow(const ContactSet& set) const;
  bool creased(const ContactSet& set, const Contact& contact, const Vec3& normal) const;
  void moveOn(const ContactSet& set, const Vec3& position, const Vec3& offset, TouchedSet& touched) const;
  SolverResult firstPass(const ContactSet& set, const TouchedSet& touched, const Vec3& gap, const Vec3& offset) const;
  Vec3 aboveTruePlanes(const ContactSet& set, const Vec3& goal) const;
  Vec3 secondPass(const ContactSet& set, const Vec3& goal) const;
  FrictionOnWay frictionOf(const TouchedSet& touched, const SolverResult& held) const;
  Vec3 resistedStep(FrictionOnWay resistance, const Vec3& way, double slipped_now, Proposal& proposal) const;
  void listActive(const TouchedSet& touched, const SolverResult& held, Proposal& proposal) const;
  bool slipsAtOnce(const TouchedSet& touched, const Proposal& proposal) const;
  bool staysOnFaces(const ContactSet& set, const TouchedSet& touched, const Vec3& step) const;
  Vec3 slip(FrictionOnWay& resistance, const SlipResistance& drag, const Vec3& way, const Slip& before,
            Proposal& proposal) const;

  const SceneAt& scene_;
  const ProxySettings& settings_;
  const Tolerances& tolerance_;
  Slip slip_;
  bool slipping_;
  Vec3 presliding_m_;
  int proposals_ = 0;
  bool as_default_;  // the user has set nothing that changes the default material
};

}  // namespace hl
