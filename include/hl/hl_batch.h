/* HL in batches: many fingers, or many recorded paths, over one scene; without a server, a device or a clock. For
 * simulation, learning and analysis. C99 and C++. The library is libhlbatch.
 *
 * Results. Each finger has the same bits as if it were alone, whatever the number of threads and the hierarchy.
 *
 * Errors. A call that fails changes nothing but what its comment says, and returns an error that is not HL_NO_ERROR;
 * hlBatchError says why in one line. HL_INVALID_VALUE: an argument, or a number that is not finite. HL_OUT_OF_MEMORY.
 *
 * Threads. Calls are made by any thread. A scene may be used by several at once, fingers by one at a time. `threads`
 * is how many a call may use at once, 0: all that the machine has; no call uses more than those. No call holds a lock
 * while it computes.
 *
 * Arrays. Rows of numbers one after the other, C order. Metres, seconds, newtons, world frame. Fingers and points lie
 * within 1e15 m of the origin. */
#ifndef HL_HL_BATCH_H
#define HL_HL_BATCH_H

#include <hl/hl_types.h>
#include <stddef.h>
#include <stdint.h>

#ifndef HL_API
#define HL_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** Why the last call of this thread that failed did so; "" before the first. Valid until the next one that fails. */
HL_API const char* hlBatchError(void);

/* ---- Scenes ---------------------------------------------------------------------------------------------------- */

/** What can be touched; immutable. Where it has rigid bodies, each trace has them to itself, from where they start. */
typedef struct HLbatchScene HLbatchScene;

/** A model file, a scene file (*.hl.json) or a built-in scene by its name ("teapot", "terrain:100000"). `size`: metres
 * of its largest side, 0: as it is. NULL when that fails. Model files are parsed in a child process without rights. */
HL_API HLbatchScene* hlBatchLoadScene(const char* name, HLdouble size);
/** Triangles: `vertices` x 3 coordinates, and `triangles` x 3 indices. `normals`, one a vertex, are for smooth shading;
 * NULL: none. Degenerate triangles are left out. NULL when that fails. */
HL_API HLbatchScene* hlBatchMakeScene(const HLdouble* positions, const HLdouble* normals, size_t vertices,
                                      const HLuint* indices, size_t triangles);
/** A height field of `columns` x `rows` samples, row by row, of `type` HL_SHORT, HL_UNSIGNED_SHORT or HL_FLOAT. Columns
 * lead to +x, `spacing` x 0 m (1e-12 .. 1e9) apart, rows to +z, `spacing` x 1, with the middle at x = z = 0; heights
 * are y, `scale` m for a unit. Around samples that equal `*missing` (NULL: none), or are not a number, there are holes.
 * The samples are copied. NULL when that fails. */
HL_API HLbatchScene* hlBatchMakeHeights(size_t columns, size_t rows, HLenum type, const void* samples,
                                        const HLdouble* missing, const HLdouble* spacing, HLdouble scale);
/** The surfaces of a volume where its samples pass the values `iso` x 0 .. `surfaces` - 1. `size` x 0..2 samples along
 * x, y and z, those along x next to each other, of `type` HL_SHORT, HL_UNSIGNED_SHORT or HL_FLOAT, `spacing` x 0..2 m
 * (1e-12 .. 1e9) apart, with the middle of the volume at the origin. There is no surface around samples that equal
 * `*missing` (NULL: none), or are not a number. The samples are copied. NULL when that fails, also where a value has no
 * surface. */
HL_API HLbatchScene* hlBatchMakeVolume(const size_t* size, HLenum type, const void* samples, const HLdouble* missing,
                                       const HLdouble* spacing, size_t surfaces, const HLdouble* iso);
/** As hlBatchMakeVolume, with the matter where samples are below `iso`, as of signed distances. */
HL_API HLbatchScene* hlBatchMakeDistances(const size_t* size, HLenum type, const void* samples, const HLdouble* missing,
                                          const HLdouble* spacing, size_t surfaces, const HLdouble* iso);
/** A cloud of `count` points, x y z each, m. `normals`, one a point and of either sign, are for smooth shading; NULL:
 * those of the plane through the 12 nearest points. `reach` 0: the points alone are touched; 0.01 to 10: each is a
 * small hexagon across its normal around a disc of so many distances between neighbours. NULL when that fails. */
HL_API HLbatchScene* hlBatchMakePoints(const HLdouble* points, const HLdouble* normals, size_t count, HLdouble reach);
/** The surface of a solid that `json` writes down, as hlImplicit has it. NULL when that fails. */
HL_API HLbatchScene* hlBatchMakeImplicit(const char* json);
/** Fingers that were made with the scene keep it. NULL: nothing happens. */
HL_API void hlBatchDeleteScene(HLbatchScene* scene);
/** How many triangles, segments and points it has. */
HL_API size_t hlBatchScenePrimitives(const HLbatchScene* scene);
/** What was left out or changed when it was read or made, one line; valid as long as the scene. `number` from 0 on;
 * NULL from the last one on. */
