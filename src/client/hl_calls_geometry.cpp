// hlBegin .. hlEnd and vertex arrays.
#include <hl/hl.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <utility>

#include "base/error.h"
#include "client/call.h"
#include "client/elements.h"
#include "client/patch_arguments.h"
#include "wire/implicit_json.h"

using hl::client::call;
using hl::client::Fault;
using hl::client::requireCount;
using hl::client::requireFinite;
using hl::client::requireList;
using hl::client::requirePointer;
using hl::client::When;

namespace {

void begin(HLcontext& context, HLenum mode) {
  context.recorder.begin(mode, context.draw.texture, hasTextures(context.draw.attributes.now));
}

// Draws what has been recorded, in the order given or one after the other. What draws nothing leaves the world as it
// is.
void draw(HLcontext& context, hl::client::DrawOrder order) {
  const HLenum mode = context.recorder.mode();
  hl::client::Vertices& vertices = context.recorder.end();
  if (order.empty() && hl::client::wholeVertices(mode, vertices.size()) == 0) return;
  context.target().draw(context.draw.modelview.top(), lookOf(context.draw.attributes.now), mode, vertices, order);
}

void end(HLcontext& context) { draw(context, {}); }

// The texture matrix, as factors of u and v: the server knows the coordinates of a grid, and no more is said of them.
std::array<double, 2> repeatOf(const HLcontext& context) {
  const hl::client::Matrix4& matrix = context.draw.texture.top();
  hl::client::Matrix4 factors = hl::client::Matrix4::Identity();
  factors(0, 0) = matrix(0, 0);
  factors(1, 1) = matrix(1, 1);
  factors(2, 2) = matrix(2, 2);
  if (matrix == factors) return {matrix(0, 0), matrix(1, 1)};
  if (!hasTextures(context.draw.attributes.now)) return {1, 1};
  throw Fault(HL_INVALID_OPERATION, "over heights and depths the texture matrix may scale, and neither turn nor move");
}

void drawHeights(HLcontext& context, hl::proto::Heights heights) {
  const std::array<double, 2> repeat = repeatOf(context);
  context.target().drawHeights(context.draw.modelview.top(), lookOf(context.draw.attributes.now), std::move(heights),
                               repeat);
}

// Almost every vertex takes the short way.
void vertex(const char* function, double x, double y, double z) {
  HLcontext* now = hl::client::currentContext();
  if (now != nullptr && now->recorder.vertexInRoom(now->draw.attributes.now.vertex, x, y, z)) return;
  call(function, When::kAlways,
       [&](HLcontext& context) { context.recorder.vertex(context.draw.attributes.now.vertex, x, y, z); });
}

void normal(const char* function, double x, double y, double z) {
  call(function, When::kAlways, [&](HLcontext& context) {
    requireFinite(x, y, z);
    context.draw.attributes.now.vertex.setNormal({x, y, z});
  });
}

void texCoord(const char* function, double u, double v) {
  call(function, When::kAlways, [&](HLcontext& context) {
    requireFinite(u, v);
    context.draw.attributes.now.vertex.setTexcoord({u, v});
  });
}

// Reads `count` numbers of the application's and hands them to `body`; a null pointer is the context's error.
template <std::size_t Count, typename Number, typename Body>
void withNumbers(const char* function, const Number* numbers, Body body) {
  if (numbers == nullptr) {
    call(function, When::kAlways, [](HLcontext&) { requirePointer(nullptr); });
    return;
  }
  std::array<double, 3> read{};
  for (std::size_t i = 0; i < Count; ++i) read[i] = double{numbers[i]};
  body(read);
}

template <std::size_t Count, typename Number>
void vertexAt(const char* function, const Number* v) {
  withNumbers<Count>(function, v, [&](const auto& p) { vertex(function, p[0], p[1], p[2]); });
}

template <typename Number>
void normalAt(const char* function, const Number* v) {
  withNumbers<3>(function, v, [&](const auto& n) { normal(function, n[0], n[1], n[2]); });
}

template <typename Number>
void texCoordAt(const char* function, const Number* v) {
  withNumbers<2>(function, v, [&](const auto& uv) { texCoord(function, uv[0], uv[1]); });
}

// Draws the vertices index(0) .. index(count - 1) of the arrays in that order, or, at an error, none.
template <typename IndexOf>
void drawArrays(HLcontext& context, HLenum mode, std::size_t count, IndexOf index, hl::client::DrawOrder order) {
  context.arrays.requirePointers();
  begin(context, mode);
  try {
    for (std::size_t i = 0; i < count; ++i)
      context.arrays.draw(context.recorder, context.draw.attributes.now.vertex, index(i));
  } catch (...) {
    context.recorder.cancel();
    throw;
  }
  draw(context, order);
}

std::size_t sampleBytesOf(HLenum type) {
  if (type == HL_FLOAT) return sizeof(HLfloat);
  if (type == HL_SHORT || type == HL_UNSIGNED_SHORT) return sizeof(HLshort);
  throw Fault(HL_INVALID_ENUM, "samples are HL_SHORT, HL_UNSIGNED_SHORT or HL_FLOAT");
}

/// The samples of a grid with these sides, which are copied.
template <typename Grid>
void setSamples(Grid& grid, std::initializer_list<HLsizei> sides, HLenum type, const void* samples,
                const HLdouble* missing) {
  std::size_t bytes = sampleBytesOf(type);
  for (const HLsizei side : sides) {
    if (side < 2) throw Fault(HL_INVALID_VALUE, "there must be two samples or more along each axis");
  }
  requirePointer(samples);
  if (missing != nullptr) requireFinite(*missing);
  constexpr std::size_t kMax = std::size_t{1} << 30;  // a message has less than 2 GiB
  for (const HLsizei side : sides) {
    if (static_cast<std::size_t>(side) >= kMax / bytes)
      throw Fault(HL_OUT_OF_MEMORY, "the samples must be less than 1 GiB");
    bytes *= static_cast<std::size_t>(side);
  }
  grid.set_kind(type == HL_SHORT ? "int16" : type == HL_UNSIGNED_SHORT ? "uint16" : "float32");
  grid.add_samples(samples, bytes);
  if (missing != nullptr) grid.set_missing(*missing);
}

}  // namespace

