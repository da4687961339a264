/* Types and constants of the HL calls; included by hl.h, which says how they are used.
 * Names that GL also has mean the same and have GL's numbers; HL's own count from 0x48001. All units are SI. */
#ifndef HL_HL_TYPES_H
#define HL_HL_TYPES_H

#ifdef __cplusplus
extern "C" {
#endif

typedef unsigned int HLenum;     /**< one of the constants below */
typedef unsigned char HLboolean; /**< HL_FALSE or HL_TRUE */
typedef unsigned int HLbitfield; /**< constants ending in _BIT, or-ed */
typedef int HLint;               /**< 32 bits */
typedef unsigned int HLuint;     /**< 32 bits */
typedef int HLsizei;             /**< a count or a size; negative ones are HL_INVALID_VALUE */
typedef unsigned char HLubyte;   /**< 8 bits */
typedef short HLshort;           /**< 16 bits */
typedef unsigned short HLushort; /**< 16 bits */
typedef float HLfloat;           /**< 32 bits; widened to double exactly */
typedef double HLdouble;         /**< 64 bits; NaN and infinities are HL_INVALID_VALUE everywhere */

/** A conversation with a haptic server, and the state of the calls. Opaque. */
typedef struct HLcontext HLcontext;

/** Booleans, and "nothing". */
enum { HL_FALSE = 0, HL_TRUE = 1, HL_NONE = 0 };

/** What hlGetError returns. */
enum {
  HL_NO_ERROR = 0,
  HL_INVALID_ENUM = 0x0500,      /**< a constant that this call does not take */
  HL_INVALID_VALUE = 0x0501,     /**< a number out of its range, NaN or infinite */
  HL_INVALID_OPERATION = 0x0502, /**< not now: between hlBegin and hlEnd, inside a definition, not the master, ... */
  HL_STACK_OVERFLOW = 0x0503,    /**< a push on a full stack */
  HL_STACK_UNDERFLOW = 0x0504,   /**< a pop from an empty stack */
  HL_OUT_OF_MEMORY = 0x0505,     /**< no memory, or more than the server takes in one frame: the frame is dropped */
  HL_NO_CONTEXT = 0x48001,       /**< the thread has no current context; the call did nothing */
  HL_CONNECTION_LOST = 0x48002,  /**< the conversation has ended; reported once; nothing is sent any more */
  HL_REFUSED = 0x48003,          /**< the server has refused a frame or a setting, which changed nothing there */
  HL_BUSY = 0x48004              /**< too much is on its way to the server: the frame waits, see hlFlush */
};

/** What hlBegin, hlDrawArrays and hlDrawElements draw. Both sides of a surface are touched. Vertices that do not fill
 * the last primitive are dropped. */
enum {
  HL_POINTS = 0x0000,         /**< each vertex */
  HL_LINES = 0x0001,          /**< each two vertices */
  HL_LINE_LOOP = 0x0002,      /**< a line strip whose end is joined to its beginning */
  HL_LINE_STRIP = 0x0003,     /**< each vertex to the next */
  HL_TRIANGLES = 0x0004,      /**< each three vertices */
  HL_TRIANGLE_STRIP = 0x0005, /**< each vertex with the two before it */
  HL_TRIANGLE_FAN = 0x0006,   /**< each vertex with the one before it and the first */
  HL_QUADS = 0x0007,          /**< each four vertices: two triangles that share the diagonal from the first vertex */
  HL_QUAD_STRIP = 0x0008,     /**< each two vertices with the two before them */
  HL_POLYGON = 0x0009         /**< all vertices, convex; triangles that share the first vertex */
};

/** Numbers and pixels in memory. */
enum {
  HL_UNSIGNED_BYTE = 0x1401,  /**< HLubyte; as a texel 255 is 1 */
  HL_SHORT = 0x1402,          /**< HLshort */
  HL_UNSIGNED_SHORT = 0x1403, /**< HLushort */
  HL_UNSIGNED_INT = 0x1405,   /**< HLuint */
  HL_FLOAT = 0x1406,          /**< HLfloat; as a texel clamped to 0..1 and rounded to a 255th */
  HL_DOUBLE = 0x140A,         /**< HLdouble */
  HL_LUMINANCE = 0x1909       /**< one number for each texel */
};

/** hlMatrixMode. */
enum {
  HL_MODELVIEW = 0x1700, /**< places what is drawn in the world, or in the object that is defined */
  HL_TEXTURE = 0x1702    /**< turns texture coordinates when a vertex is drawn */
};

/** hlMaterial*: what a surface feels like; also what a texture can modulate, with HL_HEIGHT. At most 1e9. */
enum {
  HL_STIFFNESS = 0x48010,        /**< 0..1: the part of the servo's spring that the surface uses. Default 1. */
  HL_STATIC_FRICTION = 0x48011,  /**< mu_s >= 0; below mu_d it counts as mu_d. Default 0. */
  HL_DYNAMIC_FRICTION = 0x48012, /**< mu_d >= 0. Default 0. */
  HL_VISCOSITY = 0x48013,        /**< b >= 0, N s/m at the hand: drag for each metre a second. Default 0. */
  HL_STRIBECK = 0x48014,   /**< v_s >= 0, m/s: mu falls from mu_s to mu_d as exp(-(v/v_s)^2). Default 0: at once. */
  HL_PRESLIDING = 0x48015, /**< >= 0, N/m: a stuck proxy creeps on a spring of this. Default 0: it does not move. */
  HL_ADHESION = 0x48017,   /**< >= 0, N: the surface keeps the proxy until it is pulled off by more. Default 0. */
  HL_COMPLIANCE = 0x48018, /**< C >= 0, m/N: yields by C f, a spring of 1/C in series with the servo's. Default 0. */
  HL_STRENGTH = 0x48019,   /**< >= 0, N: pressed harder, it lets the proxy through. Default 0: it never does. */
  HL_HEIGHT = 0x48016      /**< textures only: a bump map, m; bends the normal and moves nothing */
};

/** hlShadeModel. */
enum {
  HL_FLAT = 0x1D00,  /**< the primitives as they are */
  HL_SMOOTH = 0x1D01 /**< force shading by the vertices' normals, where there are any. The default. */
};

/** Textures: targets, parameters and their values. */
enum {
  HL_TEXTURE_2D = 0x0DE1,      /**< the one target; also what hlEnable turns on, for the active unit */
  HL_TEXTURE0 = 0x84C0,        /**< the first texture unit; HL_TEXTURE0 + i is unit i, up to HL_MAX_TEXTURE_UNITS - 1 */
  HL_TEXTURE_WRAP = 0x48020,   /**< parameter: HL_REPEAT (default) or HL_CLAMP, in both directions */
  HL_TEXTURE_FILTER = 0x48021, /**< parameter: HL_LINEAR (default) or HL_NEAREST */
  HL_CLAMP = 0x2900,           /**< outside 0..1 the border's texel goes on */
  HL_REPEAT = 0x2901,          /**< outside 0..1 the image is repeated */
  HL_NEAREST = 0x2600,         /**< the nearest texel */
  HL_LINEAR = 0x2601,          /**< between the four nearest texels */
  HL_TEXTURE_ENV = 0x2300,     /**< the one target of hlTexEnv* */
  HL_TEXTURE_QUANTITY = 0x48022, /**< env: which quantity. Default HL_STIFFNESS. Setting it resets low and high. */
  HL_TEXTURE_LOW = 0x48023,      /**< env: the quantity where a texel is 0, in its unit and range. Default 0. */
  HL_TEXTURE_HIGH = 0x48024      /**< env: the quantity where a texel is 1. Default 1; of HL_HEIGHT 0. */
};

/** hlVolumeSolid: where the matter of a volume is. */
enum {
  HL_ABOVE = 0x48170, /**< where values are above iso. The default. */
  HL_BELOW = 0x48171  /**< where values are below iso, as of signed distances */
};

/** Control points of hlNurbsSurface. */
enum {
  HL_MAP2_VERTEX_3 = 0x0DB7, /**< x y z */
  HL_MAP2_VERTEX_4 = 0x0DB8  /**< x w, y w, z w, w; w > 0 */
};

/** hlEnableClientState and hlDisableClientState; hlIsEnabled takes them too. */
enum { HL_VERTEX_ARRAY = 0x8074, HL_NORMAL_ARRAY = 0x8075, HL_TEXTURE_COORD_ARRAY = 0x8078 };

/** hlPushAttrib: what is saved. Bits that are not here are ignored. */
enum {
  HL_CURRENT_BIT = 0x00000001,   /**< current normal, texture coordinates and name */
  HL_SURFACE_BIT = 0x00000040,   /**< materials and shade model */
  HL_TRANSFORM_BIT = 0x00001000, /**< matrix mode */
  HL_ENABLE_BIT = 0x00002000,    /**< what hlEnable and hlDisable set */
  HL_TEXTURE_BIT = 0x00040000,   /**< active unit, bindings, environments, and their hlEnable */
  HL_ALL_ATTRIB_BITS = 0x000FFFFF
};

/** hlProxy*. */
enum {
  HL_PROXY_RADIUS = 0x48030 /**< m, world, > 0; also a query of 1 number */
};

/** hlLedger: what happens to energy that the surfaces' rules add to the spring; HL_LEDGER_MODE is the query. */
enum {
  HL_LEDGER_TANK = 0x48040,   /**< paid from a small tank that their dissipation refills. The default. */
  HL_LEDGER_STRICT = 0x48041, /**< none may be added: passive at every tick */
  HL_LEDGER_REPORT = 0x48042  /**< counted only */
};

/** HL_SAFETY_STATE is one of these. */
enum {
  HL_SAFETY_OFF = 0x48048,    /**< no force */
  HL_SAFETY_ARMING = 0x48049, /**< the force ramps up from zero */
  HL_SAFETY_ON = 0x4804A,     /**< touchable */
  HL_SAFETY_FAULT = 0x4804B,  /**< no force until hlRearm; hlGetString(HL_FAULT) says why */
  HL_SAFETY_WAITING = 0x4804C /**< no force until somebody holds the dead-man switch */
};

/** hlHandGrip: how the hand of a simulated device holds it; HL_HAND_GRIP is the query. */
enum {
  HL_GRIP_LIGHT = 0x48058, /**< the default */
  HL_GRIP_FIRM = 0x48059   /**< stiffer, and with more damping: stiffer springs are stable */
};

/** Kinds of events, for hlEventFunc. */
enum {
  HL_EVENT_TOUCH = 0x48050,   /**< the proxy began to touch an object of this context */
  HL_EVENT_UNTOUCH = 0x48051, /**< the proxy left it, and did not come back within 20 ms: reported then, with the time
                                   and place of the last touch */
  HL_EVENT_BUTTON = 0x48052,  /**< a button of the device went down or up */
  HL_EVENT_MOTION = 0x48053,  /**< in a state the finger has moved on, by 1 mm at the hand */
  HL_EVENT_SLEEP = 0x48054,   /**< a body of this context has come to rest, and is not stepped any more */
  HL_EVENT_WAKE = 0x48055,    /**< something moves it again */
  HL_EVENT_IMPACT = 0x48056   /**< something hit it: 0.05 m/s or more in a step; of a body one in 20 ms is sent */
};

/** hlGetString; HL_DEVICE_NAME and HL_DEVICE_LABEL of any device: hlGetStringi. */
enum {
  HL_VENDOR = 0x1F00,          /**< "HL" */
  HL_VERSION = 0x1F02,         /**< of this library, "0.1.0" */
  HL_SERVER_VERSION = 0x48060, /**< of the server */
  HL_DEVICE_NAME = 0x48061,    /**< of the context's device: its maker and model */
  HL_FAULT = 0x48062,          /**< why HL_SAFETY_STATE is HL_SAFETY_FAULT, in one line; "" else */
  HL_ERROR_STRING = 0x48063,   /**< one line about the error that hlGetError returns or has returned last */
  HL_FRAME_WARNINGS = 0x48064, /**< what the server skipped of the frame that is shown, a line each; "" for nothing */
  HL_DEVICE_LABEL = 0x48065    /**< what the context's device is called at its server, such as left; "": the only one */
};

/** hlGet*v: the state of the calls, as it is now. The number of values stands first. */
enum {
  HL_CURRENT_NORMAL = 0x0B02,            /**< 3; 0 0 0: none */
  HL_CURRENT_TEXTURE_COORDS = 0x0B03,    /**< 2 */
  HL_CURRENT_NAME = 0x48070,             /**< 1; 0: none */
  HL_CURRENT_OBJECT = 0x0B33,            /**< 1; the object being defined, 0: none */
  HL_SHADE_MODEL = 0x0B54,               /**< 1; HL_FLAT or HL_SMOOTH */
  HL_MATRIX_MODE = 0x0BA0,               /**< 1; HL_MODELVIEW or HL_TEXTURE */
  HL_MODELVIEW_STACK_DEPTH = 0x0BA3,     /**< 1; at least 1 */
  HL_TEXTURE_STACK_DEPTH = 0x0BA5,       /**< 1; at least 1 */
  HL_MODELVIEW_MATRIX = 0x0BA6,          /**< 16, column by column */
  HL_TEXTURE_MATRIX = 0x0BA8,            /**< 16, column by column */
  HL_ATTRIB_STACK_DEPTH = 0x0BB0,        /**< 1 */
  HL_NAME_STACK_DEPTH = 0x0D70,          /**< 1 */
  HL_ACTIVE_TEXTURE = 0x84E0,            /**< 1; HL_TEXTURE0 + unit */
  HL_TEXTURE_BINDING_2D = 0x8069,        /**< 1; the texture bound to the active unit, 0: none */
  HL_MAX_TEXTURE_SIZE = 0x0D33,          /**< 1; most texels along a side */
  HL_MAX_TEXTURE_UNITS = 0x84E2,         /**< 1; one for each quantity: 5 */
  HL_MAX_ATTRIB_STACK_DEPTH = 0x0D35,    /**< 1 */
  HL_MAX_MODELVIEW_STACK_DEPTH = 0x0D36, /**< 1 */
  HL_MAX_NAME_STACK_DEPTH = 0x0D37,      /**< 1 */
  HL_MAX_TEXTURE_STACK_DEPTH = 0x0D39    /**< 1 */
  /* HL_STIFFNESS .. HL_PRESLIDING, HL_ADHESION, HL_COMPLIANCE, HL_STRENGTH: 1; as set by hlMaterial, else the default
   */
};

/** hlGet*v: the conversation and what the server sent when it began. */
enum {
  HL_SESSION = 0x48080,              /**< 1; number of this session at the server */
  HL_MASTER = 0x48081,               /**< 1; HL_TRUE: this context may set the device's proxy, workspace and spring */
  HL_CONNECTED = 0x48082,            /**< 1; HL_FALSE once the conversation has ended */
  HL_FRAME_SENT = 0x48083,           /**< 1; number of the last frame sent, 0: none */
  HL_FRAME_SHOWN = 0x48084,          /**< 1; number of the frame that is there to touch, 0: none */
  HL_FRAME_PROGRESS = 0x48085,       /**< 1; 0..1 of the frame sent last: 1 when it is shown */
  HL_FRAME_WAITING = 0x48086,        /**< 1; HL_TRUE: a flushed frame waits here to be sent */
  HL_FRAME_PRIMITIVES = 0x48087,     /**< 1; primitives of this context in the world that is shown */
  HL_DEVICE = 0x48088,               /**< 1; number of the context's device at its server, from 0 */
  HL_DEVICE_COUNT = 0x48089,         /**< 1; devices of the server */
  HL_MAX_OBJECTS = 0x48090,          /**< 1; objects this context may define */
  HL_MAX_SCENE_BYTES = 0x48091,      /**< 1; bytes of memory of their shapes: a triangle takes about 90 */
  HL_MAX_INSTANCES = 0x48092,        /**< 1; objects in the world, each call counted */
  HL_MAX_NESTING = 0x48093,          /**< 1; calls within calls */
  HL_MAX_TEXTURE_BYTES = 0x48094,    /**< 1; of all textures */
  HL_MAX_FRAME_RATE = 0x48095,       /**< 1; Hz; frames flushed faster wait and are merged. 0: no limit */
  HL_MAX_STATE_RATE = 0x48096,       /**< 1; Hz. 0: no limit */
  HL_MAX_BODIES = 0x4810D,           /**< 1; that move, of all clients together */
  HL_MAX_JOINTS = 0x4812F,           /**< 1; of all clients together */
  HL_DEVICE_FORCE_MAX = 0x48097,     /**< 1; N, peak */
  HL_DEVICE_WRIST = 0x48164,         /**< 1; HL_TRUE: the device reports how its stylus is turned */
  HL_GRIPPER_MAX = 0x48165,          /**< 1; rad: how far its gripper opens; 0: it has none */
  HL_SPRING_STIFFNESS_MAX = 0x48098, /**< 1; N/m; 0: not known */
  HL_SPRING_STIFFNESS = 0x48099,     /**< 1; N/m: K of the servo, as given at the beginning or set here since,
                                          at most the former; what others set is not seen */
  HL_SPRING_DAMPING = 0x4809A        /**< 1; N s/m: B of the servo */
};

/** hlGet*v: the device and what it touches, from the last state that hlPoll, hlFlush or hlFinish took. World frame.
 * Before the first state everything is 0. */
enum {
  HL_FINGER_POSITION = 0x480A0,        /**< 3; m */
  HL_PROXY_POSITION = 0x480A1,         /**< 3; m */
  HL_FORCE = 0x480A2,                  /**< 3; N at the hand */
  HL_CONTACT_COUNT = 0x480A3,          /**< 1; see hlGetContacts */
  HL_TOUCHED_OBJECT = 0x480A4,         /**< 1; the object of this context that presses hardest, 0: none */
  HL_TOUCHED_NAME = 0x480A5,           /**< 1; its name, 0: none */
  HL_BUTTONS = 0x480A6,                /**< 1; bit i is set while button i is down */
  HL_SAFETY_STATE = 0x480A7,           /**< 1; HL_SAFETY_OFF when nothing is known */
  HL_SERVO_RATE = 0x480A8,             /**< 1; Hz, measured over the last second */
  HL_PROXY_RATE = 0x480A9,             /**< 1; Hz, measured over the last second */
  HL_SERVO_DEADLINES_MISSED = 0x480AA, /**< 1; since the server started */
  HL_PROXY_DEADLINES_MISSED = 0x480AB, /**< 1; since the server started */
  HL_LEDGER_MODE = 0x480AC,            /**< 1 */
  HL_LEDGER_TANK_LEVEL = 0x480AD,      /**< 1; J that the rules may still add */
  HL_LEDGER_INJECTED = 0x480AE,        /**< 1; J that the rules have added since the server started */
  HL_LEDGER_DISSIPATED = 0x480AF,      /**< 1; J that they took away, positive */
  HL_WORKSPACE_ORIGIN = 0x480B0,       /**< 3; m: the world's point at the device's origin */
  HL_WORKSPACE_SCALE = 0x480B1,        /**< 1; metres of the world for one metre of the hand */
  HL_STATE_TIME = 0x480B2,             /**< 1; s since the server started, its clock, when the state was measured */
  HL_STATE_AGE = 0x480B3,              /**< 1; s since the state was taken here; infinite before the first */
  HL_VIBRATIONS = 0x480B4,             /**< 1; times that spring and hand shook and the spring was softened */
  HL_SPRING_LIMIT = 0x480B5,           /**< 1; N/m that the spring is held below since; 0: there is no limit */
  HL_HAND_GRIP = 0x480B6,              /**< 1; HL_GRIP_...; a person's hand is HL_GRIP_LIGHT */
  HL_ITERATION_CAPS = 0x480B7,         /**< 1; ticks so far that hit the cap on their passes */
  HL_UNPLACED_TICKS = 0x480B8,         /**< 1; ticks so far without a clear place for the proxy: nothing pulled */
  HL_OUT_OF_WORK_TICKS = 0x480B9,      /**< 1; ticks so far that did all they may; the next goes on from there */
  HL_BODY_COUNT = 0x4810C,             /**< 1; bodies of this context that move; see hlGetBodies */
  HL_JOINT_COUNT = 0x4812E,            /**< 1; joints of this context; see hlGetJoints */
  HL_SNAPPED_OBJECT = 0x48140,         /**< 1; of this context, whose snap holds the proxy; 0: none */
  HL_SNAPPED_NAME = 0x48141,           /**< 1; the name of its call; 0: none */
  HL_SNAP_NUMBER = 0x48142,            /**< 1; which of its snaps, from 0 in the order of the definition */
  HL_STYLUS_ROTATION = 0x48160,        /**< 4; unit quaternion x y z w, from its axes to the world's; 0 0 0 1: its shaft
                                            lies along +z, or the device has no wrist */
  HL_STYLUS_SPIN = 0x48161,            /**< 3; rad/s: its angular velocity */
  HL_GRIPPER_ANGLE = 0x48162,          /**< 1; rad: how far the gripper is open */
  HL_REMOTE_HAND_COUNT = 0x48166,      /**< 1; hands of other servers of a shared world; see hlGetRemoteHands */
  HL_GRIPPER_FORCE = 0x48163           /**< 1; N with which the hand closes it; 0: the device does not report it */
};

/** hlBody*: a rigid body. Its shape, by which it meets other bodies and the scene, is made from its mesh; the hand
 * feels the mesh. */
enum {
  HL_BODY_MASS = 0x48100,             /**< 1e-9 .. 1e9, kg. Default: by volume of its shape and density. */
  HL_BODY_DENSITY = 0x48101,          /**< 1e-6 .. 1e6, kg/m^3. Default 1000. */
  HL_BODY_STATIC_FRICTION = 0x48102,  /**< 0 .. 1e3, with other bodies, not below the dynamic one. Default: as that. */
  HL_BODY_DYNAMIC_FRICTION = 0x48103, /**< 0 .. 1e3. Default: as the static one, or 0.5. */
  HL_BODY_RESTITUTION = 0x48104,      /**< 0 .. 1. Default 0. Of two that touch, the geometric mean counts. */
  HL_BODY_SHAPE = 0x48105,            /**< HL_BODY_HULL .. HL_BODY_PARTS. Default HL_BODY_HULL. */
  HL_BODY_FIXED = 0x48106,            /**< HL_TRUE: it does not move by itself. Default HL_FALSE. */
  HL_BODY_VELOCITY = 0x48107,         /**< 3; m/s of the centre of mass. Default 0. */
  HL_BODY_SPIN = 0x48108,             /**< 3; rad/s, world frame. Default 0. */
  HL_BODY_POSITION = 0x48109,         /**< hlGetBodydv, 3; m: of the object frame */
  HL_BODY_ROTATION = 0x4810A,         /**< hlGetBodydv, 4; quaternion x y z w */
  HL_BODY_MATRIX = 0x4810B,           /**< hlGetBodydv, 16; both, column by column: in place of the call's matrix, but
                                           for its scale; of a mirrored call that is negative along all axes */
  HL_BODY_HULL = 0x48110,             /**< convex hull of the vertices */
  HL_BODY_BOX = 0x48111,              /**< their bounds in the object frame */
  HL_BODY_BALL = 0x48112,             /**< centred in the bounds, as wide as their largest side */
  HL_BODY_CAPSULE = 0x48113,          /**< along the largest side, as wide as the larger of the others */
  HL_BODY_CYLINDER = 0x48114,         /**< the same with flat ends */
  HL_BODY_PARTS = 0x48115             /**< convex hulls of the pieces of the mesh, all of them as one; at most 64, and
                                           each counts as a body */
};

/** Kinds of fields, of hlFieldPoint3d and hlFieldPlane3d; HL_FIELD_CONSTANT is that of hlFieldForce3d. */
enum {
  HL_FIELD_MAGNET = 0x48150,   /**< pulls to its place within its reach */
  HL_FIELD_SPRING = 0x48151,   /**< pulls to its place, the more the farther */
  HL_FIELD_CONSTANT = 0x48152, /**< pushes in one direction */
  HL_FIELD_DRAG = 0x48153      /**< brakes the hand */
};

/** A rigid body after the last step, from hlGetBodies. World frame. */
typedef struct HLbody {
  HLuint object;        /**< that was called */
  HLuint name;          /**< 0: none */
  HLdouble position[3]; /**< m: of the object frame */
  HLdouble rotation[4]; /**< unit quaternion x y z w */
  HLdouble velocity[3]; /**< m/s: of the centre of mass */
  HLdouble spin[3];     /**< rad/s */
} HLbody;

/** hlJoint*: what the next hlJoin makes. Along the coordinate of the joint, which is 0 where the calls of its bodies
 * place them, act forces: in N and m, or N m and rad for a hinge; a ball and a fixed joint have none. */
enum {
  HL_JOINT_KIND = 0x48120,       /**< HL_JOINT_BALL (the default) .. HL_JOINT_DISTANCE. Setting it resets the others. */
  HL_JOINT_COLLIDE = 0x48121,    /**< HL_TRUE: its two bodies also collide with each other. Default HL_FALSE. */
  HL_JOINT_LOW = 0x48122,        /**< -1e9 .. 1e9: the coordinate is not below. Default: no limit. */
  HL_JOINT_HIGH = 0x48123,       /**< -1e9 .. 1e9, not below the low one: nor above. Default: no limit. */
  HL_JOINT_REST = 0x48124,       /**< -1e9 .. 1e9: where the spring makes no force. Default 0. */
  HL_JOINT_SPRING = 0x48125,     /**< 0 .. 1e9, N/m or N m/rad. Default 0. */
  HL_JOINT_DAMPING = 0x48126,    /**< 0 .. 1e9, N s/m or N m s/rad. Default 0. */
  HL_JOINT_FRICTION = 0x48127,   /**< 0 .. 1e9, N or N m, dry. Default 0. */
  HL_JOINT_ANCHOR = 0x48128,     /**< 3; m, within 1e6: the point that it holds; of a distance that at body a. Default:
                                      the world's origin. */
  HL_JOINT_ANCHOR_B = 0x48129,   /**< 3; m, within 1e6: of a distance the point at body b. Default: the same. */
  HL_JOINT_AXIS = 0x4812A,       /**< 3; of any length but 0: of a hinge or slider, which need one */
  HL_JOINT_COORDINATE = 0x4812B, /**< hlGetJointdv, 1; m or rad; of a hinge with its whole turns */
  HL_JOINT_VELOCITY = 0x4812C,   /**< hlGetJointdv, 1; m/s or rad/s, of the last step's chord: docs/bodies.md */
  HL_JOINT_FORCE = 0x4812D,      /**< hlGetJointdv, 1; N or N m along the coordinate: spring, damper, table, friction
                                      and limits, on body a */
  HL_JOINT_HOLD = 0x48130,       /**< hlGetJointdv, 3; N, world frame: with which it holds body a at its anchor */
  HL_JOINT_BALL = 0x48138,       /**< holds a point; no coordinate */
  HL_JOINT_HINGE = 0x48139,      /**< a point and an axis; the coordinate is the angle of a about the axis, rad */
  HL_JOINT_SLIDER = 0x4813A,     /**< all but the way of a along the axis, m */
  HL_JOINT_FIXED = 0x4813B,      /**< all; no coordinate */
  HL_JOINT_DISTANCE = 0x4813C    /**< only the limits of the distance of the two anchors, m; without limits and forces
                                      that distance, as a rod */
};

/** A joint after the last step, from hlGetJoints. Forces on its body a; on b acts the opposite. */
typedef struct HLjoint {
  HLuint joint;        /**< its number */
  HLdouble coordinate; /**< m or rad */
  HLdouble velocity;   /**< m/s or rad/s */
  HLdouble force;      /**< N or N m: as HL_JOINT_FORCE */
  HLdouble hold[3];    /**< N, world frame: as HL_JOINT_HOLD */
} HLjoint;

/** One contact of the proxy, from hlGetContacts. World frame. */
typedef struct HLcontact {
  HLdouble point[3];        /**< m, on the surface */
  HLdouble normal[3];       /**< unit, away from the surface, as it feels: bent by shading and bump maps */
  HLdouble share;           /**< m: its part of proxy + o - finger; below 0: it pulls. o is 0 unless a surface yields:
                                     docs/tissue.md. Its force is share * K s / W, with W HL_WORKSPACE_SCALE and s the
                                     mean over the contacts, weighted by shares, of `stiffness`, or of 1 / (1 /
                                     `stiffness` + K C / W) where it yields by a compliance C: HL_COMPLIANCE, and of
                                     hlCompliance c^2 normal + (1 - c^2) tangential, c the cosine between what the
                                     contacts of its object hold together, friction too, and the sum of their share *
                                     normal: 1 without friction */
  HLdouble static_friction; /**< mu_s there */
  HLdouble stiffness;       /**< 0..1 there */
  HLuint object;            /**< the innermost object; 0: drawn outside of objects */
  HLuint name;              /**< 0: none */
  HLuint session;           /**< whose object it is: HL_SESSION for this context's */
} HLcontact;

/** A hand of another server of a shared world, from hlGetRemoteHands. World frame. */
typedef struct HLremotehand {
  char server[64];      /**< name of its server, UTF-8, ended by 0 */
  char device[64];      /**< name of its device there; empty: that server has one */
  HLdouble finger[3];   /**< m */
  HLdouble proxy[3];    /**< m */
  HLdouble force[3];    /**< N, on that hand */
  HLdouble rotation[4]; /**< unit quaternion x y z w, of its stylus; 0 0 0 1: its device has no wrist */
  HLdouble radius;      /**< m, of its proxy */
  HLuint buttons;       /**< bit i: button i is down */
  HLuint contacts;      /**< how many surfaces hold its proxy */
} HLremotehand;

/** One step of the servo, from hlTakeSamples. World frame. */
typedef struct HLsample {
  HLdouble time;        /**< s, the server's clock */
  HLdouble position[3]; /**< m: of the finger */
  HLdouble force[3];    /**< N at the hand */
  HLuint buttons;       /**< bit i is set while button i is down */
  HLdouble rotation[4]; /**< of the stylus: unit quaternion x y z w, to the axes of the world; 0 0 0 1: not turned */
  HLdouble spin[3];     /**< rad/s: its angular velocity */
  HLdouble gripper;     /**< rad: how far the gripper is open */
  HLdouble grip_force;  /**< N with which the hand closes it; 0: the device does not report it */
} HLsample;

/** What the hand has felt since the last hlTakeContactReport. World axes. */
typedef struct HLcontactreport {
  HLdouble time;     /**< s, the server's clock, of its end */
  HLdouble interval; /**< s: its length; 0: nothing has come */
  HLdouble force[3]; /**< N: mean force on the hand */
} HLcontactreport;

/** A place that was pressed, from hlTakeContactReport. World frame. */
typedef struct HLcontactforce {
  HLuint object;       /**< the innermost object; 0: drawn outside of objects */
  HLuint name;         /**< 0: none */
  HLuint session;      /**< whose object it is: HL_SESSION for this context's */
  HLuint vertex_count; /**< 1: a point; 2: a line; 3: a triangle; 0: a surface without vertices */
  HLuint vertices[3];  /**< its vertices, by the numbers that hlUpdateVertices takes */
  HLdouble weights[3]; /**< barycentric, of the vertices: where the force acted, in the mean */
  HLdouble point[3];   /**< m: the same place */
  HLdouble force[3];   /**< N: mean force on the hand over the whole interval; on the object acts the opposite one */
} HLcontactforce;

/** What happened. */
typedef struct HLevent {
  HLenum kind;          /**< HL_EVENT_... */
  HLdouble time;        /**< s, the server's clock */
  HLuint object;        /**< all but button and motion: the innermost object; 0: drawn outside of objects */
  HLuint name;          /**< the same: its name; 0: none */
  HLdouble position[3]; /**< m, world: of the proxy; of a body its centre of mass */
  HLuint button;        /**< HL_EVENT_BUTTON: which, from 0 */
  HLboolean down;       /**< HL_EVENT_BUTTON: HL_TRUE when it went down */
  HLdouble impulse;     /**< HL_EVENT_IMPACT: N s, that contacts, hand and joints gave the body */
} HLevent;

/** Called by hlPoll. May use every call but hlPoll and hlDestroyContext; must not throw. */
typedef void (*HLeventfunc)(const HLevent* event, void* user);
/** Called by the call that makes the error, on its thread. May not use HL calls; must not throw. */
typedef void (*HLerrorfunc)(HLenum error, const char* text, void* user);

#ifdef __cplusplus
}
#endif

#endif
