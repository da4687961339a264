// Effects: what surfaces do to the proxy's way. Each is only a rule for where the next sub-goal is (the paper's
// sections 4 and 5):
//
//   shading, bump   pass 1 solves with the planes bent, pass 2 takes the result as the goal above the true planes
//   friction        the sub-goal of pass 1 is pulled back toward where the proxy is
//   stiffness       the proxy stays; the target moves from it toward the finger
// Frames: world; "offset" is relative to the proxy at the start of the sub-goal.
#pragma once

#include "base/vec.h"
#include "proxy/contacts.h"
#include "proxy/friction.h"
#include "proxy/patch.h"
#include "proxy/proxy.h"
#include "proxy/resistance.h"
#include "proxy/solver.h"
#include "proxy/surface.h"
#include "proxy/tolerances.h"

namespace hl {

/// Beyond so many contacts at once the passes are repeated by the tick itself, with the contacts found anew.
inline constexpr std::size_t kFewContacts = 8;

/// A contact that holds the proxy in a sub-goal.
struct Holding {
  std::size_t contact = 0;     ///< number in the contact set
  SurfacePlace place;          ///< where it is touched; its normal is the true one
  Vec3 normal = Vec3::Zero();  ///< as it feels
  double multiplier_m = 0;
};

/// Where a contact is touched. RT-safe.
inline SurfacePlace placeOf(const Contact& contact) {
  return {contact.primitive, contact.plane.normal, contact.weights};
}

/// The next step of the proxy and what it rests on.
struct SubGoal {
  Vec3 step = Vec3::Zero();
  FixedVector<Holding, 3> holding;
  double shading = 0, bump = 0;  ///< the largest bends of what holds, as BentNormal has them
  double viscous = 0;            ///< pull that viscosity uses for each metre of the step
  bool bent = false;             ///< the step is not plain descent: it may raise the spring's energy
  bool resisted = false;         ///< friction or viscosity act on it
  bool settles = false;          ///< the passes have found where the proxy rests on these planes: at the step's end
  bool stays = false;            ///< there every contact is on the same face as now
  bool creeps = false;           ///< static friction holds the proxy, on its pre-sliding springs
  double creep = 0;              ///< Drag::creep
  Vec3 held = Vec3::Zero();      ///< m, the pull that friction holds after the step
};

class Effects {
 public:
  /// `creep_m`: how far the proxy has crept from where it stuck.
  Effects(const SceneAt& scene, const ProxySettings& settings, const Tolerances& tolerance, bool slipping,
          const Vec3& creep_m)
      : scene_(scene),
        settings_(settings),
        tolerance_(tolerance),
        slipping_(slipping),
        creep_m_(creep_m),
        as_default_(settings.surfaces.keepsDefault()) {}

  /// Whether a surface in contact does anything beyond holding the proxy off.
  bool any(const ContactSet& set) const;

  /// The step toward the finger, `gap` away from the proxy, under the rules of the surfaces in contact.
  SubGoal subGoal(const ContactSet& set, const Vec3& position, const Vec3& gap) const;

  /// The proxy has moved by `step`, a part of the sub-goal's: a slip, or a creep.
  void moved(const SubGoal& sub_goal, const Vec3& step);
  const Vec3& creep_m() const { return creep_m_; }
  bool hasSlipped() const { return slip_.length > 0; }

  /// A contact as the report gives it.
  ProxyContact describe(const ContactSet& set, const Holding& holding) const;
  /// s of the surface there, 0..1.
  double stiffnessAt(const SurfacePlace& place) const;
  bool stiffnessTextured(PrimitiveId primitive) const {
    return !plain(primitive) && surfaceOf(primitive).textured(Quantity::kStiffness);
  }

 private:
  /// A contact as it is while the passes move the proxy on.
  struct Touched {
    Patch patch;
    Vec3 patch_offset;  ///< where the proxy was when the patch was made
    Vec2 moved;         ///< since then, as the patch counts it
    BentNormal bent;
    bool bends;
    Roughness roughness;  ///< read only when friction acts somewhere
  };
  using TouchedSet = FixedVector<Touched, kMaxContacts>;

  /// Whether its surface does nothing but hold off: then nobody needs to ask what it is made of.
  bool plain(PrimitiveId primitive) const { return as_default_ && scene_.instance(primitive).plain; }
  Surface surfaceOf(PrimitiveId primitive) const { return {scene_, settings_.surfaces, primitive}; }
  Patch patchAt(const SurfacePlace& place) const { return {scene_, surfaceOf(place.primitive), place}; }
  TouchedSet touchedNow(const ContactSet& set) const;
  bool creased(const ContactSet& set, const Contact& contact, const Vec3& normal) const;
  void moveOn(const ContactSet& set, const Vec3& position, const Vec3& offset, TouchedSet& touched) const;
  SolverResult firstPass(const ContactSet& set, const TouchedSet& touched, const Vec3& gap, const Vec3& offset) const;
  Vec3 aboveTruePlanes(const ContactSet& set, const Vec3& goal) const;
  Vec3 secondPass(const ContactSet& set, const Vec3& goal) const;
  Resistance resistanceOf(const TouchedSet& touched, const SolverResult& held) const;
  Vec3 resistedStep(Resistance resistance, const Vec3& way, double slipped_now, SubGoal& sub_goal) const;
  void tellHolding(const TouchedSet& touched, const SolverResult& held, SubGoal& sub_goal) const;
  bool slipsAtOnce(const TouchedSet& touched, const SubGoal& sub_goal) const;
  bool staysOnFaces(const ContactSet& set, const TouchedSet& touched, const Vec3& step) const;
  Vec3 slip(Resistance& resistance, const Drag& drag, const Vec3& way, const Slip& before, SubGoal& sub_goal) const;

  const SceneAt& scene_;
  const ProxySettings& settings_;
  const Tolerances& tolerance_;
  Slip slip_;
  bool slipping_;
  Vec3 creep_m_;
  bool as_default_;  // the user has set nothing that changes the default material
};

}  // namespace hl
