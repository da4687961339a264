// Clouds of scene files and of clients' frames, from messages of proto/hl.proto. Every number is checked.
#pragma once

#include <hl.pb.h>

#include <cstdint>
#include <memory>

#include "surfaces/point_cloud.h"

namespace hl {

/// Memory that making the cloud of the message takes, bytes.
std::uint64_t bytesToMakeCloud(const proto::Cloud& in);

/// Throws hl::Error for what makes no sense, or names a file or a builtin.
std::shared_ptr<const PointCloud> decodeCloud(const proto::Cloud& in);

/// What a file or a builtin holds, as points or surfels as the message says. Throws hl::Error.
std::shared_ptr<const PointCloud> withLook(const PointCloud& cloud, const proto::Cloud& in);

}  // namespace hl
