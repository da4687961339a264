// OnlyFile: what assimp sees of the disk when a file comes alone: the file itself, through a descriptor that is open
// already. What else the file asks for is not there, and is reported.
#pragma once

#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace hl {

class OnlyFile final : public Assimp::IOSystem {
 public:
  /// `descriptor` outlives it. `ending` as ".obj".
  OnlyFile(int descriptor, const std::string& ending) : descriptor_(descriptor), name_(nameOf(ending)) {}

  /// Under which assimp finds a file of this ending.
  static std::string nameOf(const std::string& ending) { return kStem + ending; }
  const std::string& name() const { return name_; }
  /// From now on this is what the file contains.
  void replace(std::string text) { text_ = std::move(text); }
  /// Last parts of the names of files that were asked for beside it.
  const std::set<std::string>& missing() const { return missing_; }

  bool Exists(const char* file) const override;
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char* mode) override;
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  static constexpr const char* kStem = "hl-sent-file";  // assimp asks for others of the same stem, too

  bool isIt(const std::string& file) const;

  const int descriptor_;
  const std::string name_;
  std::optional<std::string> text_;
  mutable std::set<std::string> missing_;
};

}  // namespace hl
