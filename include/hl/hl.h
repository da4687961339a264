/* HL: make graphics touchable. Calls with GL's names and meanings; a haptic server turns what they draw and the place
 * of a force-feedback device into forces. C99 and C++; hl.hpp adds scopes and spans.
 *
 * Context. Every call but hlCreateContext, hlMakeCurrent and hlDestroyContext works on the thread's current context, as
 * in GL. A context is current on one thread at a time; different contexts do not know of each other. After fork() they
 * are of the parent alone: the child has no current context, cannot make one of them current, and hlDestroyContext does
 * nothing with them there. hlCreateContext works in it, but for inproc: where the parent had such a context.
 *
 * Errors. A call that makes an error changes nothing else. The context keeps its first error until hlGetError takes it.
 * Without a current context a call does nothing, returns 0, and the thread keeps HL_NO_CONTEXT. NaN and infinities are
 * HL_INVALID_VALUE, and so is a null pointer where there is something to read or write. Between hlBegin and hlEnd only
 * hlVertex*, hlNormal*, hlTexCoord* and hlCancelFrame may be called: every other call is HL_INVALID_OPERATION.
 *
 * Frames. What happens between two hlFlush (or hlFinish) is one frame, and becomes touchable all at once. What a frame
 * draws outside of definitions (hlBegin .. hlEnd, arrays, hlCallObject) replaces the world; a frame that draws nothing
 * leaves the world's calls as they were, so that redefining an object alone changes what is felt; hlClear makes the
 * frame begin with an empty world. Objects and textures stay until they are overwritten or deleted.
 *
 * Nothing waits for the server but hlCreateContext and hlFinish. */
#ifndef HL_HL_H
#define HL_HL_H

/* Another haptic library has an <HL/hl.h> with functions of the same names and other meanings. */
#if defined(HL_H_DEFINE) || defined(_STI_HL_DEFINES_H_DEFINE) || defined(HLAPI) || defined(HL_VERSION_MAJOR_NUMBER)
#error "hl/hl.h: another vendor's hl.h is already included; a source file can use only one of the two"
#endif

#include <hl/hl_types.h>

/** Marks what the library gives to the outside. */
#if defined(__GNUC__)
#define HL_API __attribute__((visibility("default")))
#else
#define HL_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Context -------------------------------------------------------------------------------------------------- */

/** Opens a conversation with a haptic server; waits until the server has welcomed it. NULL when that fails:
 * hlGetConnectError says why. Does not make the context current. Any thread.
 *
 * `url`:  inproc:              a server inside this process, with a simulated device; all contexts share it
 *         hl://host[:port]     a server elsewhere; port 1997 when left out
 *         hls://host[:port]    the same through TLS
 * and after a '?', options joined by '&' (values percent-encoded):
 *         name=TEXT        of this client, for the server's logs; default: the program's
 *         token=TEXT       where the server asks for one; default: the environment's HL_TOKEN
 *         device=N|LABEL   number or label of the device whose state is wanted; default 0. A program with two hands has
 *                          a context for each: device=left, device=right; what either draws, both feel
 *         master=0|1       wants to set the device's proxy, workspace and spring; default 1; the first client gets it
 *         keep=0|1         objects stay touchable when the conversation ends, until `name` shows a frame; default 0
 *         state_rate=HZ    how often the state comes; default 60; 0: never
 *         timeout=SECONDS  how long to wait for the welcome; default 10
 *         ca=FILE          hls: certificates (PEM) that the server's is checked against; default: the system's
 *         sim=MODEL        inproc: the model of the simulated device, as hl touch --device sim:MODEL has it; the first
 *                          context says which, and another one that is open beside it may not want another
 * An unknown option is an error.
 *
 * The first context of inproc: starts the server and computes how its hand comes to its place: 0.2 s of computing. One
 * that is opened beside it takes a millisecond: a program that opens and closes many keeps one open.
 *
 * The loops of inproc: ask for SCHED_FIFO. They leave the program's memory alone: one that wants them safe from paging
 * locks its memory itself, before, by mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT). */
HL_API HLcontext* hlCreateContext(const char* url);
/** Why the last hlCreateContext of this thread failed, in one line; "" when it did not. Valid until the thread's next
 * hlCreateContext. */
HL_API const char* hlGetConnectError(void);
/** Makes `context` the thread's current one; NULL: none. HL_FALSE, with HL_INVALID_OPERATION on the context that was
 * and stays current (or on the thread), when `context` is current on another thread, or of the process that this one
 * was forked from, or between hlBegin and hlEnd. */
HL_API HLboolean hlMakeCurrent(HLcontext* context);
/** The thread's current context; NULL: none. Never an error. */
HL_API HLcontext* hlGetCurrentContext(void);
/** Ends the conversation and frees the context; what was not flushed is lost. Current on this thread: the thread has
 * none afterwards. Current on another thread, or in one of its own callbacks: HL_INVALID_OPERATION and nothing happens.
 * NULL, or of the process that this one was forked from: nothing happens. */
HL_API void hlDestroyContext(HLcontext* context);

/** Returns the kept error and forgets it; HL_NO_ERROR when there is none. Without a context: the thread's. Between
 * hlBegin and hlEnd it returns HL_NO_ERROR and makes HL_INVALID_OPERATION. */
HL_API HLenum hlGetError(void);
/** `callback` is called at every error of the context, also at those that are not kept. NULL: no callback. */
HL_API void hlErrorFunc(HLerrorfunc callback, void* user);
/** A text; names in hl_types.h. Valid until the next call that returns a text, takes replies, or makes an error. NULL
 * at an error. HL_INVALID_ENUM: not a text. */
HL_API const char* hlGetString(HLenum name);
/** HL_DEVICE_NAME or HL_DEVICE_LABEL of device number `device` of the server, from 0. As hlGetString. HL_INVALID_VALUE:
 * there is no such device; HL_DEVICE_COUNT. */
HL_API const char* hlGetStringi(HLenum name, HLuint device);

/* ---- Frames --------------------------------------------------------------------------------------------------- */

/** The frame begins with an empty world: drops what it has drawn so far, and even when nothing more is drawn there is
 * nothing to touch afterwards. Objects, textures and the state of the calls stay. HL_INVALID_OPERATION in a definition.
 */