void hlBegin(HLenum mode) {
  call(__func__, [&](HLcontext& context) { begin(context, mode); });
}

void hlEnd(void) { call(__func__, When::kBetween, end); }

void hlVertex2f(HLfloat x, HLfloat y) { vertex(__func__, x, y, 0); }
void hlVertex2d(HLdouble x, HLdouble y) { vertex(__func__, x, y, 0); }
void hlVertex3f(HLfloat x, HLfloat y, HLfloat z) { vertex(__func__, x, y, z); }
void hlVertex3d(HLdouble x, HLdouble y, HLdouble z) { vertex(__func__, x, y, z); }
void hlVertex2fv(const HLfloat* v) { vertexAt<2>(__func__, v); }
void hlVertex2dv(const HLdouble* v) { vertexAt<2>(__func__, v); }
void hlVertex3fv(const HLfloat* v) { vertexAt<3>(__func__, v); }
void hlVertex3dv(const HLdouble* v) { vertexAt<3>(__func__, v); }

void hlNormal3f(HLfloat x, HLfloat y, HLfloat z) { normal(__func__, x, y, z); }
void hlNormal3d(HLdouble x, HLdouble y, HLdouble z) { normal(__func__, x, y, z); }
void hlNormal3fv(const HLfloat* v) { normalAt(__func__, v); }
void hlNormal3dv(const HLdouble* v) { normalAt(__func__, v); }

void hlTexCoord2f(HLfloat u, HLfloat v) { texCoord(__func__, u, v); }
void hlTexCoord2d(HLdouble u, HLdouble v) { texCoord(__func__, u, v); }
void hlTexCoord2fv(const HLfloat* v) { texCoordAt(__func__, v); }
void hlTexCoord2dv(const HLdouble* v) { texCoordAt(__func__, v); }

void hlVertexPointer(HLint size, HLenum type, HLsizei stride, const void* pointer) {
  call(__func__, [&](HLcontext& context) {
    if (size != 2 && size != 3) throw Fault(HL_INVALID_VALUE, "vertices have 2 or 3 numbers");
    context.arrays.vertices.point(size, type, stride, pointer);
  });
}

void hlNormalPointer(HLenum type, HLsizei stride, const void* pointer) {
  call(__func__, [&](HLcontext& context) { context.arrays.normals.point(3, type, stride, pointer); });
}

void hlTexCoordPointer(HLint size, HLenum type, HLsizei stride, const void* pointer) {
  call(__func__, [&](HLcontext& context) {
    if (size != 2) throw Fault(HL_INVALID_VALUE, "texture coordinates have 2 numbers");
    context.arrays.texcoords.point(size, type, stride, pointer);
  });
}

void hlEnableClientState(HLenum array) {
  call(__func__, [&](HLcontext& context) { context.arrays.named(array).enabled = true; });
}

void hlDisableClientState(HLenum array) {
  call(__func__, [&](HLcontext& context) { context.arrays.named(array).enabled = false; });
}

