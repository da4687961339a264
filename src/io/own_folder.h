// OwnFolder: what assimp sees of the disk when a file is read by its path: the file itself, and others in its folder
// and beneath. A file from somewhere else cannot have any file of its user read. Names in a URI may have percent signs.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <optional>
#include <string>
#include <utility>

namespace hl {

class OwnFolder final : public Assimp::DefaultIOSystem {
 public:
  /// `refused` outlives it, and becomes the path of the last file that was not given.
  OwnFolder(std::string path, std::string& refused) : path_(std::move(path)), refused_(refused) {}

  /// From now on this is what the file itself contains.
  void replace(std::string text) { text_ = std::move(text); }
  bool Exists(const char* file) const override;
  Assimp::IOStream* Open(const char* file, const char* mode) override;

 private:
  bool isOwn(const std::string& file) const;
  std::string found(const std::string& file) const;

  const std::string path_;
  std::optional<std::string> text_;
  std::string& refused_;
};

}  // namespace hl