HL_API void hlClear(void);
/** The frame ends without effect, and another begins: drops all that it has drawn, defined, updated and deleted, of
 * objects and of textures, and ends primitives and a definition that are open without effect: it is allowed between
 * hlBegin and hlEnd too. The state of the calls stays. For a program that cannot go on with a frame, as after an
 * exception. */
HL_API void hlCancelFrame(void);
/** Ends the frame and sends it, if there is anything in it; never waits. When more than is good is on its way already
 * (HL_BUSY), or, without an error, the last frame was sent less than 1 / HL_MAX_FRAME_RATE ago or the server is still
 * building many, the frame waits here: the next
 * hlFlush, hlFinish or hlPoll sends it, together with what has been flushed since (the later world, the later
 * definitions). HL_OUT_OF_MEMORY: the frame is larger than the server takes, and is dropped. Also takes replies, so
 * that HL_REFUSED and HL_CONNECTION_LOST may show here. HL_INVALID_OPERATION in a definition.
 *
 * Nothing of a frame that is refused or dropped is there: neither the world nor any object, texture or deletion of it,
 * those without a fault included. What it defined is to be defined again. The context notices when it takes the reply:
 * then hlIsObject, hlIsTexture and the vertices that hlUpdateVertices counts are as before that frame, but for what
 * later frames have defined or deleted, and units have no texture bound that is gone.
 *
 * What is drawn elsewhere than in the frame before moves there, and what has other vertices bends, in the time between
 * the last two frames, at most 100 ms: smoothly at any rate, and felt one frame late. Motion begins 2 ms after the
 * scene is ready, or later where it takes long to make. What comes, goes or is another surface is there, or gone, at
 * once. */
HL_API void hlFlush(void);
/** hlFlush, then waits until all that was sent is shown or refused, or the conversation has ended. */
HL_API void hlFinish(void);
/** hlFinish, but waits at most `seconds` (>= 0). HL_TRUE: everything is shown. HL_FALSE: refused, ended, or, without an
 * error, not yet. */
HL_API HLboolean hlFinishTimeout(HLdouble seconds);
/** From now on objects move to their new places within `seconds` (>= 0; 0: at once) of each frame's showing, so that
 * they push instead of jumping. Negative: within the time between the last two frames. That is the default. */
HL_API void hlFrameInterval(HLdouble seconds);

/* ---- Geometry ------------------------------------------------------------------------------------------------- */

/** Begins primitives of `mode` (HL_POINTS .. HL_POLYGON), placed by the matrix and with the surface and name of this
 * moment. HL_INVALID_ENUM: not a mode. */
HL_API void hlBegin(HLenum mode);
/** Ends them. Vertices that do not make up a whole primitive are left out, without an error, as in GL.
 * HL_INVALID_OPERATION without hlBegin. */
HL_API void hlEnd(void);

/** A vertex, in metres times the matrix, with the current normal and texture coordinates; z is 0 in the forms with two
 * numbers. Outside of hlBegin .. hlEnd it is ignored. */
HL_API void hlVertex2f(HLfloat x, HLfloat y);
HL_API void hlVertex2d(HLdouble x, HLdouble y);             /**< see hlVertex2f */
HL_API void hlVertex3f(HLfloat x, HLfloat y, HLfloat z);    /**< see hlVertex2f */
HL_API void hlVertex3d(HLdouble x, HLdouble y, HLdouble z); /**< see hlVertex2f */
HL_API void hlVertex2fv(const HLfloat* v);                  /**< see hlVertex2f */
HL_API void hlVertex2dv(const HLdouble* v);                 /**< see hlVertex2f */
HL_API void hlVertex3fv(const HLfloat* v);                  /**< see hlVertex2f */
HL_API void hlVertex3dv(const HLdouble* v);                 /**< see hlVertex2f */

/** The current normal, for the vertices to come; any length. 0 0 0 is no normal: such vertices feel flat. That is what
 * a context and a definition begin with (GL begins with 0 0 1). Any time. */
HL_API void hlNormal3f(HLfloat x, HLfloat y, HLfloat z);
HL_API void hlNormal3d(HLdouble x, HLdouble y, HLdouble z); /**< see hlNormal3f */
HL_API void hlNormal3fv(const HLfloat* v);                  /**< see hlNormal3f */
HL_API void hlNormal3dv(const HLdouble* v);                 /**< see hlNormal3f */

/** The current texture coordinates, for the vertices to come, turned by the texture matrix there. 0 0 at first. Any
 * time. */
HL_API void hlTexCoord2f(HLfloat u, HLfloat v);
HL_API void hlTexCoord2d(HLdouble u, HLdouble v); /**< see hlTexCoord2f */
HL_API void hlTexCoord2fv(const HLfloat* v);      /**< see hlTexCoord2f */
HL_API void hlTexCoord2dv(const HLdouble* v);     /**< see hlTexCoord2f */

/* ---- Arrays --------------------------------------------------------------------------------------------------- */

/** Where the vertices are: `size` (2 or 3) numbers of `type` (HL_FLOAT or HL_DOUBLE) each, `stride` bytes from one to
 * the next (0: close together). Read when drawn, not before. HL_INVALID_VALUE: another size, a negative stride.
 * HL_INVALID_ENUM: another type. */
HL_API void hlVertexPointer(HLint size, HLenum type, HLsizei stride, const void* pointer);
/** Where the normals are, three numbers each; as hlVertexPointer. */
HL_API void hlNormalPointer(HLenum type, HLsizei stride, const void* pointer);
/** Where the texture coordinates are; as hlVertexPointer, `size` 2. */
HL_API void hlTexCoordPointer(HLint size, HLenum type, HLsizei stride, const void* pointer);
/** Draws with an array (HL_VERTEX_ARRAY, HL_NORMAL_ARRAY, HL_TEXTURE_COORD_ARRAY). HL_INVALID_ENUM: another one. */
HL_API void hlEnableClientState(HLenum array);
/** Draws without it: the current normal or texture coordinates hold for all vertices. Without HL_VERTEX_ARRAY nothing
 * is drawn. All three are disabled at first. */
HL_API void hlDisableClientState(HLenum array);
/** The same as hlBegin(mode), the vertices `first` .. `first + count - 1` of the arrays, and hlEnd, to the bit. The
 * current normal and texture coordinates stay as they were. HL_INVALID_VALUE: negative numbers, or NaN in an array:
 * nothing is drawn. HL_INVALID_OPERATION: an enabled array has no pointer. */
