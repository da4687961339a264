#include "io/gltf_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "io/base64.h"
#include "io/companion_file.h"
#include "io/gltf_item.h"

namespace hl {

namespace json = boost::json;

namespace {

constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr std::size_t kGlbHeader_bytes = 12, kChunkHeader_bytes = 8;

std::uint32_t wordAt(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

void putWord(std::string& bytes, std::size_t word) {
  const auto value = static_cast<std::uint32_t>(word);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void putChunk(std::string& file, std::uint32_t kind, std::string_view bytes, char fill) {
  const std::size_t padding = (4 - bytes.size() % 4) % 4;
  putWord(file, bytes.size() + padding);
  putWord(file, kind);
  (file += bytes).append(padding, fill);
}

json::value parsedJson(std::string_view text) {
  constexpr std::size_t kDeepest = 200;
  while (text.ends_with('\0')) text.remove_suffix(1);  // some programs fill the chunk so
  json::parse_options options;
  options.max_depth = kDeepest;
  options.allow_invalid_utf8 = true;
  json::parser parser({}, options);
  json::error_code error;
  const std::size_t read = parser.write(withoutByteOrderMark(text), error);
  if (error) throw Error(fmt::format("its JSON is wrong at byte {}, or the file is cut there", read));
  return parser.release();
}

}  // namespace

GltfFile::GltfFile(const ModelFile& file)
    : file_(file), mapped_(file.path), json_(parsedJson(takeChunks(mapped_.bytes()))) {
  if (!isVersion1()) buffers_.resize(GltfItem(json_, "").list("buffers").size());
}

// A .glb starts with "glTF", version, length; each chunk with its length and kind. Of version 1 the JSON is in the same
// place.
std::string_view GltfFile::takeChunks(std::string_view bytes) {
  if (!bytes.starts_with("glTF")) return bytes;
  glb_ = true;
  const auto refuse = [&](std::size_t told) {
    throw Error(fmt::format("it is cut: it tells of {} bytes, and has {}", told, bytes.size()));
  };
  if (bytes.size() < kGlbHeader_bytes + kChunkHeader_bytes) refuse(kGlbHeader_bytes + kChunkHeader_bytes);
  if (wordAt(bytes, 8) > bytes.size()) refuse(wordAt(bytes, 8));
  const auto chunk = [&](std::size_t at) {
    const std::size_t end = at + kChunkHeader_bytes + wordAt(bytes, at);
    if (end > bytes.size()) refuse(end);
    return bytes.substr(at + kChunkHeader_bytes, end - at - kChunkHeader_bytes);
  };
  const std::string_view text = chunk(kGlbHeader_bytes);
  if (wordAt(bytes, 4) == 1) return text;
  if (wordAt(bytes, kGlbHeader_bytes + 4) != kJsonChunk) throw Error("its first chunk is not the JSON");
  const std::size_t next = kGlbHeader_bytes + kChunkHeader_bytes + text.size();
  if (bytes.size() - next >= kChunkHeader_bytes && wordAt(bytes, next + 4) == kBinaryChunk) binary_ = chunk(next);
  return text;
}

// Its lists have names, where those of version 2 have numbers.
bool GltfFile::isVersion1() const {
  const json::object* const root = json_.if_object();
  const json::value* const buffers = root == nullptr ? nullptr : root->if_contains("buffers");
  return buffers != nullptr && buffers->is_object();
}

void GltfFile::open(Buffer& buffer, std::string_view uri, const std::string& place) const {
  constexpr std::string_view kBase64 = ";base64,";
  if (uri.starts_with("data:")) {
    const std::size_t data = uri.find(',');
    if (data == std::string_view::npos) throw Error(place + ": its data URI has no data");
    if (!uri.substr(0, data + 1).ends_with(kBase64)) {
      buffer.bytes = uri.substr(data + 1);
      return;
    }
    std::optional<std::string> decoded = fromBase64(uri.substr(data + 1));
    if (!decoded) throw Error(place + ": its data URI is no base64");
    buffer.decoded = std::move(*decoded);
    buffer.bytes = buffer.decoded;
    return;
  }
  if (file_.alone) return;
  try {
    buffer.file = std::make_unique<MappedFile>(companionPath(file_.path, std::string(uri)));
    buffer.bytes = buffer.file->bytes();
  } catch (const Error&) {
    // The reader names the file that is not there.
  }
}

GltfFile::Buffer& GltfFile::bufferOf(std::size_t number) {
  if (buffers_[number] != nullptr) return *buffers_[number];
  auto buffer = std::make_unique<Buffer>();
  const GltfItem item(json_.at("buffers").at(number), fmt::format("buffers/{}", number));
  buffer->size = item.needed("byteLength");
  const json::value* const uri = item.object().if_contains("uri");
  if (uri != nullptr && uri->is_string())
    open(*buffer, uri->as_string(), item.place());
  else if (uri == nullptr && number == 0)
    buffer->bytes = binary_;
  if (buffer->bytes && buffer->bytes->size() < buffer->size)
    item.refuse(fmt::format("it is cut: it tells of {} bytes, and has {}", buffer->size, buffer->bytes->size()));
  buffers_[number] = std::move(buffer);
  return *buffers_[number];
}

std::size_t GltfFile::sizeOfBuffer(std::size_t buffer) { return bufferOf(buffer).size; }

std::optional<std::string_view> GltfFile::bytesOf(std::size_t buffer) { return bufferOf(buffer).bytes; }

std::string GltfFile::text() const {
  std::string text = json::serialize(json_);
  if (!glb_) return text;
  constexpr std::size_t kVersion = 2;
  std::string file = "glTF";
  putWord(file, kVersion);
  putWord(file, 0);  // the length, when it is known
  putChunk(file, kJsonChunk, text, ' ');
  if (binary_) putChunk(file, kBinaryChunk, *binary_, '\0');
  const auto length = static_cast<std::uint32_t>(file.size());
  std::memcpy(file.data() + 8, &length, sizeof length);
  return file;
}

}  // namespace hl
