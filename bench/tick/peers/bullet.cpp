// Bullet: convexSweepTest of a sphere against a btBvhTriangleMeshShape.
#include <btBulletCollisionCommon.h>

#include <algorithm>
#include <limits>

#include "tick/peers/peers.h"

namespace hl::bench {

namespace {

// The quantised tree counts the triangles of a part in 21 bits.
constexpr std::size_t kMaxInPart = 1'000'000;

// A sweep ends where the squared distance is below 1e-4 units, whatever these are: here that is 1 um.
constexpr double kUnit_m = 1e-4;

btScalar toBullet(double metres) { return static_cast<btScalar>(metres / kUnit_m); }
btVector3 toBullet(const Vec3& p) { return {toBullet(p.x()), toBullet(p.y()), toBullet(p.z())}; }

class Bullet final : public Peer {
 public:
  explicit Bullet(const Mesh& mesh)
      : dispatcher_(&configuration_), world_(&dispatcher_, &broadphase_, &configuration_) {
    positions_.reserve(mesh.positions.size());
    for (const Vec3& p : mesh.positions) positions_.push_back(toBullet(p));
    for (const auto& t : mesh.triangles) {
      for (const std::uint32_t index : t) indices_.push_back(static_cast<int>(index));
    }
    for (std::size_t first = 0; first < mesh.triangles.size(); first += kMaxInPart) {
      btIndexedMesh part;
      part.m_numTriangles = static_cast<int>(std::min(kMaxInPart, mesh.triangles.size() - first));
      part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(&indices_[3 * first]);
      part.m_triangleIndexStride = 3 * sizeof(int);
      part.m_numVertices = static_cast<int>(positions_.size());
      part.m_vertexBase = reinterpret_cast<const unsigned char*>(positions_.data());
      part.m_vertexStride = sizeof(btVector3);
      parts_.addIndexedMesh(part, PHY_INTEGER);
    }
    shape_ = std::make_unique<btBvhTriangleMeshShape>(&parts_, true);
    shape_->setMargin(0);
    object_.setCollisionShape(shape_.get());
    world_.addCollisionObject(&object_);
  }
  ~Bullet() override { world_.removeCollisionObject(&object_); }
  Bullet(const Bullet&) = delete;
  Bullet& operator=(const Bullet&) = delete;

  std::span<const Question> questions() const override {
    static constexpr std::array kAsked{Question::kImpact};
    return kAsked;
  }

  double ask(Question, const Probe& probe) override {
    const btSphereShape sphere(toBullet(probe.radius_m));
    const btTransform from(btMatrix3x3::getIdentity(), toBullet(probe.from));
    const btTransform to(btMatrix3x3::getIdentity(), toBullet(probe.from + probe.motion));
    btCollisionWorld::ClosestConvexResultCallback hit(from.getOrigin(), to.getOrigin());
    world_.convexSweepTest(&sphere, from, to, hit);
    if (!hit.hasHit()) return std::numeric_limits<double>::infinity();
    return static_cast<double>(hit.m_closestHitFraction) * probe.motion.norm();
  }

 private:
  std::vector<btVector3> positions_;
  std::vector<int> indices_;
  btTriangleIndexVertexArray parts_;
  std::unique_ptr<btBvhTriangleMeshShape> shape_;
  btCollisionObject object_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btCollisionWorld world_;
};

}  // namespace

std::unique_ptr<Peer> makeBullet(const Mesh& mesh) { return std::make_unique<Bullet>(mesh); }

}  // namespace hl::bench