HL_API void hlDrawArrays(HLenum mode, HLint first, HLsizei count);
/** Draws with the vertices that `indices` lists, `count` numbers of `type` (HL_UNSIGNED_BYTE, HL_UNSIGNED_SHORT or
 * HL_UNSIGNED_INT), as hlDrawArrays otherwise. A vertex that is listed several times, as in most meshes, is kept once.
 * Indices must be within the arrays: their size is not known here. */
HL_API void hlDrawElements(HLenum mode, HLsizei count, HLenum type, const void* indices);
/** Draws a height field: `columns` x `rows` samples of `type` (HL_SHORT, HL_UNSIGNED_SHORT or HL_FLOAT), row by row, as
 * two triangles between each four, which the server makes when they are touched: it keeps the samples alone. Columns
 * lead to +x, rows to +z, both 1 apart, with the middle of the field at x = z = 0; heights are y: hlScaled makes metres
 * of them. Around a sample that equals `*missing`, or is not a number, there is a hole; `missing` may be NULL. Textures
 * lie over it as a map does: u goes from 0 at the first column to 1 at the last, v from 1 at the first row to 0 at the
 * last, both times what the texture matrix scales by. The samples are copied. HL_INVALID_VALUE: fewer than two columns
 * or rows, or no samples. HL_INVALID_ENUM: another type. HL_INVALID_OPERATION: it is textured, and the texture matrix
 * turns or moves. HL_OUT_OF_MEMORY: 1 GiB of samples or more. */
HL_API void hlHeightField(HLsizei columns, HLsizei rows, HLenum type, const void* samples, const HLdouble* missing);
/** Draws what a depth camera sees: `width` x `height` depths of 16 bits, row by row from the upper left, in units of
 * `scale` metres; 0 is none. `camera`: fx, fy, cx, cy of a pinhole camera without distortion, in pixels. It is at the
 * origin and looks along -z with y up; the modelview matrix places it. Neighbours whose depths differ by more than a
 * part `join` (0: 0.02) are not joined: there is a gap. `smoothing`, 0 .. less than 1: of what the object showed before
 * as its item of this number this part stays, where it is the same surface. Draw it anew in a definition for each frame
 * of the camera: the proxy stays on the side of the camera. Textures lie over the picture, v = 1 at its top; a texture
 * of as many texels has one on each pixel. The depths are copied. HL_INVALID_VALUE: fewer than two columns or rows, no
 * depths, or numbers out of range. HL_INVALID_OPERATION: as hlHeightField. HL_OUT_OF_MEMORY: 1 GiB of depths or more.
 */
HL_API void hlDepthFrame(HLsizei width, HLsizei height, const HLushort* depths, const HLdouble* camera, HLdouble scale,
                         HLdouble join, HLdouble smoothing);
/** Draws the surface where the samples of a volume pass the value `iso`, as in CT, MRI and distances from a surface.
 * The server makes its triangles when they are touched. `width` x `height` x `depth` samples of `type` (HL_SHORT,
 * HL_UNSIGNED_SHORT or HL_FLOAT) along +x, +y and +z, those along x next to each other, all 1 apart, with the middle of
 * the volume at the origin: hlScaled makes metres of them. There is no surface around a sample that equals `*missing`,
 * or is not a number; `missing` may be NULL. Normals lead out of the matter: see hlVolumeSolid. The samples are copied.
 * The server refuses a frame with an `iso` at which there is no surface (HL_REFUSED). HL_INVALID_VALUE: fewer than two
 * samples along an axis, no samples, or an `iso` that is not a number. HL_INVALID_ENUM: another type.
 * HL_OUT_OF_MEMORY: 1 GiB of samples or more. */
HL_API void hlVolume(HLsizei width, HLsizei height, HLsizei depth, HLenum type, const void* samples,
                     const HLdouble* missing, HLdouble iso);
/** What values of volumes that are drawn next feel like: `rows` (0 .. 256) rows of three numbers, by rising values: the
 * value; the resistance, N, below which nothing moves in matter of this value; and its drag, N s/m, which a motion
 * needs for each m/s. Linear between two rows, constant beyond the first and the last; at most 1e9. It acts wherever
 * the proxy is in the volume, also when it has pierced its surface (HL_STRENGTH). 0 rows: nothing, which is the
 * default. Copied. HL_INVALID_VALUE: out of its range. */
HL_API void hlVolumeMatter(HLsizei rows, const HLdouble* numbers);
/** On which side of `iso` the matter is, of the surfaces that hlVolume and hlVolumeSurface draw next: HL_ABOVE, which
 * is the default, as bone in CT, or HL_BELOW, as in a grid of signed distances. HL_INVALID_ENUM: another side. */
HL_API void hlVolumeSolid(HLenum side);
/** Draws another surface of the volume that was drawn last in this object or world, with the matrix and material of
 * now: skin and bone. Nothing is copied or sent again. HL_INVALID_OPERATION: no volume was drawn. HL_INVALID_VALUE: an
 * `iso` that is not a number. */
HL_API void hlVolumeSurface(HLdouble iso);
/** Draws a cloud of `count` points, x y z each, in metres, as scanners give them. `normals`, three numbers each and of
 * either sign, turn the force where shading is smooth; NULL: those of the plane through the 12 nearest points. With
 * `reach` 0 the points alone are touched, and the proxy sinks between them; from 0.01 to 10 each is a small hexagon
 * across its normal around a disc of so many distances between neighbours: with 0.75 there are no holes in most scans.
 * The points are copied. HL_INVALID_VALUE: no points, another `reach`, or numbers that are not finite.
 * HL_OUT_OF_MEMORY: 29 million points or more: draw several clouds. */
HL_API void hlPointCloud(HLsizei count, const HLdouble* points, const HLdouble* normals, HLdouble reach);
/** Gives the points of the cloud that was drawn last in this object or world colours, which pages show: red, green and
 * blue of each, 0 .. 255 (sRGB). They are not felt. Copied. HL_INVALID_OPERATION: no cloud was drawn. HL_INVALID_VALUE:
 * `count` is not its number of points. */
HL_API void hlPointColors(HLsizei count, const HLubyte* colors);

