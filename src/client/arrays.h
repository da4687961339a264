// Arrays: where the application's vertex arrays are, and drawing from them through the recorder: the same bits as
// hlBegin .. hlEnd.
#pragma once

#include <hl/hl_types.h>

#include <cstddef>

#include "client/attributes.h"
#include "client/recorder.h"

namespace hl::client {

/// One array of the application's memory; read when drawn.
struct Array {
  int size = 3;  ///< numbers for each vertex
  HLenum type = HL_DOUBLE;
  std::size_t stride = 0;  ///< bytes from one vertex to the next
  const void* data = nullptr;
  bool enabled = false;

  /// Throws Fault. `stride` 0: close together.
  void point(int numbers, HLenum number_type, HLsizei bytes, const void* pointer);
  /// Number `component` of vertex `index`; 0 for those that the array does not have. Unaligned data is fine.
  double at(std::size_t index, int component) const;
};

/// Indices of hlDrawElements.
struct Indices {
  HLenum type;
  const void* data;
  HLuint at(std::size_t i) const;
};

struct Arrays {
  Array vertices{3}, normals{3}, texcoords{2};

  /// The array of HL_VERTEX_ARRAY .. ; throws Fault HL_INVALID_ENUM.
  Array& named(HLenum name);
  /// Hands vertex `index` to the recorder, with `current` for what has no array.
  void draw(Recorder& recorder, const VertexExtras& current, std::size_t index) const;
  /// Throws Fault HL_INVALID_OPERATION when an enabled array has no pointer.
  void requirePointers() const;
};

/// Throws Fault HL_INVALID_ENUM.
void requireIndexType(HLenum type);

}  // namespace hl::client
