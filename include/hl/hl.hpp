// hl.hpp: scopes and spans over the calls of hl.h, for C++20. Header-only; hl.h says what the calls mean, and both can
// be mixed freely.
//
// Errors stay as in C: sticky, until check() throws the kept one. Besides check() these throw: Context's constructor
// (CallError), Context::poll() (what a callback has thrown), and the functions on spans (std::invalid_argument, when
// their sizes do not fit). Scopes and destructors never throw. A scope must end on the thread and with the context that
// it began with.
#pragma once

#include <hl/hl.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <ranges>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace hl {
// Inline, so that the names are hl::Context .. and yet meet no class inside the library.
inline namespace calls {

/// An error of the calls. what() is its one line.
class CallError : public std::runtime_error {
 public:
  CallError(HLenum code, const std::string& text) : std::runtime_error(text), code_(code) {}
  /// HL_INVALID_ENUM .. ; HL_NO_CONTEXT when a context could not be created.
  HLenum code() const noexcept { return code_; }

 private:
  HLenum code_;
};

/// Throws CallError when the current context (or, without one, the thread) keeps an error, which it then forgets.
inline void check() {
  const HLenum code = hlGetError();
  if (code == HL_NO_ERROR) return;
  if (hlGetCurrentContext() == nullptr) throw CallError(code, "an HL call without a current context");
  throw CallError(code, hlGetString(HL_ERROR_STRING));
}

/// A conversation with a server. Movable; destroyed at the latest before the thread that it is current on ends, and not
/// by a function given to onEvent().
class Context {
 public:
  using EventFunction = std::function<void(const HLevent&)>;

  /// hlCreateContext and hlMakeCurrent. Throws CallError with the reason.
  explicit Context(const std::string& url = "inproc:") : context_(hlCreateContext(url.c_str())) {
    if (!context_) throw CallError(HL_NO_CONTEXT, hlGetConnectError());
    makeCurrent();
  }

  /// hlMakeCurrent. Throws CallError when it is current on another thread.
  void makeCurrent() {
    if (hlMakeCurrent(context_.get()) == HL_FALSE) check();
  }
  /// For the calls that take a context.
  HLcontext* get() const noexcept { return context_.get(); }

  /// From now on poll() calls `function` for events of `kind`; an empty one: such events are dropped. The context must
  /// be current.
  void onEvent(HLenum kind, EventFunction function) {
    if (kind < HL_EVENT_TOUCH || kind > HL_EVENT_IMPACT) {
      hlEventFunc(kind, nullptr, nullptr);  // leaves HL_INVALID_ENUM
      return;
    }
    const bool any = static_cast<bool>(function);
    events_->functions[kind - HL_EVENT_TOUCH] = std::move(function);
    hlEventFunc(kind, any ? &Events::call : nullptr, events_.get());
  }
  /// hlPoll. Throws what a callback has thrown, when all callbacks have run. The context must be current.
  int poll() {
    const int delivered = hlPoll();
    if (events_->thrown) std::rethrow_exception(std::exchange(events_->thrown, nullptr));
    return delivered;
  }

 private:
  // Stays where it is when the Context moves: the calls know its address.
  struct Events {
    std::array<EventFunction, 7> functions;
    std::exception_ptr thrown;

    // No exception may pass through C; the first one waits for poll().
    static void call(const HLevent* event, void* user) {
      auto& events = *static_cast<Events*>(user);
      try {
        const EventFunction function = events.functions[event->kind - HL_EVENT_TOUCH];
        if (function) function(*event);
      } catch (...) {
        if (!events.thrown) events.thrown = std::current_exception();
      }
    }
  };
  struct Destroy {
    void operator()(HLcontext* context) const noexcept { hlDestroyContext(context); }
  };

  std::unique_ptr<Events> events_ = std::make_unique<Events>();
  std::unique_ptr<HLcontext, Destroy> context_;
};

/// What begins with one call and ends with another at the end of a block.
template <void (*Finish)()>
class Scope {
 public:
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;
  ~Scope() { Finish(); }

 protected:
  Scope() = default;
};

/// hlBegin(mode) .. hlEnd().
struct [[nodiscard]] PrimitiveScope : Scope<hlEnd> {
  explicit PrimitiveScope(HLenum mode) { hlBegin(mode); }
};

/// hlNewObject(object) .. hlEndObject(); hlCancelObject() when an exception leaves it.
class [[nodiscard]] ObjectScope {
 public:
  explicit ObjectScope(HLuint object) { hlNewObject(object); }
  ObjectScope(const ObjectScope&) = delete;
  ObjectScope& operator=(const ObjectScope&) = delete;
  ~ObjectScope() { std::uncaught_exceptions() > exceptions_ ? hlCancelObject() : hlEndObject(); }

 private:
  int exceptions_ = std::uncaught_exceptions();
};

/// hlPushMatrix() .. hlPopMatrix(), on the stack that is chosen then; choose another one inside only in pairs.
struct [[nodiscard]] MatrixScope : Scope<hlPopMatrix> {
  MatrixScope() { hlPushMatrix(); }
};

/// hlPushAttrib(mask) .. hlPopAttrib().
struct [[nodiscard]] AttribScope : Scope<hlPopAttrib> {
  explicit AttribScope(HLbitfield mask = HL_ALL_ATTRIB_BITS) { hlPushAttrib(mask); }
};

/// hlPushName(name) .. hlPopName().
struct [[nodiscard]] NameScope : Scope<hlPopName> {
  explicit NameScope(HLuint name) { hlPushName(name); }
};

/// The number of a new object (hlGenObjects); 0 at an error.
inline HLuint genObject() {
  HLuint object = 0;
  hlGenObjects(1, &object);
  return object;
}

/// The number of a new texture (hlGenTextures); 0 at an error.
inline HLuint genTexture() {
  HLuint texture = 0;
  hlGenTextures(1, &texture);
  return texture;
}

/// Numbers that arrays are made of: float or double.
template <typename Number>
concept ArrayNumber = std::is_same_v<Number, HLfloat> || std::is_same_v<Number, HLdouble>;

/// Numbers that indices are made of.
template <typename Number>
concept ArrayIndex =
    std::is_same_v<Number, HLubyte> || std::is_same_v<Number, HLushort> || std::is_same_v<Number, HLuint>;

/// Vertices in the application's memory, close together. Normals and texture coordinates may be left out: then the
/// current ones hold for all.
template <ArrayNumber Number>
struct VertexArrays {
  std::span<const Number> vertices;        ///< x y z each, m
  std::span<const Number> normals = {};    ///< x y z for each vertex
  std::span<const Number> texcoords = {};  ///< u v for each vertex

  std::size_t size() const noexcept { return vertices.size() / 3; }
};

namespace detail {

// A number of elements, for the calls.
inline HLsizei sizeOf(std::size_t count) {
  if (count > static_cast<std::size_t>(std::numeric_limits<HLsizei>::max()))
    throw std::invalid_argument("there must be fewer than 2^31 of each");
  return static_cast<HLsizei>(count);
}

}  // namespace detail

/// hlUpdateVertices, x y z each. Throws std::invalid_argument when the sizes do not fit.
inline void updateVertices(HLuint object, HLint first, std::span<const HLdouble> vertices,
                           std::span<const HLdouble> normals = {}) {
  if (vertices.size() % 3 != 0) throw std::invalid_argument("vertices must hold 3 numbers each");
  if (!normals.empty() && normals.size() != vertices.size())
    throw std::invalid_argument("normals must hold 3 numbers for each vertex");
  hlUpdateVertices(object, first, detail::sizeOf(vertices.size() / 3), vertices.data(),
                   normals.empty() ? nullptr : normals.data());
}

/// Inside, while a function on spans draws.
namespace detail {

// Points the calls at the arrays, and away from them at the end, so that no pointer outlives its memory.
template <typename Number>
class ArrayScope {
 public:
  explicit ArrayScope(const VertexArrays<Number>& arrays) {
    if (arrays.vertices.size() % 3 != 0) throw std::invalid_argument("vertices must hold 3 numbers each");
    if (!arrays.normals.empty() && arrays.normals.size() != 3 * arrays.size())
      throw std::invalid_argument("normals must hold 3 numbers for each vertex");
    if (!arrays.texcoords.empty() && arrays.texcoords.size() != 2 * arrays.size())
      throw std::invalid_argument("texcoords must hold 2 numbers for each vertex");
    constexpr HLenum type = std::is_same_v<Number, HLfloat> ? HL_FLOAT : HL_DOUBLE;
    hlVertexPointer(3, type, 0, arrays.vertices.data());
    hlNormalPointer(type, 0, arrays.normals.data());
    hlTexCoordPointer(2, type, 0, arrays.texcoords.data());
    set(HL_VERTEX_ARRAY, !arrays.vertices.empty());
    set(HL_NORMAL_ARRAY, !arrays.normals.empty());
    set(HL_TEXTURE_COORD_ARRAY, !arrays.texcoords.empty());
  }
  ArrayScope(const ArrayScope&) = delete;
  ArrayScope& operator=(const ArrayScope&) = delete;
  ~ArrayScope() {
    for (const HLenum array : {HL_VERTEX_ARRAY, HL_NORMAL_ARRAY, HL_TEXTURE_COORD_ARRAY}) set(array, false);
    hlVertexPointer(3, HL_DOUBLE, 0, nullptr);
    hlNormalPointer(HL_DOUBLE, 0, nullptr);
    hlTexCoordPointer(2, HL_DOUBLE, 0, nullptr);
  }

 private:
  static void set(HLenum array, bool enabled) { enabled ? hlEnableClientState(array) : hlDisableClientState(array); }
};

}  // namespace detail

/// hlDrawArrays of all the vertices. Afterwards the calls have no arrays, and all of them are disabled.
template <ArrayNumber Number>
void drawArrays(HLenum mode, const VertexArrays<Number>& arrays) {
  const detail::ArrayScope<Number> scope(arrays);
  hlDrawArrays(mode, 0, detail::sizeOf(arrays.size()));
}

/// hlDrawElements with all of `indices` (a vector, an array, a span), each below the number of vertices. Afterwards as
/// drawArrays.
template <ArrayNumber Number, std::ranges::contiguous_range Indices>
requires ArrayIndex<std::ranges::range_value_t<Indices>>
void drawElements(HLenum mode, const VertexArrays<Number>& arrays, const Indices& indices) {
  using Index = std::ranges::range_value_t<Indices>;
  if (std::ranges::any_of(indices, [&](Index index) { return index >= arrays.size(); }))
    throw std::invalid_argument("an index must be below the number of vertices");
  constexpr HLenum type = sizeof(Index) == sizeof(HLubyte)    ? HL_UNSIGNED_BYTE
                          : sizeof(Index) == sizeof(HLushort) ? HL_UNSIGNED_SHORT
                                                              : HL_UNSIGNED_INT;
  const detail::ArrayScope<Number> scope(arrays);
  hlDrawElements(mode, detail::sizeOf(std::ranges::size(indices)), type, std::ranges::data(indices));
}

/// Numbers that heights and volumes are made of.
template <typename Number>
concept SampleNumber = std::same_as<Number, HLshort> || std::same_as<Number, HLushort> || std::same_as<Number, HLfloat>;

namespace detail {

// Their type in the calls.
template <SampleNumber Number>
inline constexpr HLenum kSampleType = std::same_as<Number, HLshort>    ? HL_SHORT
                                      : std::same_as<Number, HLushort> ? HL_UNSIGNED_SHORT
                                                                       : HL_FLOAT;

}  // namespace detail

/// hlHeightField of rows of `columns` samples each (a vector, an array, a span).
template <std::ranges::contiguous_range Samples>
requires SampleNumber<std::ranges::range_value_t<Samples>>
void heightField(std::size_t columns, const Samples& samples, std::optional<HLdouble> missing = {}) {
  using Number = std::ranges::range_value_t<Samples>;
  const std::size_t count = std::ranges::size(samples);
  if (columns == 0 || count % columns != 0)
    throw std::invalid_argument("the samples must fill rows of so many columns");
  hlHeightField(detail::sizeOf(columns), detail::sizeOf(count / columns), detail::kSampleType<Number>,
                std::ranges::data(samples), missing ? &*missing : nullptr);
}

/// A pinhole camera, in pixels, and how its depths become a surface: hlDepthFrame.
struct DepthCamera {
  HLdouble fx, fy, cx, cy;
  HLdouble scale = 0.001;  ///< m for a unit of depth
  HLdouble join = 0.02, smoothing = 0;
};

/// hlDepthFrame of rows of `width` depths.
inline void depthFrame(const DepthCamera& camera, std::size_t width, std::span<const HLushort> depths) {
  if (width == 0 || depths.size() % width != 0)
    throw std::invalid_argument("the depths must fill rows of so many columns");
  const std::array<HLdouble, 4> numbers{camera.fx, camera.fy, camera.cx, camera.cy};
  hlDepthFrame(detail::sizeOf(width), detail::sizeOf(depths.size() / width), depths.data(), numbers.data(),
               camera.scale, camera.join, camera.smoothing);
}

/// hlVolume of as many slices of `width` x `height` samples as there are.
template <std::ranges::contiguous_range Samples>
requires SampleNumber<std::ranges::range_value_t<Samples>>
void volume(std::size_t width, std::size_t height, const Samples& samples, HLdouble iso,
            std::optional<HLdouble> missing = {}) {
  const std::size_t count = std::ranges::size(samples);
  const HLsizei columns = detail::sizeOf(width), rows = detail::sizeOf(height);  // their product is a size
  if (width == 0 || height == 0 || count % (width * height) != 0)
    throw std::invalid_argument("the samples must fill slices of so many samples along x and y");
  hlVolume(columns, rows, detail::sizeOf(count / (width * height)),
           detail::kSampleType<std::ranges::range_value_t<Samples>>, std::ranges::data(samples),
           missing ? &*missing : nullptr, iso);
}

/// hlVolumeMatter, three numbers a row. Throws std::invalid_argument when they fill no rows.
inline void volumeMatter(std::span<const HLdouble> numbers) {
  if (numbers.size() % 3 != 0) throw std::invalid_argument("matter has three numbers a row");
  hlVolumeMatter(detail::sizeOf(numbers.size() / 3), numbers.data());
}

/// hlVolumeSolid.
inline void volumeSolid(HLenum side) { hlVolumeSolid(side); }

/// hlVolumeIso.
inline void volumeIso(HLuint object, HLint surface, HLdouble iso) { hlVolumeIso(object, surface, iso); }

/// hlImplicit.
inline void implicit(const std::string& json) { hlImplicit(json.c_str()); }

/// hlVolumeSurface.
inline void volumeSurface(HLdouble iso) { hlVolumeSurface(iso); }

/// How the control points of a surface are to be read.
struct NurbsForm {
  HLint order_u = 4, order_v = 4;                  ///< degree + 1
  std::span<const HLdouble> knots_u{}, knots_v{};  ///< none: a Bezier patch
  bool weighted = false;                           ///< x w, y w, z w, w each, and not x y z
  HLdouble error = 0;                              ///< of its triangles, units; 0: 2e-5 of the largest side
};

/// hlNurbsSurface of control points row by row without gaps, u the faster.
inline void nurbsSurface(const NurbsForm& form, std::span<const HLdouble> points) {
  const std::size_t each = form.weighted ? 4 : 3;
  const auto along = [](HLint order, std::span<const HLdouble> knots) {
    return knots.empty() ? static_cast<std::size_t>(std::max(order, 0))
                         : knots.size() - std::min(knots.size(), static_cast<std::size_t>(std::max(order, 0)));
  };
  const std::size_t columns = along(form.order_u, form.knots_u), rows = along(form.order_v, form.knots_v);
  constexpr std::size_t kMax = 1 << 20;
  if (columns > kMax || rows > kMax || points.size() != each * columns * rows)
    throw std::invalid_argument("there must be as many control points as orders and knots say");
  hlNurbsSurface(detail::sizeOf(form.knots_u.size()), form.knots_u.data(), detail::sizeOf(form.knots_v.size()),
                 form.knots_v.data(), static_cast<HLint>(each), static_cast<HLint>(each * columns), points.data(),
                 form.order_u, form.order_v, form.weighted ? HL_MAP2_VERTEX_4 : HL_MAP2_VERTEX_3, form.error);
}

/// hlPointCloud of points of three numbers each; as many normals, or none, and hlPointColors with as many colours, or
/// none.
inline void pointCloud(std::span<const HLdouble> points, std::span<const HLdouble> normals = {}, HLdouble reach = 0,
                       std::span<const HLubyte> colors = {}) {
  if (points.size() % 3 != 0 || (!normals.empty() && normals.size() != points.size()))
    throw std::invalid_argument("a point has three numbers, and its normal too");
  if (!colors.empty() && colors.size() != points.size())
    throw std::invalid_argument("a colour has three numbers, and there is one for each point");
  const HLsizei count = detail::sizeOf(points.size() / 3);
  hlPointCloud(count, points.data(), normals.empty() ? nullptr : normals.data(), reach);
  if (!colors.empty()) hlPointColors(count, colors.data());
}

/// hlGetDoublev of a query with `Count` values (hl_types.h says how many); zeros at an error.
template <std::size_t Count>
std::array<HLdouble, Count> get(HLenum name) {
  std::array<HLdouble, 16> values{};  // no query has more, whatever the caller thinks
  hlGetDoublev(name, values.data());
  std::array<HLdouble, Count> wanted{};
  std::copy_n(values.begin(), std::min<std::size_t>(Count, values.size()), wanted.begin());
  return wanted;
}

/// hlGetDoublev of a query with one value; 0 at an error.
inline HLdouble get(HLenum name) { return get<1>(name)[0]; }

/// hlGetContacts: all of them, the one that presses hardest first.
inline std::vector<HLcontact> contacts() {
  std::vector<HLcontact> all(static_cast<std::size_t>(get(HL_CONTACT_COUNT)));
  all.resize(static_cast<std::size_t>(hlGetContacts(static_cast<HLsizei>(all.size()), all.data())));
  return all;
}

/// hlGetBodies: all of them, sorted by object and name.
inline std::vector<HLbody> bodies() {
  std::vector<HLbody> all(static_cast<std::size_t>(get(HL_BODY_COUNT)));
  all.resize(static_cast<std::size_t>(hlGetBodies(static_cast<HLsizei>(all.size()), all.data())));
  return all;
}

/// hlSnapPoint3d and hlSnapLineTo3d: a curve through these points, x y z each, 1 to 256 of them, for the object that is
/// being defined. Throws std::invalid_argument for a number of numbers that is none of points.
inline void snapCurve(std::span<const HLdouble> points, HLdouble capture, HLdouble release) {
  if (points.empty() || points.size() % 3 != 0) throw std::invalid_argument("a curve has points of three numbers each");
  hlSnapPoint3d(points[0], points[1], points[2], capture, release);
  for (std::size_t i = 3; i < points.size(); i += 3) hlSnapLineTo3d(points[i], points[i + 1], points[i + 2]);
}

/// hlFieldPoint3d and hlFieldLineTo3d, as snapCurve().
inline void fieldCurve(HLenum kind, std::span<const HLdouble> points, HLdouble reach, HLdouble strength) {
  if (points.empty() || points.size() % 3 != 0) throw std::invalid_argument("a curve has points of three numbers each");
  hlFieldPoint3d(kind, points[0], points[1], points[2], reach, strength);
  for (std::size_t i = 3; i < points.size(); i += 3) hlFieldLineTo3d(points[i], points[i + 1], points[i + 2]);
}

/// hlJointTable. Throws std::invalid_argument when there are not as many forces as positions.
inline void jointTable(std::span<const HLdouble> positions, std::span<const HLdouble> forces) {
  if (positions.size() != forces.size()) throw std::invalid_argument("a table needs a force for each position");
  hlJointTable(detail::sizeOf(positions.size()), positions.data(), forces.data());
}

/// hlGetJoints: all of them, sorted by number.
inline std::vector<HLjoint> joints() {
  std::vector<HLjoint> all(static_cast<std::size_t>(get(HL_JOINT_COUNT)));
  all.resize(static_cast<std::size_t>(hlGetJoints(static_cast<HLsizei>(all.size()), all.data())));
  return all;
}

/// hlGetRemoteHands: all of them, sorted by server.
inline std::vector<HLremotehand> remoteHands() {
  std::vector<HLremotehand> all(static_cast<std::size_t>(get(HL_REMOTE_HAND_COUNT)));
  all.resize(static_cast<std::size_t>(hlGetRemoteHands(static_cast<HLsizei>(all.size()), all.data())));
  return all;
}

/// hlTakeSamples: all that came since the last time, the oldest first.
inline std::vector<HLsample> takeSamples() {
  constexpr HLsizei kAtATime = 256;
  std::vector<HLsample> all;
  for (HLsizei taken = kAtATime; taken == kAtATime;) {
    const std::size_t before = all.size();
    all.resize(before + kAtATime);
    taken = hlTakeSamples(kAtATime, all.data() + before);
    all.resize(before + static_cast<std::size_t>(taken));
  }
  return all;
}

/// What the hand has felt since the last takeContactReport().
struct ContactReport {
  HLcontactreport mean;
  std::vector<HLcontactforce> contacts;
};

/// hlTakeContactReport: all that was pressed since the last time, the strongest first.
inline ContactReport takeContactReport() {
  constexpr HLsizei kMax = 1024;  // more are not kept
  ContactReport report{{}, std::vector<HLcontactforce>(kMax)};
  report.contacts.resize(static_cast<std::size_t>(hlTakeContactReport(kMax, report.contacts.data(), &report.mean)));
  return report;
}

}  // namespace calls
}  // namespace hl