/** Draws a NURBS surface without trims as gluNurbsSurface does, or a Bezier patch, with no knots, as glMap2d and
 * glEvalMesh2 do. The server makes triangles within `error` of it, in units of the vertices (0: 2e-5 of the largest
 * side), with the normals of the surface, which is felt with HL_SMOOTH; at most 5 million in an object's run of
 * surfaces. Along u there are `u_knot_count` - `u_order` control points, or `u_order` without knots, `u_stride` numbers
 * apart; along v the same. `type`: HL_MAP2_VERTEX_3, x y z each, or HL_MAP2_VERTEX_4, x w, y w, z w and w, its weight >
 * 0. Surfaces drawn one after the other with the same error, matrix and look have no cracks where they have the same
 * control points along a side. The normal is that of u to the right and v up. Numbers are copied. HL_INVALID_VALUE: an
 * order that is not 2 .. 8, knots that fall or tear the surface, other numbers that make no surface, or an `error` that
 * is not 0 or 1e-9 .. 1e9. HL_INVALID_ENUM: another type. */
HL_API void hlNurbsSurface(HLsizei u_knot_count, const HLdouble* u_knots, HLsizei v_knot_count, const HLdouble* v_knots,
                           HLint u_stride, HLint v_stride, const HLdouble* points, HLint u_order, HLint v_order,
                           HLenum type, HLdouble error);

/** Draws the surface of a solid that `json` writes down, as scene files do: {"expression": {"torus": {"radius": 0.03,
 * "tube": 0.01}}, "error": 1e-6}, with "bounds" where it has no end. Lengths are those of the current matrix; docs/
 * implicit.md lists the expressions. The server makes its triangles when they are touched. HL_INVALID_VALUE: NULL, or
 * text that is not such JSON. An expression that cannot be is refused by the server with its frame. */
HL_API void hlImplicit(const char* json);

/* ---- Objects -------------------------------------------------------------------------------------------------- */

/** Writes `n` object numbers (> 0) that are not in use. HL_INVALID_VALUE: n < 0. */
HL_API void hlGenObjects(HLsizei n, HLuint* objects);
/** Begins the definition of `object` (> 0), which overwrites an earlier one. Unlike GL's display lists a definition is
 * closed: matrices, surface, textures, name and normal begin fresh (identity and "not set"), and are at hlEndObject
 * what they were before. What it does not set (material, shade model, textures, name), it takes from whoever calls it.
 * Calls that are not about drawing (textures' images, frames' interval, device, queries) act at once. HL_INVALID_VALUE:
 * 0. HL_INVALID_OPERATION: a definition is open. */
HL_API void hlNewObject(HLuint object);
/** Ends the definition; touchable with the next hlFlush. HL_INVALID_OPERATION: none is open. */
HL_API void hlEndObject(void);
/** In place of hlEndObject: nothing of the definition counts, and the object stays as it was, defined or not.
 * HL_INVALID_OPERATION: no definition is open. */
HL_API void hlCancelObject(void);
/** Puts an object into the world, or into the definition that is open, placed by the matrix and with the surface and
 * name of this moment. Later definitions of it show here too. HL_INVALID_VALUE: not defined (GL ignores that).
 * HL_INVALID_OPERATION: it calls, directly or not, the object that is being defined. */
HL_API void hlCallObject(HLuint object);
/** Forgets objects; where they are called there is nothing from the next frame on, until they are defined again. 0 and
 * unknown numbers are ignored. Where the world has a joint of such a body, it is to be drawn without that joint in the
 * same frame: see hlJoin. HL_INVALID_VALUE: n < 0. HL_INVALID_OPERATION in a definition. */
HL_API void hlDeleteObjects(HLsizei n, const HLuint* objects);
/** Moves `count` vertices of `object` from number `first` on, with the next hlFlush, and touches nothing else of it: a
 * mesh that bends costs what has moved, not the whole. Vertices count from 0 in the order in which the definition drew
 * them; those that filled no primitive do not count. Each hlDrawElements adds the vertices that it lists, each once, in
 * the order of the arrays: where it lists them all, they keep their numbers. `vertices`: x y z each, in metres of the
 * definition, before its matrices. `normals`: x y z each, of any length; null: they stay as they are.
 * Both are read at once. Where an object is defined anew, what was moved before is forgotten. The vertices go on
 * straight lines, in the time between the last two frames, as objects that are drawn elsewhere move: see hlFlush. What
 * bends pushes the proxy, and never passes it below a speed of 16 of its radii in a tick: 32 m/s at 2 mm and 1 kHz.
 * HL_INVALID_VALUE: the object is not defined, it has no such vertices, a number is negative or not finite, `vertices`
 * is null. HL_INVALID_OPERATION: in a definition; `normals` for vertices that were drawn without. */
HL_API void hlUpdateVertices(HLuint object, HLint first, HLsizei count, const HLdouble* vertices,
                             const HLdouble* normals);
/** Another iso value for a surface of a volume in `object`, with the next hlFlush: `surface` counts from 0 those that
 * its definition drew by hlVolume and hlVolumeSurface. The samples stay where they are, and nothing is built: it may be
 * called in each frame. The proxy is moved out of the matter that comes over it. HL_INVALID_VALUE: the object is not
 * defined, it has no such surface, or `iso` is not finite. HL_INVALID_OPERATION: in a definition. */
HL_API void hlVolumeIso(HLuint object, HLint surface, HLdouble iso);
/** How `object` yields from the next hlFlush on, for programs that compute its deformation themselves: its mesh, as it
 * is then, was computed for `force`, N on the hand, x y z; under another force F its surface is displaced by C (force -
 * F). C: `normal` along the surface's normal and `tangential` along the surface, m of the world per newton, 0 .. 1e9.
 * The force is that of the whole object, and counts once however many of its faces are touched. NULL: the mean force of
 * the object in the report that hlTakeContactReport took last. Held until it is set again, or the object is deleted; to
 * be called with each frame that moves the mesh. C = 0: the mesh is what is felt. Without this call the server
 * estimates C for meshes that move. Too large a C is stable and settles slowly; below half of the true one the loop of
 * force and frames may flutter: docs/tissue.md. HL_INVALID_VALUE: the object is not defined, a number is out of its
 * range. HL_INVALID_OPERATION: in a definition. */
