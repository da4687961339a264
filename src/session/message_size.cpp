#include "session/message_size.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/message.h>
#include <google/protobuf/wire_format_lite.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

namespace hl {

namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::io::CodedInputStream;
using Wire = google::protobuf::internal::WireFormatLite;

constexpr std::uint64_t kAllocated = 16;    // malloc()'s own for a piece
constexpr std::uint64_t kWhileGrowing = 3;  // of a list that is twice as long at a time
constexpr std::uint64_t kPointer = 8;       // in a list of messages
constexpr std::uint64_t kString = 64;       // beside its bytes
constexpr std::uint64_t kUnknown = 128;     // a field that the schema does not have: it is kept all the same
constexpr std::uint32_t kMaxFields = 64;    // numbers of fields in the schema are below
constexpr int kMaxOutlined = 2000;          // uploads: more are refused as one

// What one field of the schema takes.
struct Layout;
struct Field {
  bool known = false, varint = false;
  std::uint64_t element = 0;        // bytes of one number of a list
  const Layout* message = nullptr;  // or what it is
};
struct Layout {
  std::uint64_t bytes = 0;
  std::array<Field, kMaxFields> fields{};
};

std::uint64_t elementBytes(const FieldDescriptor& field) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
    case FieldDescriptor::CPPTYPE_INT64:
    case FieldDescriptor::CPPTYPE_UINT64:
      return 8;
    case FieldDescriptor::CPPTYPE_BOOL:
      return 1;
    default:
      return 4;
  }
}

// The schema's messages are no part of themselves.
const Layout& layoutOf(const Descriptor& type, std::map<const Descriptor*, Layout>& known) {
  const auto [place, fresh] = known.try_emplace(&type);
  Layout& layout = place->second;
  if (!fresh) return layout;
  layout.bytes = google::protobuf::MessageFactory::generated_factory()->GetPrototype(&type)->SpaceUsedLong();
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    Field& out = layout.fields.at(static_cast<std::size_t>(field.number()));
    out.known = true;
    out.varint = field.type() != FieldDescriptor::TYPE_DOUBLE && field.type() != FieldDescriptor::TYPE_FLOAT;
    if (field.is_repeated()) out.element = elementBytes(field);
    if (field.message_type() != nullptr) out.message = &layoutOf(*field.message_type(), known);
    if (field.type() == FieldDescriptor::TYPE_STRING || field.type() == FieldDescriptor::TYPE_BYTES) out.element = 0;
  }
  return layout;
}

const Layout& clientMessage() {
  static std::map<const Descriptor*, Layout> known;
  static const Layout& layout = layoutOf(*proto::ClientMessage::descriptor(), known);
  return layout;
}

class Scan {
 public:
  explicit Scan(std::string_view wire)
      : in_(reinterpret_cast<const std::uint8_t*>(wire.data()), static_cast<int>(wire.size())) {}

  std::uint64_t bytes() {
    message(clientMessage());
    return bytes_;
  }

 private:
  bool message(const Layout& layout) {
    bytes_ += layout.bytes + kAllocated + kWhileGrowing * kPointer;
    while (const std::uint32_t tag = in_.ReadTag()) {
      const auto number = static_cast<std::uint32_t>(Wire::GetTagFieldNumber(tag));
      if (!field(number < kMaxFields ? layout.fields[number] : Field{}, Wire::GetTagWireType(tag))) return false;
    }
    return in_.ConsumedEntireMessage() || in_.BytesUntilLimit() == 0;
  }

  bool field(const Field& field, Wire::WireType type) {
    if (!field.known) bytes_ += kUnknown;
    bytes_ += kWhileGrowing * field.element;
    std::uint64_t value = 0;
    switch (type) {
      case Wire::WIRETYPE_VARINT:
        return in_.ReadVarint64(&value);
      case Wire::WIRETYPE_FIXED64:
        return in_.Skip(8);
      case Wire::WIRETYPE_FIXED32:
        return in_.Skip(4);
      case Wire::WIRETYPE_LENGTH_DELIMITED:
        return lengthDelimited(field);
      default:
        return true;  // a group's begin or end: what is in it follows
    }
  }

  bool lengthDelimited(const Field& field) {
    std::uint32_t length = 0;
    if (!in_.ReadVarint32(&length)) return false;
    if (field.message != nullptr) {
      const CodedInputStream::Limit limit = in_.PushLimit(static_cast<int>(length));
      const bool good = message(*field.message);
      in_.PopLimit(limit);
      return good;
    }
    const bool list = field.element > 0;
    bytes_ += list ? kWhileGrowing * field.element * (field.varint ? length : length / 8 + 1) : length + kString;
    return in_.Skip(static_cast<int>(length));
  }

  CodedInputStream in_;
  std::uint64_t bytes_ = 0;
};

// The value of the field `number` of the message that `wire` begins with, when it has one that is a number.
std::optional<std::uint64_t> numberIn(std::string_view wire, int number) {
  CodedInputStream in(reinterpret_cast<const std::uint8_t*>(wire.data()), static_cast<int>(wire.size()));
  while (const std::uint32_t tag = in.ReadTag()) {
    std::uint64_t value = 0;
    if (Wire::GetTagFieldNumber(tag) != number) {
      if (!Wire::SkipField(&in, tag)) return {};
    } else {
      if (Wire::GetTagWireType(tag) != Wire::WIRETYPE_VARINT || !in.ReadVarint64(&value)) return {};
      return value;
    }
  }
  return {};
}

// The length-delimited field that `wire` begins with, which is then behind it; as much of it as there is.
std::optional<std::pair<int, std::string_view>> takeField(std::string_view& wire) {
  CodedInputStream in(reinterpret_cast<const std::uint8_t*>(wire.data()), static_cast<int>(wire.size()));
  const std::uint32_t tag = in.ReadTag();
  std::uint32_t length = 0;
  if (tag == 0 || Wire::GetTagWireType(tag) != Wire::WIRETYPE_LENGTH_DELIMITED || !in.ReadVarint32(&length)) return {};
  wire.remove_prefix(static_cast<std::size_t>(in.CurrentPosition()));
  const std::string_view inside = wire.substr(0, length);
  wire.remove_prefix(inside.size());
  return std::pair(Wire::GetTagFieldNumber(tag), inside);
}

}  // namespace

std::uint64_t bytesToDecode(std::string_view wire) { return Scan(wire).bytes(); }

proto::ClientMessage outlineOf(std::string_view wire) {
  proto::ClientMessage outline;
  const auto body = takeField(wire);
  if (!body) return outline;
  auto [number, inside] = *body;
  if (number == proto::ClientMessage::kFrame)
    outline.mutable_frame()->set_number(numberIn(inside, proto::Frame::kNumberFieldNumber).value_or(0));
  if (number == proto::ClientMessage::kUpload)
    outline.mutable_upload()->set_id(numberIn(inside, proto::Upload::kIdFieldNumber).value_or(0));
  if (number != proto::ClientMessage::kUploads) return outline;
  auto& parts = *outline.mutable_uploads()->mutable_parts();
  for (auto part = takeField(inside); part && parts.size() < kMaxOutlined; part = takeField(inside))
    parts.Add()->set_id(numberIn(part->second, proto::Upload::kIdFieldNumber).value_or(0));
  return outline;
}

}  // namespace hl