void hlDrawArrays(HLenum mode, HLint first, HLsizei count) {
  call(__func__, [&](HLcontext& context) {
    hl::client::requirePrimitiveMode(mode);
    requireCount(count);
    if (first < 0) throw Fault(HL_INVALID_VALUE, "the first vertex must not be negative");
    if (!context.arrays.vertices.enabled) return;
    const auto index = [&](std::size_t i) { return static_cast<std::size_t>(first) + i; };
    drawArrays(context, mode, static_cast<std::size_t>(count), index, {});
  });
}

void hlHeightField(HLsizei columns, HLsizei rows, HLenum type, const void* samples, const HLdouble* missing) {
  call(__func__, [&](HLcontext& context) {
    hl::proto::Heights heights;
    setSamples(heights, {columns, rows}, type, samples, missing);
    heights.set_columns(static_cast<std::uint32_t>(columns));
    heights.set_rows(static_cast<std::uint32_t>(rows));
    drawHeights(context, std::move(heights));
  });
}

void hlDepthFrame(HLsizei width, HLsizei height, const HLushort* depths, const HLdouble* camera, HLdouble scale,
                  HLdouble join, HLdouble smoothing) {
  constexpr double kMin = 1e-12, kMax = 1e9;
  call(__func__, [&](HLcontext& context) {
    if (camera == nullptr) throw Fault(HL_INVALID_VALUE, "there is no camera");
    if (!(camera[0] > 0 && camera[1] > 0)) throw Fault(HL_INVALID_VALUE, "the focal lengths must be above 0");
    if (!(scale >= kMin && scale <= kMax)) throw Fault(HL_INVALID_VALUE, "the scale must be from 1e-12 to 1e9 m");
    if (!(join >= 0 && join <= 1)) throw Fault(HL_INVALID_VALUE, "join must be from 0 to 1");
    if (!(smoothing >= 0 && smoothing < 1)) throw Fault(HL_INVALID_VALUE, "smoothing must be from 0 to less than 1");
    hl::proto::Heights heights;
    setSamples(heights, {width, height}, HL_UNSIGNED_SHORT, depths, nullptr);
    heights.set_columns(static_cast<std::uint32_t>(width));
    heights.set_rows(static_cast<std::uint32_t>(height));
    heights.set_vertical_scale(scale);
    for (int i = 0; i < 4; ++i) {
      requireFinite(camera[i]);
      heights.add_camera(camera[i]);
    }
    heights.set_join(join);
    heights.set_smoothing(smoothing);
    drawHeights(context, std::move(heights));
  });
}

void hlVolume(HLsizei width, HLsizei height, HLsizei depth, HLenum type, const void* samples, const HLdouble* missing,
              HLdouble iso) {
  call(__func__, [&](HLcontext& context) {
    requireFinite(iso);
    const auto volume = std::make_shared<hl::proto::Volume>();
    setSamples(*volume, {width, height, depth}, type, samples, missing);
    for (const HLsizei side : {width, height, depth}) volume->add_size(static_cast<std::uint32_t>(side));
    *volume->mutable_matter() = context.matter.matter();
    context.target().drawVolume(context.draw.modelview.top(), lookOf(context.draw.attributes.now), volume, iso,
                                context.solid_below);
  });
}

void hlVolumeMatter(HLsizei rows, const HLdouble* numbers) {
  constexpr HLsizei kMaxRows = 256;
  constexpr double kMax = 1e9;
  call(__func__, [&](HLcontext& context) {
    if (rows < 0 || rows > kMaxRows) throw Fault(HL_INVALID_VALUE, "matter has 0 to 256 rows");
    if (rows > 0 && numbers == nullptr) throw Fault(HL_INVALID_VALUE, "there are no numbers");
    hl::proto::Volume made;
    for (HLsizei i = 0; i < rows; ++i) {
      const HLdouble* const row = numbers + std::ptrdiff_t{3} * i;
      const bool rises = i == 0 || row[0] > row[-3];
      const auto fits = [](double number) { return number >= 0 && number <= kMax; };
      if (!std::isfinite(row[0]) || !rises || !fits(row[1]) || !fits(row[2]))
        throw Fault(HL_INVALID_VALUE, "the values must rise, and the resistances and drags be from 0 to 1e9");
      hl::proto::Matter& out = *made.add_matter();
      out.set_value(row[0]);
      out.set_resistance_n(row[1]);
      out.set_drag_ns_m(row[2]);
    }
    context.matter = std::move(made);
  });
}

void hlVolumeSolid(HLenum side) {
  call(__func__, [&](HLcontext& context) {
    if (side != HL_ABOVE && side != HL_BELOW) throw Fault(HL_INVALID_ENUM, "the side must be HL_ABOVE or HL_BELOW");
    context.solid_below = side == HL_BELOW;
  });
}