HL_API void hlCompliance(HLuint object, HLdouble normal, HLdouble tangential, const HLdouble* force);
/** HL_TRUE: this program has defined it (hlEndObject has been called) and not deleted it; the server need not have
 * taken it yet; when it refuses, it has not been defined, or deleted: see hlFlush. */
HL_API HLboolean hlIsObject(HLuint object);

/* ---- Bodies: each call of a body's object moves as a rigid body -------------------------------------------------- */

/** Makes the object that is being defined a rigid body, and sets one of its parameters (HL_BODY_MASS ..
 * HL_BODY_DYNAMIC_FRICTION, HL_BODY_RESTITUTION; unit, range and default there). Each call of the object is a body that
 * starts where the call's matrix places it, and goes on from where it is while that matrix and the call's place among
 * the calls of the object stay as they are: frames may draw it again and again. Drawn at another place or turn it is
 * there at once, and starts anew. A scale is part of its shape: with another one it goes on.
 * The definition draws one piece of geometry, all with the same matrix, surface and name, and calls no object; the
 * server refuses a frame with another one, or with a body that has no thickness (HL_REFUSED). Bodies need a server
 * with at most 8 devices. HL_INVALID_OPERATION: no definition is open. HL_INVALID_ENUM: not such a parameter.
 * HL_INVALID_VALUE: out of its range. */
HL_API void hlBodyf(HLenum parameter, HLfloat value);
HL_API void hlBodyd(HLenum parameter, HLdouble value); /**< see hlBodyf */
/** The same of HL_BODY_SHAPE (HL_BODY_HULL .. HL_BODY_PARTS) and HL_BODY_FIXED (HL_TRUE: what frames move, pushes
 * bodies, and only its surface counts). */
HL_API void hlBodyi(HLenum parameter, HLint value);
/** The same of HL_BODY_VELOCITY and HL_BODY_SPIN, with which it starts; world frame. */
HL_API void hlBody3d(HLenum parameter, HLdouble x, HLdouble y, HLdouble z);
/** The acceleration of all bodies of the server, m/s^2, from the frame on, at most 1000 along each axis; 0 -9.81 0 at
 * first. Of several clients the frame that was built last counts, until its client goes. HL_INVALID_OPERATION in a
 * definition. */
HL_API void hlGravity3d(HLdouble x, HLdouble y, HLdouble z);

/** Gives bodies of `object` an impulse, N s (at most 1e6 along each axis), at the point px py pz of the world, m,
 * evenly within `seconds` (0 .. 10; 0: at once), at a point fixed to the body. At once, not with the frame; of bodies
 * that are shown: after hlFinish, for one. With a current name (hlLoadName) it is those of the object that were called
 * with it; without, all. The server refuses it where there is none, and where more than 1024 wait: the loops take 4 in
 * each step of the servo (HL_REFUSED). Calls that come faster than 1000 a second go together, with a later call;
 * HL_BUSY: 4096 wait, and this one is not sent. HL_INVALID_VALUE: the object is not defined, a number is out of its
 * range. */
HL_API void hlBodyImpulsed(HLuint object, HLdouble ix, HLdouble iy, HLdouble iz, HLdouble px, HLdouble py, HLdouble pz,
                           HLdouble seconds);
/** Sets their velocity, m/s of the centre of mass (at most 100 along each axis), and spin, rad/s (at most 1000 about
 * each axis), world frame; else as hlBodyImpulsed. */
HL_API void hlBodyVelocityd(HLuint object, HLdouble vx, HLdouble vy, HLdouble vz, HLdouble wx, HLdouble wy,
                            HLdouble wz);
/** Places the object frame, m, turned by the quaternion qx qy qz qw (any length but 0), with the velocity that it has;
 * else as hlBodyImpulsed. What is in its way is pushed out afterwards. */
HL_API void hlBodyPlaced(HLuint object, HLdouble x, HLdouble y, HLdouble z, HLdouble qx, HLdouble qy, HLdouble qz,
                         HLdouble qw);

/** Writes up to `most` bodies of this context as the last state gives them, sorted by object and name, and returns how
 * many it wrote; HL_BODY_COUNT says how many there are. States hold them once a frame with a body has been flushed.
 * HL_INVALID_VALUE: most < 0. */
HL_API HLsizei hlGetBodies(HLsizei most, HLbody* bodies);
/** Writes what `name` says (HL_BODY_POSITION .. HL_BODY_MATRIX, HL_BODY_VELOCITY, HL_BODY_SPIN) of the first body of
 * `object` that was called with the current name; without a current name, with any. HL_TRUE: written. HL_FALSE, without
 * an error: the last state has no such body. HL_INVALID_ENUM: not such a name. */
HL_API HLboolean hlGetBodydv(HLuint object, HLenum name, HLdouble* values);

/* ---- Snaps: places that hold the proxy until it is pulled off: docs/snaps.md ------------------------------------ */

/** Gives the object that is being defined a point, x y z in metres of the definition, to which the proxy goes when it
 * comes as near as `capture`, m of the world (1e-9 .. 1e9, scaled by no matrix), and which lets go of it when it is
 * pulled by more than `release`, N at the hand (1e-9 .. 1e9). What would take it from farther away than it lets go,
 * takes it from there: so no capture and release gives energy. It moves with each call of the object, which needs no
 * geometry; of a body it also gets the hand's force. While it holds the proxy the scene is felt as ever.
 * HL_INVALID_OPERATION: no definition is open. HL_INVALID_VALUE: out of its range, farther than 1e6 m from the origin,
 * or more than 64 in the object; the server refuses a frame with more than 64 in the world (HL_REFUSED). */
HL_API void hlSnapPoint3d(HLdouble x, HLdouble y, HLdouble z, HLdouble capture, HLdouble release);
/** Leads the last snap of the definition on to x y z: a point becomes a line, a line a curve, of 256 points at most.
 * HL_INVALID_OPERATION: there is none, or it is a plane. HL_INVALID_VALUE: as hlSnapPoint3d, or one point too many. */
HL_API void hlSnapLineTo3d(HLdouble x, HLdouble y, HLdouble z);
/** As hlSnapPoint3d: the plane through x y z whose normal is nx ny nz, of any length but 0; it holds on both sides. */
HL_API void hlSnapPlane3d(HLdouble x, HLdouble y, HLdouble z, HLdouble nx, HLdouble ny, HLdouble nz, HLdouble capture,
                          HLdouble release);

