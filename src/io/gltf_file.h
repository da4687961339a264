// GltfFile: the JSON of a .gltf or .glb file and the bytes of its buffers, as they are before its reader has it.
#pragma once

#include <boost/json.hpp>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/mapped_file.h"
#include "io/model_file.h"

namespace hl {

class GltfFile {
 public:
  /// Throws hl::Error for a .glb whose chunks are longer than it, and for JSON that is none.
  explicit GltfFile(const ModelFile& file);

  /// May be changed once all buffers have been asked for.
  boost::json::value& json() { return json_; }
  /// Of glTF 1.0 nothing but the JSON is known.
  bool isVersion1() const;

  /// How many bytes the buffer has by its JSON. Throws hl::Error where there are fewer.
  std::size_t sizeOfBuffer(std::size_t buffer);
  /// The bytes; nothing where they are in a file that is not there. Valid as long as this is.
  std::optional<std::string_view> bytesOf(std::size_t buffer);

  /// The file with its JSON as it is now.
  std::string text() const;

 private:
  struct Buffer {
    std::size_t size = 0;
    std::optional<std::string_view> bytes;
    std::string decoded;
    std::unique_ptr<MappedFile> file;
  };

  std::string_view takeChunks(std::string_view bytes);
  Buffer& bufferOf(std::size_t number);
  void open(Buffer& buffer, std::string_view uri, const std::string& place) const;

  const ModelFile file_;
  const MappedFile mapped_;
  std::optional<std::string_view> binary_;  // of a .glb: the chunk after the JSON
  bool glb_ = false;
  boost::json::value json_;
  std::vector<std::unique_ptr<Buffer>> buffers_;
};

}  // namespace hl