HL_API const char* hlBatchSceneWarning(const HLbatchScene* scene, size_t number);
/** The box around it: 3 numbers each. Of an empty scene `low` is above `high`. */
HL_API void hlBatchSceneBounds(const HLbatchScene* scene, HLdouble* low, HLdouble* high);

/* ---- Settings -------------------------------------------------------------------------------------------------- */

/** Made by hlBatchSettings, then changed. */
typedef struct HLbatchSettings {
  HLdouble radius;      /**< m, 1e-12 to 1e9: of the proxy; at first 0.002 */
  HLdouble spring;      /**< N/m, 1e-9 to 1e9: force = spring (target - finger); at first 1000 */
  HLdouble period;      /**< s, 1e-15 to 1e15: between two steps of fingers; a trace has its path's. At first 0.001 */
  HLint smooth;         /**< HL_TRUE, HL_FALSE: smooth shading of all surfaces; -1, at first: as the scene says */
  HLdouble surface[16]; /**< by hlBatchSurface; negative, at first: as the scene says */
} HLbatchSettings;

/** Writes what a scene is felt with where nothing else is wanted. NULL: nothing happens. */
HL_API void hlBatchSettings(HLbatchSettings* settings);
/** Sets one quantity of all surfaces: HL_STIFFNESS, HL_STATIC_FRICTION, HL_DYNAMIC_FRICTION, HL_VISCOSITY, HL_STRIBECK,
 * HL_PRESLIDING, HL_ADHESION, HL_COMPLIANCE or HL_STRENGTH, in the units of hlMaterial. HL_INVALID_VALUE: out of range,
 * which is narrower than of hlMaterial: stiffness and compliance 0 .. 1, frictions 0 .. 10, viscosity 0 .. 1000,
 * adhesion and strength 0 .. 100, the others 0 .. 1e9. */
HL_API HLenum hlBatchSurface(HLbatchSettings* settings, HLenum quantity, HLdouble value);

/* ---- Results --------------------------------------------------------------------------------------------------- */

/** Where each row of a result goes: a finger, or a sample of a path. NULL: it is not wanted. */
typedef struct HLbatchResult {
  HLdouble* proxy;    /**< x 3, m: centre of the proxy */
  HLdouble* force;    /**< x 3, N: on the hand, of the spring and of fields */
  HLint* contacts;    /**< 0..3: planes that hold the proxy */
  HLdouble* injected; /**< J: what the tick added to the spring's energy; below 0: took away */
} HLbatchResult;

/* ---- Paths ----------------------------------------------------------------------------------------------------- */

/** Feels the scene along `paths` recorded paths, each by a finger of its own that begins at its first sample, as
 * hl trace does, with bodies of its own. `samples`: all samples x 4, t, x, y, z, path after path, t rising within each
 * by 1e-15 s at least, and within 1e15 s of 0; path i ends before sample ends[i]. */
HL_API HLenum hlBatchTrace(const HLbatchScene* scene, const HLbatchSettings* settings, size_t paths, const size_t* ends,
                           const HLdouble* samples, HLint threads, const HLbatchResult* result);

/* ---- Fingers --------------------------------------------------------------------------------------------------- */

/** Fingers that are stepped together, each with a proxy of its own. They do not feel each other. */
typedef struct HLbatchFingers HLbatchFingers;

/** NULL when that fails, also of a scene with bodies that move: each would be moved by all fingers at once. */
HL_API HLbatchFingers* hlBatchMakeFingers(const HLbatchScene* scene, const HLbatchSettings* settings, size_t fingers);
/** NULL: nothing happens. */
HL_API void hlBatchDeleteFingers(HLbatchFingers* fingers);
/** Each finger goes to its position (x 3) and its proxy follows: one tick. The first step, and the one after a reset,
 * begins a proxy where the finger is, or near it where the finger is within something. */
HL_API HLenum hlBatchStep(HLbatchFingers* fingers, const HLdouble* positions, HLint threads,
                          const HLbatchResult* result);
/** Those with a mask other than 0 begin anew with their next step; NULL: all. */
HL_API void hlBatchResetFingers(HLbatchFingers* fingers, const unsigned char* mask);

/* ---- Closest points -------------------------------------------------------------------------------------------- */

/** Of each of `count` points (x 3) the nearest point of the scene, at any distance. Each output may be NULL: `nearest`
 * x 3, m; `distance`, m; `normal` x 3, unit, from the surface to the point; `primitive`, its number in the model: the
 * row of hlBatchMakeScene's triangles; of a file first the triangles, then the segments, then the points. Degenerate
 * ones have their numbers there, but cannot be touched and are never the nearest. Bodies are where they start, and
 * count after what stays. Heights, volumes, clouds and implicit surfaces number what they make in their own order, with
 * gaps: these are no rows of the file. */
HL_API HLenum hlBatchClosest(const HLbatchScene* scene, size_t count, const HLdouble* points, HLint threads,
                             HLdouble* nearest, HLdouble* distance, HLdouble* normal, uint64_t* primitive);

#ifdef __cplusplus
}
#endif

#endif /* HL_HL_BATCH_H */