void hlVolumeSurface(HLdouble iso) {
  call(__func__, [&](HLcontext& context) {
    requireFinite(iso);
    auto volume = context.target().lastVolume();
    if (!volume) throw Fault(HL_INVALID_OPERATION, "no volume was drawn before, whose surface it could be");
    context.target().drawVolume(context.draw.modelview.top(), lookOf(context.draw.attributes.now), std::move(volume),
                                iso, context.solid_below);
  });
}

void hlNurbsSurface(HLsizei u_knot_count, const HLdouble* u_knots, HLsizei v_knot_count, const HLdouble* v_knots,
                    HLint u_stride, HLint v_stride, const HLdouble* points, HLint u_order, HLint v_order, HLenum type,
                    HLdouble error) {
  call(__func__, [&](HLcontext& context) {
    if (!(error == 0 || (error >= 1e-9 && error <= 1e9)))
      throw Fault(HL_INVALID_VALUE, "the error must be 1e-9 .. 1e9");
    const hl::client::SurfaceSide u{u_knot_count, u_knots, u_stride, u_order};
    const hl::client::SurfaceSide v{v_knot_count, v_knots, v_stride, v_order};
    hl::proto::Patch patch = hl::client::patchOf(u, v, points, type);
    context.target().drawPatch(context.draw.modelview.top(), lookOf(context.draw.attributes.now), std::move(patch),
                               error);
  });
}

void hlPointCloud(HLsizei count, const HLdouble* points, const HLdouble* normals, HLdouble reach) {
  call(__func__, [&](HLcontext& context) {
    constexpr std::size_t kMaxPoints = (std::size_t{1} << 30) / 36;  // 1 GiB of positions and normals
    constexpr double kMinReach = 0.01, kMaxReach = 10;
    if (count < 1) throw Fault(HL_INVALID_VALUE, "a cloud needs a point or more");
    requirePointer(points);
    if (reach != 0 && !(reach >= kMinReach && reach <= kMaxReach))
      throw Fault(HL_INVALID_VALUE, "the reach of surfels is 0.01 to 10 times the spacing of the points, or 0: points");
    const std::size_t numbers = 3 * static_cast<std::size_t>(count);
    if (numbers >= 3 * kMaxPoints) throw Fault(HL_OUT_OF_MEMORY, "the points must be less than 1 GiB");
    for (std::size_t i = 0; i < numbers; ++i) requireFinite(points[i], normals != nullptr ? normals[i] : 0);
    const auto cloud = std::make_shared<hl::proto::Cloud>();
    cloud->mutable_positions()->Add(points, points + numbers);
    if (normals != nullptr) cloud->mutable_normals()->Add(normals, normals + numbers);
    cloud->set_surfels(reach != 0);
    cloud->set_reach(reach);
    context.target().drawCloud(context.draw.modelview.top(), lookOf(context.draw.attributes.now), cloud);
  });
}

void hlPointColors(HLsizei count, const HLubyte* colors) {
  call(__func__, [&](HLcontext& context) {
    requireCount(count);
    requirePointer(colors);
    hl::proto::Cloud* const cloud = context.target().lastCloud();
    if (cloud == nullptr) throw Fault(HL_INVALID_OPERATION, "no cloud was drawn whose points could have colours");
    const std::ptrdiff_t numbers = 3 * std::ptrdiff_t{count};
    if (numbers != cloud->positions_size())
      throw Fault(HL_INVALID_VALUE, "there must be as many colours as the cloud that was drawn last has points");
    cloud->clear_colours();
    cloud->mutable_colours()->Add(colors, colors + numbers);
  });
}

void hlImplicit(const char* json) {
  call(__func__, [&](HLcontext& context) {
    requirePointer(json);
    auto implicit = std::make_shared<hl::proto::Implicit>();
    try {
      *implicit = hl::implicitOfJson(json);
    } catch (const hl::Error& error) {
      throw Fault(HL_INVALID_VALUE, error.what());
    }
    context.target().drawImplicit(context.draw.modelview.top(), lookOf(context.draw.attributes.now), implicit);
  });
}

void hlDrawElements(HLenum mode, HLsizei count, HLenum type, const void* indices) {
  call(__func__, [&](HLcontext& context) {
    hl::client::requirePrimitiveMode(mode);
    hl::client::requireIndexType(type);
    requireList(count, indices);
    if (!context.arrays.vertices.enabled) return;
    const std::size_t whole = hl::client::wholeVertices(mode, static_cast<std::size_t>(count));
    const hl::client::Elements elements = hl::client::elementsOf({type, indices}, whole);
    const auto index = [&](std::size_t i) { return elements.vertices[i]; };
    drawArrays(context, mode, elements.vertices.size(), index, elements.order);
  });
}
