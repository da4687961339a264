// Embree 3: rtcPointQuery, with the exact distance to a triangle in the callback that it asks for.
#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "tick/peers/peers.h"

namespace hl::bench {

namespace {

using Vec3f = Eigen::Vector3f;

// Nearest point of a triangle (Ericson, Real-Time Collision Detection, section 5.1.5).
Vec3f nearestOnTriangle(const Vec3f& p, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const Vec3f ab = b - a, ac = c - a, ap = p - a;
  const float d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec3f bp = p - b;
  const float d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const Vec3f cp = p - c;
  const float d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b);
  const float sum = va + vb + vc;
  return a + vb / sum * ab + vc / sum * ac;
}

class Embree final : public Peer {
 public:
  explicit Embree(const Mesh& mesh) : device_(rtcNewDevice(nullptr)) {
    if (device_ == nullptr) throw Error("Embree does not run on this machine");
    scene_ = rtcNewScene(device_);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    positions_ = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                             3 * sizeof(float), mesh.positions.size()));
    triangles_ = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), mesh.triangles.size()));
    float* position = positions_;
    for (const Vec3& p : mesh.positions) {
      for (int axis = 0; axis < 3; ++axis) *position++ = static_cast<float>(p[axis]);
    }
    std::uint32_t* index = triangles_;
    for (const auto& t : mesh.triangles) index = std::copy(t.begin(), t.end(), index);
    rtcSetGeometryPointQueryFunction(geometry, &Embree::visit);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~Embree() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  std::span<const Question> questions() const override {
    static constexpr std::array kAsked{Question::kNear, Question::kNearest, Question::kFinger};
    return kAsked;
  }

  double ask(Question question, const Probe& probe) override {
    constexpr float kAnywhere = std::numeric_limits<float>::infinity();
    const Vec3f p = (question == Question::kFinger ? probe.finger : probe.centre).cast<float>();
    const float radius = question == Question::kNear ? static_cast<float>(probe.near_m) : kAnywhere;
    RTCPointQuery query{p.x(), p.y(), p.z(), 0, radius};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    nearest_ = std::numeric_limits<float>::infinity();
    rtcPointQuery(scene_, &query, &context, nullptr, this);
    return nearest_;
  }

 private:
  Vec3f corner(std::uint32_t triangle, int corner) const {
    const float* p =
        positions_ + 3 * std::size_t{triangles_[3 * std::size_t{triangle} + static_cast<unsigned>(corner)]};
    return {p[0], p[1], p[2]};
  }

  // Returns whether the radius of the query has become smaller.
  static bool visit(RTCPointQueryFunctionArguments* asked) {
    Embree& self = *static_cast<Embree*>(asked->userPtr);
    const Vec3f p(asked->query->x, asked->query->y, asked->query->z);
    const Vec3f q = nearestOnTriangle(p, self.corner(asked->primID, 0), self.corner(asked->primID, 1),
                                      self.corner(asked->primID, 2));
    const float distance = (p - q).norm();
    if (distance > asked->query->radius) return false;
    self.nearest_ = asked->query->radius = distance;
    return true;
  }

  RTCDevice device_;
  RTCScene scene_ = nullptr;
  float* positions_ = nullptr;  // in the geometry's buffers
  std::uint32_t* triangles_ = nullptr;
  float nearest_ = 0;  // in the present query
};

}  // namespace

std::unique_ptr<Peer> makeEmbree(const Mesh& mesh) { return std::make_unique<Embree>(mesh); }

}  // namespace hl::bench
