// Places: points, lines and planes of an object that is defined, as its snaps and fields have them, placed by the
// matrix of the moment.
#pragma once

#include <hl.pb.h>
#include <hl/hl_types.h>

#include <cstddef>
#include <vector>

#include "client/call.h"
#include "client/vec_messages.h"

namespace hl::client {

// As servers take them.
inline constexpr double kMinOfPlace = 1e-9, kMaxOfPlace = 1e9, kFarthestPlace_m = 1e6;
inline constexpr std::size_t kMaxOfObject = 64;
inline constexpr int kMaxCornersOfPlace = 256;

/// The items of the open definition. Throws Fault, as all below.
inline ItemList& openDefinition(HLcontext& context) {
  if (!context.definition) throw Fault(HL_INVALID_OPERATION, "only between hlNewObject and hlEndObject");
  return context.definition->items;
}

/// Appends a point to that of a proto::Snap or proto::Field.
template <typename Message>
void addPoint(const HLcontext& context, const Eigen::Vector3d& point, Message& message) {
  const Eigen::Vector3d placed = (context.draw.modelview.top() * point.homogeneous()).template head<3>();
  if (!(placed.array().abs() <= kFarthestPlace_m).all())
    throw Fault(HL_INVALID_VALUE, "the place must be within 1e6 m of the origin");
  message.mutable_points()->Add(placed.data(), placed.data() + 3);
}

/// Appends a corner to the last of a list.
template <typename Message>
void leadOn(const HLcontext& context, const Eigen::Vector3d& point, std::vector<Message>& list) {
  if (list.empty() || list.back().has_normal())
    throw Fault(HL_INVALID_OPERATION, "the last one of the definition must be of a point or line");
  if (list.back().points_size() >= 3 * kMaxCornersOfPlace)
    throw Fault(HL_INVALID_VALUE, "it has 256 points, and no more can be");
  addPoint(context, point, list.back());
}

template <typename Message>
void append(Message message, std::vector<Message>& list) {
  if (list.size() == kMaxOfObject) throw Fault(HL_INVALID_VALUE, "an object has at most 64 of them");
  list.push_back(std::move(message));
}

/// The unit vector of `linear` times v; v must be finite and not 0.
inline void setUnit(const Eigen::Matrix3d& linear, const Eigen::Vector3d& v, proto::Vec3& out) {
  const Eigen::Vector3d placed = (linear * v.stableNormalized()).stableNormalized();
  if (!v.allFinite() || !placed.allFinite() || !(placed.norm() > 0))
    throw Fault(HL_INVALID_VALUE, "the direction must not be 0");
  setVec(out, placed.x(), placed.y(), placed.z());
}

inline Eigen::Matrix3d linearOf(const HLcontext& context) { return context.draw.modelview.top().topLeftCorner<3, 3>(); }

/// As a normal is placed: by the inverse transpose.
template <typename Message>
void setNormal(const HLcontext& context, const Eigen::Vector3d& normal, Message& message) {
  setUnit(linearOf(context).inverse().transpose(), normal, *message.mutable_normal());
}

}  // namespace hl::client