/* ---- Fields: forces on the hand from places, whatever the proxy touches: docs/fields.md ------------------------- */

/** Gives the object that is being defined a field of the point x y z, metres of the definition. `reach`, m of the world
 * (1e-9 .. 1e9, scaled by no matrix): farther from the point there is no force. `kind` and `strength`:
 * HL_FIELD_MAGNET pulls to the point, at most with so many newtons (1e-9 .. 1000) at a third of the reach, with none at
 * the point and at the reach; HL_FIELD_SPRING pulls with so many newtons for each metre (.. 1e6); HL_FIELD_DRAG brakes
 * with so many newtons for each metre a second of the hand (.. 100). Four pulls act at once, the first of the scene.
 * The device's limits of force and its rate hold for all together. It moves with each call of the object, which needs
 * no geometry; what pulls the hand, pulls a body back. HL_INVALID_OPERATION: no definition is open. HL_INVALID_ENUM: no
 * such kind. HL_INVALID_VALUE: out of its range, farther than 1e6 m from the origin, or more than 64 in the object; the
 * server refuses a frame with more than 64 in the world (HL_REFUSED). */
HL_API void hlFieldPoint3d(HLenum kind, HLdouble x, HLdouble y, HLdouble z, HLdouble reach, HLdouble strength);
/** Leads the last field of the definition on to x y z: a point becomes a line, a line a curve, of 256 points at most.
 * HL_INVALID_OPERATION: there is none, or it is of a plane. HL_INVALID_VALUE: as hlFieldPoint3d, or one point too many.
 */
HL_API void hlFieldLineTo3d(HLdouble x, HLdouble y, HLdouble z);
/** As hlFieldPoint3d: of the plane through x y z whose normal is nx ny nz, of any length but 0; on both sides. */
HL_API void hlFieldPlane3d(HLenum kind, HLdouble x, HLdouble y, HLdouble z, HLdouble nx, HLdouble ny, HLdouble nz,
                           HLdouble reach, HLdouble strength);
/** As hlFieldPoint3d: a force fx fy fz (1e-9 .. 1000 N), in the axes of the definition, that falls to 0 at the reach of
 * the point. It may feed the hand energy: what goes through along it gains by it, and a way back beside it costs
 * nothing. hlFieldLineTo3d leads it on. */
HL_API void hlFieldForce3d(HLdouble x, HLdouble y, HLdouble z, HLdouble reach, HLdouble fx, HLdouble fy, HLdouble fz);

/* ---- Joints: what holds two bodies together, or one to the world --------------------------------------------------
 */

/** Sets a number of the joint that hlJoin makes next (HL_JOINT_LOW .. HL_JOINT_FRICTION; unit, range and default
 * there). HL_INVALID_ENUM: not such a parameter. HL_INVALID_VALUE: out of its range. HL_INVALID_OPERATION in a
 * definition. */
HL_API void hlJointf(HLenum parameter, HLfloat value);
HL_API void hlJointd(HLenum parameter, HLdouble value); /**< see hlJointf */
/** The same of HL_JOINT_KIND (HL_JOINT_BALL .. HL_JOINT_DISTANCE) and HL_JOINT_COLLIDE. */
HL_API void hlJointi(HLenum parameter, HLint value);
/** The same of HL_JOINT_ANCHOR, HL_JOINT_ANCHOR_B and HL_JOINT_AXIS. The modelview matrix of this moment takes them to
 * the world, as in GL the position of a light. */
HL_API void hlJoint3d(HLenum parameter, HLdouble x, HLdouble y, HLdouble z);
/** Its force table: `rows` (0 .. 256) increasing positions of the coordinate, m or rad, and the forces on body a there,
 * N or N m, linear in between and constant beyond; within 1e9. As buttons, detents and rocker switches have it. Copied.
 * HL_INVALID_VALUE: out of its range. HL_INVALID_OPERATION in a definition. */
HL_API void hlJointTable(HLsizei rows, const HLdouble* positions, const HLdouble* forces);
/** Draws the joint number `joint` (> 0) into the world: it joins the body of `object_a` that is called with the name
 * `name_a` (0: the only one) to that of `object_b` and `name_b`, or to the world where `object_b` is 0. What is a fixed
 * body counts as the world. Afterwards the parameters are those of the beginning again.
 * A joint is a part of the frame's world, as the calls of its bodies: frames draw it again, and while its number, kind
 * and bodies stay the same it goes on from where it is. Coordinates count from where the calls place the bodies.
 * The server refuses a frame with a joint whose bodies the world does not call (HL_REFUSED). HL_INVALID_VALUE: joint 0,
 * an object that is not defined, one body with itself, a number that this frame has joined already.
 * HL_INVALID_OPERATION in a definition; a hinge or slider without an axis; low above high; a ball or fixed joint with
 * numbers along a coordinate; a distance with HL_JOINT_HIGH of 0 or below. */
HL_API void hlJoin(HLuint joint, HLuint object_a, HLuint name_a, HLuint object_b, HLuint name_b);

/** Writes up to `most` joints of this context as the last state gives them, sorted by number, and returns how many it
 * wrote; HL_JOINT_COUNT says how many there are. HL_INVALID_VALUE: most < 0. */
HL_API HLsizei hlGetJoints(HLsizei most, HLjoint* joints);
/** Writes what `name` says (HL_JOINT_COORDINATE .. HL_JOINT_FORCE, HL_JOINT_HOLD) of a joint: a door's angle, how far a
 * button is pressed. HL_TRUE: written. HL_FALSE, without an error: the last state has no such joint. HL_INVALID_ENUM:
 * not such a name. */
HL_API HLboolean hlGetJointdv(HLuint joint, HLenum name, HLdouble* values);

/* ---- Names ---------------------------------------------------------------------------------------------------- */

/** What is drawn next is called `name` by contacts and events; 0: not named here (in a definition: as its caller says).
 */
HL_API void hlLoadName(HLuint name);
/** Saves the name and loads another. HL_STACK_OVERFLOW: HL_MAX_NAME_STACK_DEPTH is reached. */
HL_API void hlPushName(HLuint name);
/** Back to the name saved last. HL_STACK_UNDERFLOW: there is none. */
HL_API void hlPopName(void);

