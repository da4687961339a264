#include "session/upload_parts.h"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "session/message_size.h"

namespace hl {

void joinParts(std::list<proto::Primitives>& parts, MemoryShare& memory) {
  if (parts.size() < 2) return;
  std::uint64_t bytes = 0;
  for (const proto::Primitives& part : parts) bytes += bytesOfMessage(part.SpaceUsedLong());
  memory.take(bytes);
  proto::Primitives whole;
  std::array<int, 8> sum{};
  for (const proto::Primitives& p : parts) {
    const std::array<int, 8> of{p.vertices_size(), p.normals_size(),  p.texcoords_size(), p.triangles_size(),
                                p.polygons_size(), p.segments_size(), p.points_size(),    p.colours_size()};
    std::transform(sum.begin(), sum.end(), of.begin(), sum.begin(), std::plus<>());
  }
  whole.mutable_vertices()->Reserve(sum[0]);
  whole.mutable_normals()->Reserve(sum[1]);
  whole.mutable_texcoords()->Reserve(sum[2]);
  whole.mutable_triangles()->Reserve(sum[3]);
  whole.mutable_polygons()->Reserve(sum[4]);
  whole.mutable_segments()->Reserve(sum[5]);
  whole.mutable_points()->Reserve(sum[6]);
  whole.mutable_colours()->Reserve(sum[7]);
  for (; !parts.empty(); parts.pop_front()) whole.MergeFrom(parts.front());
  parts.push_back(std::move(whole));
}

}  // namespace hl
