#include "io/gltf_accessors.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <utility>

#include "io/text_words.h"

namespace hl {

namespace {

ScalarKind componentKind(const GltfItem& item) {
  switch (item.needed("componentType")) {
    case 5120:
      return ScalarKind::kInt8;
    case 5121:
      return ScalarKind::kUint8;
    case 5122:
      return ScalarKind::kInt16;
    case 5123:
      return ScalarKind::kUint16;
    case 5125:
      return ScalarKind::kUint32;
    case 5126:
      return ScalarKind::kFloat;
    default:
      item.refuse(fmt::format("its componentType is {}, which is none", item.needed("componentType")));
  }
}

struct GltfType {
  const char* name;
  std::size_t parts, columns;
};
constexpr std::array<GltfType, 7> kTypes{{{"SCALAR", 1, 1},
                                          {"VEC2", 2, 1},
                                          {"VEC3", 3, 1},
                                          {"VEC4", 4, 1},
                                          {"MAT2", 4, 2},
                                          {"MAT3", 9, 3},
                                          {"MAT4", 16, 4}}};

const GltfType& typeOf(const GltfItem& item) {
  const boost::json::value* const name = item.object().if_contains("type");
  for (const GltfType& type : kTypes) {
    if (name != nullptr && name->is_string() && name->as_string() == type.name) return type;
  }
  item.refuse(name == nullptr ? "has no type" : "its type is none: " + shown(boost::json::serialize(*name)));
}

// Columns of matrices begin at multiples of four bytes.
std::size_t elementSize(const GltfType& type, ScalarKind kind) {
  const std::size_t column = type.parts / type.columns * sizeOf(kind);
  return type.columns == 1 ? column : type.columns * ((column + 3) / 4 * 4);
}

// What a normalised integer is divided by.
float largestOf(const GltfAccessor& accessor) {
  if (!accessor.normalized) return 1;
  switch (accessor.kind) {
    case ScalarKind::kInt8:
      return 127;
    case ScalarKind::kUint8:
      return 255;
    case ScalarKind::kInt16:
      return 32767;
    case ScalarKind::kUint16:
      return 65535;
    default:
      return 1;
  }
}

// One element, of vectors and single numbers.
void copyFloats(const GltfAccessor& accessor, const char* from, float* to) {
  const float largest = largestOf(accessor);
  const float least = accessor.normalized ? -1.0F : std::numeric_limits<float>::lowest();
  const std::size_t size = sizeOf(accessor.kind);
  for (std::size_t part = 0; part < accessor.parts; ++part)
    to[part] = std::max(least, static_cast<float>(numberAt(from, {part * size, accessor.kind}, false)) / largest);
}

template <typename Whole>
std::optional<std::size_t> firstFrom(const char* at, std::size_t stride, std::size_t count, std::size_t limit) {
  for (std::size_t i = 0; i < count; ++i) {
    Whole number = 0;
    std::memcpy(&number, at + i * stride, sizeof number);
    if (number >= limit) return i;
  }
  return {};
}

std::optional<std::size_t> firstOfKind(ScalarKind kind, const char* at, std::size_t stride, std::size_t count,
                                       std::size_t limit) {
  if (kind == ScalarKind::kUint8) return firstFrom<std::uint8_t>(at, stride, count, limit);
  if (kind == ScalarKind::kUint16) return firstFrom<std::uint16_t>(at, stride, count, limit);
  return firstFrom<std::uint32_t>(at, stride, count, limit);
}

}  // namespace

GltfAccessors::GltfAccessors(GltfFile& file) : file_(file) {
  const GltfItem root(file.json(), "");
  const std::size_t buffers = root.list("buffers").size();
  for (std::size_t i = 0; i < buffers; ++i) file.sizeOfBuffer(i);
  for (const GltfItem& item : root.list("bufferViews")) addView(item, buffers);
  for (const GltfItem& item : root.list("accessors")) addAccessor(item);
}

void GltfAccessors::addView(const GltfItem& item, std::size_t buffers) {
  constexpr std::size_t kLeastStride = 4, kMostStride = 252;
  const std::optional<std::size_t> buffer = item.reference("buffer", "buffers", buffers);
  if (!buffer) item.refuse("has no buffer");
  const std::size_t begin = item.whole("byteOffset").value_or(0), length = item.needed("byteLength");
  const std::size_t stride = item.whole("byteStride").value_or(0), size = file_.sizeOfBuffer(*buffer);
  if (begin > size || length > size - begin)
    item.refuse(fmt::format("its {} bytes from {} on are not within the {} of its buffer", length, begin, size));
  // Some programs write 0 where there is none.
  if (stride != 0 && (stride < kLeastStride || stride > kMostStride))
    item.refuse(fmt::format("its byteStride is {}, and not within {} and {}", stride, kLeastStride, kMostStride));
  views_.push_back({*buffer, begin, length, stride});
}

GltfRun GltfAccessors::runOf(const GltfItem& item, std::size_t view, std::size_t count, std::size_t size,
                             bool strided) const {
  const auto& [buffer, begin, length, own_stride] = views_[view];
  const std::size_t offset = item.whole("byteOffset").value_or(0);
  const std::size_t stride = strided && own_stride != 0 ? own_stride : size;
  if (stride < size)
    item.refuse(fmt::format("its elements of {} bytes are {} bytes apart (bufferViews/{})", size, stride, view));
  // By division, as products wrap around.
  if (offset > length || (count > 0 && (length - offset < size || (length - offset - size) / stride < count - 1)))
    item.refuse(fmt::format("its {} elements from byte {} on are not within the {} bytes of bufferViews/{}", count,
                            offset, length, view));
  return {buffer, begin + offset, stride};
}

void GltfAccessors::addAccessor(const GltfItem& item) {
  const GltfType& type = typeOf(item);
  const boost::json::value* const normalized = item.object().if_contains("normalized");
  GltfAccessor accessor{type.name, componentKind(item), normalized != nullptr && *normalized == true,
                        item.needed("count"), type.parts};
  if (accessor.count == 0) item.refuse("its count is 0");
  const std::size_t size = elementSize(type, accessor.kind);
  if (const auto view = item.reference("bufferView", "bufferViews", views_.size()))
    accessor.run = runOf(item, *view, accessor.count, size, true);
  constexpr std::size_t kMostZeros = 1 << 24;  // more of nothing is an attack on the memory
  if (!accessor.run && accessor.count > kMostZeros)
    item.refuse(fmt::format("has {} elements and no bufferView", accessor.count));
  addSparse(item, accessor);
  accessors_.push_back(std::move(accessor));
}

void GltfAccessors::addSparse(const GltfItem& item, GltfAccessor& accessor) const {
  const std::optional<GltfItem> sparse = item.child("sparse");
  if (!sparse) return;
  const std::optional<GltfItem> indices = sparse->child("indices"), values = sparse->child("values");
  if (!indices || !values) sparse->refuse("has no indices or no values");
  GltfAccessor::Sparse parts{sparse->needed("count"), componentKind(*indices), {}, {}};
  if (parts.count > accessor.count) sparse->refuse("has more elements than its accessor");
  const auto index_view = indices->reference("bufferView", "bufferViews", views_.size());
  const auto value_view = values->reference("bufferView", "bufferViews", views_.size());
  if (!index_view || !value_view) sparse->refuse("has no bufferView");
  parts.indices = runOf(*indices, *index_view, parts.count, sizeOf(parts.kind), false);
  parts.values = runOf(*values, *value_view, parts.count, elementSize(typeOf(item), accessor.kind), false);
  if (const auto bytes = bytesAt(parts.indices)) {
    if (firstOfKind(parts.kind, *bytes, parts.indices.stride, parts.count, accessor.count))
      indices->refuse(fmt::format("one is beyond the {} elements of its accessor", accessor.count));
  }
  accessor.sparse = parts;
}

std::optional<const char*> GltfAccessors::bytesAt(const GltfRun& run) const {
  const std::optional<std::string_view> bytes = file_.bytesOf(run.buffer);
  if (!bytes) return {};
  return bytes->data() + run.begin;
}

std::optional<std::vector<float>> GltfAccessors::floatsOf(std::size_t number) const {
  const GltfAccessor& accessor = accessors_[number];
  std::vector<float> floats(accessor.count * accessor.parts);
  if (accessor.run) {
    const std::optional<const char*> bytes = bytesAt(*accessor.run);
    if (!bytes) return {};
    for (std::size_t i = 0; i < accessor.count; ++i)
      copyFloats(accessor, *bytes + i * accessor.run->stride, &floats[i * accessor.parts]);
  }
  if (accessor.sparse) substitute(accessor, floats);
  return floats;
}

void GltfAccessors::substitute(const GltfAccessor& accessor, std::vector<float>& floats) const {
  const auto& [count, kind, indices, values] = *accessor.sparse;
  const std::optional<const char*> places = bytesAt(indices), bytes = bytesAt(values);
  for (std::size_t i = 0; places && bytes && i < count; ++i) {
    const auto place = static_cast<std::size_t>(numberAt(*places + i * indices.stride, {0, kind}, false));
    copyFloats(accessor, *bytes + i * values.stride, &floats[place * accessor.parts]);
  }
}

std::optional<std::size_t> GltfAccessors::firstFrom(std::size_t number, std::size_t limit) const {
  const GltfAccessor& accessor = accessors_[number];
  if (!accessor.run) return {};
  const std::optional<const char*> bytes = bytesAt(*accessor.run);
  if (!bytes) return {};
  return firstOfKind(accessor.kind, *bytes, accessor.run->stride, accessor.count, limit);
}

std::uint32_t GltfAccessors::wholeAt(std::size_t number, std::size_t place) const {
  const GltfAccessor& accessor = accessors_[number];
  const std::optional<const char*> bytes = accessor.run ? bytesAt(*accessor.run) : std::nullopt;
  if (!bytes) return 0;
  return static_cast<std::uint32_t>(numberAt(*bytes + place * accessor.run->stride, {0, accessor.kind}, false));
}

}  // namespace hl