/* ---- Matrices ------------------------------------------------------------------------------------------------- */

/** Which stack the calls below work on: HL_MODELVIEW (at first) or HL_TEXTURE. */
HL_API void hlMatrixMode(HLenum mode);
/** Saves the matrix. HL_STACK_OVERFLOW: the stack is full (HL_MAX_MODELVIEW_STACK_DEPTH, HL_MAX_TEXTURE_STACK_DEPTH).
 */
HL_API void hlPushMatrix(void);
/** Back to the matrix saved last. HL_STACK_UNDERFLOW: there is none. */
HL_API void hlPopMatrix(void);
/** Replaces the matrix by the identity. */
HL_API void hlLoadIdentity(void);
/** Replaces the matrix by 16 numbers, column by column; the last row must be 0 0 0 1. HL_INVALID_VALUE: it is not; or
 * the modelview matrix would not be invertible: nothing can be touched of what has no extent. So also below. */
HL_API void hlLoadMatrixf(const HLfloat* m);
HL_API void hlLoadMatrixd(const HLdouble* m); /**< see hlLoadMatrixf */
/** matrix = matrix * m; see hlLoadMatrixf. */
HL_API void hlMultMatrixf(const HLfloat* m);
HL_API void hlMultMatrixd(const HLdouble* m); /**< see hlMultMatrixf */
/** matrix = matrix * a shift, m. */
HL_API void hlTranslatef(HLfloat x, HLfloat y, HLfloat z);
HL_API void hlTranslated(HLdouble x, HLdouble y, HLdouble z); /**< see hlTranslatef */
/** matrix = matrix * a turn by `degrees` about x y z, counterclockwise seen from its tip. HL_INVALID_VALUE: the axis is
 * 0. */
HL_API void hlRotatef(HLfloat degrees, HLfloat x, HLfloat y, HLfloat z);
HL_API void hlRotated(HLdouble degrees, HLdouble x, HLdouble y, HLdouble z); /**< see hlRotatef */
/** matrix = matrix * factors along the axes. */
HL_API void hlScalef(HLfloat x, HLfloat y, HLfloat z);
HL_API void hlScaled(HLdouble x, HLdouble y, HLdouble z); /**< see hlScalef */

/* ---- Surface -------------------------------------------------------------------------------------------------- */

/** Sets a quantity of the surface (HL_STIFFNESS .. HL_PRESLIDING, HL_ADHESION, HL_COMPLIANCE, HL_STRENGTH; unit, range
 * and default there) of what is drawn next. HL_INVALID_VALUE: out of its range. */
HL_API void hlMaterialf(HLenum quantity, HLfloat value);
HL_API void hlMateriald(HLenum quantity, HLdouble value); /**< see hlMaterialf */
/** HL_SMOOTH or HL_FLAT, for what is drawn next. */
HL_API void hlShadeModel(HLenum mode);

/** Writes `n` texture numbers (> 0) that are not in use. HL_INVALID_VALUE: n < 0. */
HL_API void hlGenTextures(HLsizei n, HLuint* textures);
/** Forgets textures; units that they are bound to get 0. What this frame has drawn with them feels untextured; what
 * earlier frames have, keeps them until it is drawn or defined anew. 0 and unknown numbers are ignored.
 * HL_INVALID_VALUE: n < 0. HL_INVALID_OPERATION in a definition. */
HL_API void hlDeleteTextures(HLsizei n, const HLuint* textures);
/** HL_TRUE: has been bound and not deleted. */
HL_API HLboolean hlIsTexture(HLuint texture);
/** Which unit hlBindTexture, hlTexEnv*, and hlEnable(HL_TEXTURE_2D) mean: HL_TEXTURE0 + i. Units let several quantities
 * be textured at once; they share the texture coordinates. Of two units with the same quantity the higher one counts.
 */
HL_API void hlActiveTexture(HLenum unit);
/** Binds a texture to the active unit; 0: none. `target` HL_TEXTURE_2D. */
HL_API void hlBindTexture(HLenum target, HLuint texture);
/** Gives the bound texture its image: `width` x `height` (1 .. HL_MAX_TEXTURE_SIZE) texels, close together, row by row,
 * the row of v = 0 first. `target` HL_TEXTURE_2D, `level` 0, `border` 0, `internal_format` and `format` HL_LUMINANCE,
 * `type` HL_UNSIGNED_BYTE or HL_FLOAT. NULL: texels of 0. Part of the frame. Copied. HL_INVALID_OPERATION: no texture
 * is bound. */
HL_API void hlTexImage2D(HLenum target, HLint level, HLint internal_format, HLsizei width, HLsizei height, HLint border,
                         HLenum format, HLenum type, const void* texels);
/** Gives a part of the bound texture's image other texels: those of the columns `x` .. `x + width - 1` and the rows `y`
 * .. `y + height - 1`; else as hlTexImage2D. NULL: nothing happens. HL_INVALID_VALUE: they are not all within the
 * image. HL_INVALID_OPERATION: no texture is bound, or it has no image. */
HL_API void hlTexSubImage2D(HLenum target, HLint level, HLint x, HLint y, HLsizei width, HLsizei height, HLenum format,
                            HLenum type, const void* texels);
/** Sets HL_TEXTURE_WRAP or HL_TEXTURE_FILTER of the bound texture. HL_INVALID_OPERATION: no texture is bound. */
HL_API void hlTexParameteri(HLenum target, HLenum parameter, HLint value);
/** Sets HL_TEXTURE_QUANTITY (to HL_STIFFNESS .. HL_VISCOSITY or HL_HEIGHT) of the active unit. `target` HL_TEXTURE_ENV.
 * Where the unit is enabled and its texture has an image, the quantity is low + (high - low) * texel, instead of
 * hlMaterial's. */
HL_API void hlTexEnvi(HLenum target, HLenum parameter, HLint value);
/** Sets HL_TEXTURE_LOW or HL_TEXTURE_HIGH of the active unit. HL_INVALID_VALUE: out of the quantity's range. */
HL_API void hlTexEnvf(HLenum target, HLenum parameter, HLfloat value);
HL_API void hlTexEnvd(HLenum target, HLenum parameter, HLdouble value); /**< see hlTexEnvf */

