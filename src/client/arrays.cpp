#include "client/arrays.h"

#include <cstring>

#include "client/fault.h"

namespace hl::client {

namespace {

// The application's memory may have any alignment.
template <typename Number>
Number read(const void* data, std::size_t byte) {
  Number number;
  std::memcpy(&number, static_cast<const char*>(data) + byte, sizeof number);
  return number;
}

std::size_t bytesOf(HLenum type) { return type == HL_FLOAT ? sizeof(HLfloat) : sizeof(HLdouble); }

}  // namespace

void Array::point(int numbers, HLenum number_type, HLsizei bytes, const void* pointer) {
  if (number_type != HL_FLOAT && number_type != HL_DOUBLE)
    throw Fault(HL_INVALID_ENUM, "the type must be HL_FLOAT or HL_DOUBLE");
  if (bytes < 0) throw Fault(HL_INVALID_VALUE, "the stride must not be negative");
  size = numbers;
  type = number_type;
  stride = bytes != 0 ? static_cast<std::size_t>(bytes) : static_cast<std::size_t>(numbers) * bytesOf(number_type);
  data = pointer;
}

double Array::at(std::size_t index, int component) const {
  if (component >= size) return 0;
  const std::size_t byte = index * stride + static_cast<std::size_t>(component) * bytesOf(type);
  return type == HL_FLOAT ? double{read<HLfloat>(data, byte)} : read<HLdouble>(data, byte);
}

HLuint Indices::at(std::size_t i) const {
  switch (type) {
    case HL_UNSIGNED_BYTE:
      return read<HLubyte>(data, i);
    case HL_UNSIGNED_SHORT:
      return read<HLushort>(data, i * sizeof(HLushort));
    default:
      return read<HLuint>(data, i * sizeof(HLuint));
  }
}

Array& Arrays::named(HLenum name) {
  switch (name) {
    case HL_VERTEX_ARRAY:
      return vertices;
    case HL_NORMAL_ARRAY:
      return normals;
    case HL_TEXTURE_COORD_ARRAY:
      return texcoords;
    default:
      throw Fault(HL_INVALID_ENUM, "the array must be HL_VERTEX_ARRAY, HL_NORMAL_ARRAY or HL_TEXTURE_COORD_ARRAY");
  }
}

void Arrays::draw(Recorder& recorder, const VertexExtras& current, std::size_t index) const {
  VertexExtras extras = current;
  if (normals.enabled) {
    extras.setNormal({normals.at(index, 0), normals.at(index, 1), normals.at(index, 2)});
    requireFinite(extras.normal[0], extras.normal[1], extras.normal[2]);
  }
  if (texcoords.enabled) {
    extras.setTexcoord({texcoords.at(index, 0), texcoords.at(index, 1)});
    requireFinite(extras.texcoord[0], extras.texcoord[1]);
  }
  const double x = vertices.at(index, 0), y = vertices.at(index, 1), z = vertices.at(index, 2);
  if (!recorder.vertexInRoom(extras, x, y, z)) recorder.vertex(extras, x, y, z);
}

void Arrays::requirePointers() const {
  for (const Array* array : {&vertices, &normals, &texcoords})
    if (array->enabled && array->data == nullptr) throw Fault(HL_INVALID_OPERATION, "an enabled array has no pointer");
}

void requireIndexType(HLenum type) {
  if (type != HL_UNSIGNED_BYTE && type != HL_UNSIGNED_SHORT && type != HL_UNSIGNED_INT)
    throw Fault(HL_INVALID_ENUM, "the type must be HL_UNSIGNED_BYTE, HL_UNSIGNED_SHORT or HL_UNSIGNED_INT");
}

}  // namespace hl::client
