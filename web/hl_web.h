/* HL in a browser, on one thread: a built-in scene or a mesh, the simulated device with its hand, and the servo with a
 * tick in each step, on a virtual clock. Metres, newtons, seconds; world frame. One session per module. */
#ifndef HL_WEB_H
#define HL_WEB_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { kHlWebMostTriangles = 1000000 };
enum { kHlWebContacts = 3, kHlWebQuantities = 9, kHlWebCauses = 5, kHlWebEndings = 11 };

/** Numbers only, so that a caller reads it as an array. */
typedef struct {
  double point[3], normal[3], multiplier_m, static_friction, stiffness;
} HlWebContact;

/** As Bodies of proto/hl.proto. count 0: there are none, and the rest is nothing. */
typedef struct {
  double count, awake, kinetic_J, gravity_J, spring_J, by_hand_J, contact_J, friction_J, joints_J, solver_J;
  double lost_s, returned;
} HlWebBodies;

typedef struct {
  double time_s, finger[3], proxy[3], force_N[3];
  double safety, fault; /**< numbers of SafetyState and FaultReason */
  double penetration_m; /**< at the hand */
  double slipping, exploring, firm, buttons, stiffness_N_m;
  double vibration_limit_N_m, vibration_alarms, vibration_dissipated_J;
  double tank_J, injected_J, dissipated_J, by_cause_J[kHlWebCauses]; /**< late hand-over: in the last cause */
  double endings[kHlWebEndings];                                     /**< from Ending::kReached on */
  double steps, contacts;
  HlWebContact contact[kHlWebContacts];
  double touched[kHlWebContacts]; /**< index of the object of each contact */
  double snap;                    /**< index of the place that holds the proxy; -1: none */
  double stylus[4];               /**< how it is turned: unit quaternion x y z w */
  HlWebBodies bodies;
} HlWebState;

/** What does not change while a scene is shown. */
typedef struct {
  double force_max_N, stiffness_N_m, stiffness_max_N_m, damping_Ns_m, rate_Hz;
  double bounds_min[3], bounds_max[3], radius, world_per_device, gravity[3];
  double objects, joints, snaps, fields, volumes; /**< numbers of them; places: snaps, then fields */
} HlWebScene;

typedef struct {
  double vertices, normals, triangles, segments; /**< numbers of them; normals: 0, or as vertices */
  double body;                                   /**< 0: it has no mass, 1: it is fixed, 2: it moves */
  double coloured;                               /**< 1: each vertex has a colour */
  double cloud_points;                           /**< of a cloud: its points; else 0 */
} HlWebObject;

/** A surface of a volume: where its values are `iso`. */
typedef struct {
  double object, iso, low, high; /**< low, high: range of the values */
  double below;                  /**< 1: the matter is where they are below iso */
} HlWebVolume;

/** As Joint of proto/hl.proto, in the world with the bodies at their start. */
typedef struct {
  double kind, object_a, object_b;                   /**< object_b -1: the world */
  double anchor[3], anchor_b[3], axis[3], low, high; /**< low, high: NaN: no limit */
} HlWebJoint;

/** A snap or a field, in the frame of its object. */
typedef struct {
  double object, points, kind;    /**< kind of a field; -1: a snap */
  double reach, strength;         /**< m, at which it captures or ends; of a snap its release, N */
  double normal[3], direction[3]; /**< 0: it is no plane; no constant force */
} HlWebPlace;

/** Why the last call that returned 0 failed, in one line. */
const char* hlWebError(void);
/** Starts a session on a built-in scene, as `hl touch` names it. 0: failed, and the session before goes on. */
int hlWebLoadBuiltin(const char* name);
/** The names of the built-in scenes, as help texts list them: "teapot[:N], walker, terrain:N, ...". */
const char* hlWebScenes(void);
/** A line for each row of base/quantities.def, in their order: field, name, unit, usual, otherwise and words, with tabs
 * between. */
const char* hlWebQuantities(void);
/** The same as hlWebLoadBuiltin on triangles, kHlWebMostTriangles at most: 3 numbers a vertex, 3 indices a triangle.
 * Vertices with the same bits are joined. Flat. */
int hlWebLoadMesh(const char* name, const double* positions, uint32_t vertices, const uint32_t* indices,
                  uint32_t triangles);

/** The next calls: only in a session. */
const HlWebScene* hlWebScene(void);
/** What the scene calls an object; empty: nothing. */
const char* hlWebName(int object);
/** What is drawn of an object that is no mesh: about `triangles`, or fewer. Before the next six calls, which are of
 * that; nothing for a mesh. */
void hlWebDraw(int object, uint32_t triangles);
const HlWebObject* hlWebObject(int object);
const double* hlWebPositions(int object);
const double* hlWebNormals(int object);
const uint32_t* hlWebTriangles(int object);
const uint32_t* hlWebSegments(int object);
const uint8_t* hlWebColours(int object); /**< red, green, blue of each vertex */
/** 12 numbers for each object, 3 x 4 row by row: where it starts, and where it is now. */
const double* hlWebStarts(void);
const double* hlWebPoses(void);
const HlWebJoint* hlWebJoint(int joint);
const HlWebPlace* hlWebPlace(int place);
const double* hlWebPoints(int place);
const HlWebVolume* hlWebVolume(int volume);
/** Another surface of a volume, at once. 0: failed, and the one before stays. */
int hlWebIso(int volume, double value, int below);
/** `steps` servo steps. */
void hlWebStep(int steps);
const HlWebState* hlWebState(void);
/** One line for a state in fault. */
const char* hlWebFault(void);
/** Where the hand wants to be; ends the exploration. */
void hlWebGoal(double x, double y, double z);
void hlWebRelease(void);
void hlWebPress(uint32_t buttons);
/** How the hand wants the stylus to be turned: a quaternion of any length but 0. */
void hlWebTurn(double x, double y, double z, double w);
void hlWebRearm(void);
void hlWebExplore(int on);
void hlWebFirm(int firm);
void hlWebStiffness(double stiffness_N_m);
void hlWebLedger(int mode);
/** Number `quantity` of base/quantities.def, for all surfaces; NaN: as in the scene. */
void hlWebSurface(int quantity, double value);
/** smooth: -1 as in the scene, 0 flat, 1 smooth. */
void hlWebLook(int smooth, int textures);

/** As `hl trace`: `rows` of t x y z in, and for each 14 numbers out: proxy, target, force, contacts, iterations,
 * injected J, and the two halves of the hash of the bodies, the higher first; 0: there are none. `surface`:
 * kHlWebQuantities numbers, NaN: as in the scene. 0: failed. */
int hlWebTrace(const char* builtin, double radius, const double* surface, int smooth, const double* path, int rows,
               double* out);

#ifdef __cplusplus
}
#endif

#endif