/** HL_TEXTURE_2D: the active unit takes part in what is drawn next. All are disabled at first. */
HL_API void hlEnable(HLenum capability);
/** HL_TEXTURE_2D: it takes no part. In a definition: with no unit left the caller's textures are kept off, too. */
HL_API void hlDisable(HLenum capability);
/** HL_TEXTURE_2D or an array of hlEnableClientState. */
HL_API HLboolean hlIsEnabled(HLenum capability);

/** Saves groups of the state (HL_..._BIT). HL_STACK_OVERFLOW: HL_MAX_ATTRIB_STACK_DEPTH is reached. */
HL_API void hlPushAttrib(HLbitfield mask);
/** Back to what was saved last. HL_STACK_UNDERFLOW: there is nothing. */
HL_API void hlPopAttrib(void);

/* ---- Proxy and device: at once, not with the frame. HL_INVALID_OPERATION unless HL_MASTER. ---------------------- */

/** HL_PROXY_RADIUS, m in the world, > 0. It holds for the first world, too, when it is set before; another workspace
 * later keeps the radius as it is at the hand. */
HL_API void hlProxyf(HLenum parameter, HLfloat value);
HL_API void hlProxyd(HLenum parameter, HLdouble value); /**< see hlProxyf */
/** The hand moves in the world by p = origin + world_per_device * p_hand, axes parallel; `world_per_device` > 0,
 * and servers refuse what is not within 1e-9 .. 1e9. Until this is called the server fits the first world that it
 * shows to the device. */
HL_API void hlWorkspaced(HLdouble x, HLdouble y, HLdouble z, HLdouble world_per_device);
/** K of the servo, N/m at the hand, > 0; the server clamps it to the device's range. */
HL_API void hlSpringd(HLdouble stiffness);
/** HL_LEDGER_TANK, HL_LEDGER_STRICT or HL_LEDGER_REPORT. */
HL_API void hlLedger(HLenum mode);
/** Leaves HL_SAFETY_FAULT; the force ramps up from zero. */
HL_API void hlRearm(void);
/** Simulated devices: where the hand wants to be, m in the world. */
HL_API void hlHandGoal3d(HLdouble x, HLdouble y, HLdouble z);
/** Simulated devices with a wrist: how the hand wants the stylus to be turned, a quaternion of any length but 0; 0 0 0
 * 1 has its shaft along +z. */
HL_API void hlHandTurn4d(HLdouble x, HLdouble y, HLdouble z, HLdouble w);
/** Simulated devices with a gripper: how far the hand wants it to be open, rad; the device clamps it to what there is.
 */
HL_API void hlHandGripperd(HLdouble angle);
/** Simulated devices: HL_GRIP_LIGHT or HL_GRIP_FIRM. */
HL_API void hlHandGrip(HLenum grip);

/* ---- Queries and events: from the last state taken; never wait --------------------------------------------------- */

/** Writes the values of `name` (hl_types.h says how many), converted as in GL: integers are rounded and clamped
 * (numbers and names of objects above 2^31 - 1 need hlGetDoublev), booleans are "not 0". HL_INVALID_ENUM: not a query.
 */
HL_API void hlGetBooleanv(HLenum name, HLboolean* values);
HL_API void hlGetIntegerv(HLenum name, HLint* values);   /**< see hlGetBooleanv */
HL_API void hlGetFloatv(HLenum name, HLfloat* values);   /**< see hlGetBooleanv */
HL_API void hlGetDoublev(HLenum name, HLdouble* values); /**< see hlGetBooleanv */
/** Writes up to `most` contacts of the last state, the one with the largest share first, and returns how many it wrote.
 * HL_INVALID_VALUE: most < 0. */
HL_API HLsizei hlGetContacts(HLsizei most, HLcontact* contacts);
/** Writes up to `most` hands of other servers of a shared world as the last state gives them, sorted by server, and
 * returns how many it wrote; HL_REMOTE_HAND_COUNT says how many there are. HL_INVALID_VALUE: most < 0. */
HL_API HLsizei hlGetRemoteHands(HLsizei most, HLremotehand* hands);
/** How often the state comes from now on, Hz, 0 .. HL_MAX_STATE_RATE; 0: never. Not only for the master. */
HL_API void hlStateRate(HLdouble rate);

/** From now on the states bring what the device did between them, each step of the servo, and the context keeps the
 * newest `most` of these samples; 0: none, as at first. Where states come seldom or are taken late some are left out:
 * the server has the last 1024, a second at 1 kHz. Not only for the master. HL_INVALID_VALUE: most < 0. */
HL_API void hlKeepSamples(HLsizei most);
/** Writes up to `most` of the samples that are kept, the oldest first, forgets those, and returns how many.
 * HL_INVALID_VALUE: most < 0. */
HL_API HLsizei hlTakeSamples(HLsizei most, HLsample* samples);

/** HL_TRUE: from now on the server reports with each state where and how strongly the hand has pressed since the state
 * before; HL_FALSE: no more, as at first. Where states come seldom, some is left out: the server has the last 1024
 * steps of the servo. Not only for the master. */
HL_API void hlKeepContactReport(HLboolean wanted);
/** Writes up to `most` of the places that were pressed since the last call, the strongest first, and returns how many;
 * of the rest nothing is kept. Forces are means over the time since the last call; `report` (may be NULL) has their
 * sum, with what acted without contact. A force F for the time `interval` is an impulse of F * interval. hlPoll,
 * hlFlush and hlFinish take what the server has sent. HL_INVALID_VALUE: most < 0, `contacts` is null and most > 0. */
HL_API HLsizei hlTakeContactReport(HLsizei most, HLcontactforce* contacts, HLcontactreport* report);

/** From now on hlPoll calls `callback` for events of `kind` (HL_EVENT_...). NULL: such events are dropped, as at first.
 */
HL_API void hlEventFunc(HLenum kind, HLeventfunc callback, void* user);
/** Takes what the server has sent, calls the callbacks on this thread, in the order in which the server noticed
 * them, and returns how many: the time of an HL_EVENT_UNTOUCH is 20 ms before that of what is noticed beside it. Sends
 * a frame that waits. To be called as often as the application draws: of events that are not polled only the last 1024
 * are kept. HL_INVALID_OPERATION in a callback. */
HL_API HLint hlPoll(void);

#ifdef __cplusplus
}
#endif

#endif
