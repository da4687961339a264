#include "io/scene_inputs.h"

#include <algorithm>
#include <array>
#include <boost/json.hpp>
#include <cctype>
#include <filesystem>
#include <functional>
#include <map>
#include <string_view>
#include <unordered_set>

#include "base/error.h"
#include "base/plain_file.h"
#include "base/text.h"
#include "builtin.h"
#include "io/byte_file.h"
#include "io/cad_file.h"
#include "io/dicom_file.h"
#include "io/file_ending.h"
#include "io/read_clouds.h"
#include "io/read_heights.h"
#include "io/read_volumes.h"
#include "io/reading_program.h"
#include "io/sha256.h"
#include "io/vdb_file.h"

namespace hl {

namespace {

namespace fs = std::filesystem;
namespace json = boost::json;

// Files of these endings, as those of the readers of samples, name no others.
constexpr std::array kNameNone{".stl", ".png", ".jpg", ".jpeg", ".bin", ".raw", ".zip", ".3mf"};

constexpr std::size_t kLongestName = 4096;  // PATH_MAX

bool mayNameOthers(const fs::path& path) {
  const std::string ending = endingOf(path.string());
  if (ending == ".nhdr") return true;
  const bool none = std::find(kNameNone.begin(), kNameNone.end(), ending) != kNameNone.end();
  return !none && !readsHeights(ending) && !readsVolumes(ending) && !readsClouds(ending) && !readsCad(ending) &&
         !readsVdb(ending);
}

std::string unpackedBytesOf(const fs::path& path) {
  const std::string name = path.string();
  ByteFile file(name, beginsAsGzip(name) ? ByteFile::Form::kGzip : ByteFile::Form::kPlain);
  std::string bytes;
  constexpr std::size_t kPiece_bytes = 1 << 20;
  for (std::size_t size = 0, got = 1; got > 0; size += got) {
    bytes.resize(size + kPiece_bytes);
    got = file.some(bytes.data() + size, kPiece_bytes);
    bytes.resize(size + got);
  }
  return bytes;
}

// With an ending as files have, which numbers have not: "part.mtl", not "0.5" or "1.e5".
bool looksLikeAName(std::string_view text) {
  constexpr std::size_t kLongestEnding = 6;
  const std::size_t dot = text.rfind('.');
  if (text.size() > kLongestName || dot == std::string_view::npos) return false;
  const std::string_view ending = text.substr(dot + 1);
  const auto letter = [](char c) { return isLetterOrDigit(c); };
  return !ending.empty() && ending.size() <= kLongestEnding && std::all_of(ending.begin(), ending.end(), letter) &&
         std::any_of(ending.begin(), ending.end(), [](char c) { return isLetter(c); }) &&
         std::none_of(text.begin(), text.end(), [](unsigned char c) { return c < ' '; });
}

// "a%20b" of an URI is "a b".
std::string unescaped(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escape =
        text[i] == '%' && i + 2 < text.size() && std::isxdigit(text[i + 1]) && std::isxdigit(text[i + 2]);
    plain += escape ? static_cast<char>(std::stoi(std::string(text.substr(i + 1, 2)), nullptr, 16)) : text[i];
    if (escape) i += 2;
  }
  return plain;
}

using UseName = std::function<void(std::string_view)>;

// The line, what follows each of its words, each word, and what stands between quotes.
void namesInLine(std::string_view line, const UseName& use) {
  if (line.find('.') == std::string_view::npos) return;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t end = std::min(line.find_first_of(" \t\r,;=[]{}()<>", at), line.size());
    const std::string_view rest = trimmed(line.substr(at));
    if (looksLikeAName(rest)) use(rest);
    const std::string_view word = line.substr(at, end - at);
    if (looksLikeAName(word)) use(word);
    at = end + 1;
  }
  for (const char quote : {'"', '\''}) {
    for (std::size_t begin = line.find(quote); begin != std::string_view::npos;) {
      const std::size_t end = line.find(quote, begin + 1);
      if (end == std::string_view::npos) break;
      const std::string_view quoted = line.substr(begin + 1, end - begin - 1);
      if (looksLikeAName(quoted)) use(quoted);
      begin = end;
    }
  }
}

// Zeros end the names in binary files.
void namesInText(std::string_view text, const UseName& use) {
  constexpr std::string_view kEnds("\n\0", 2);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(kEnds, at), text.size());
    namesInLine(text.substr(at, end - at), use);
    at = end + 1;
  }
}

// Also those of folders, with DICOM files.
void namesInJson(const json::value& value, const UseName& use) {
  if (const json::string* text = value.if_string()) {
    use(std::string_view(text->data(), text->size()));
  } else if (const json::array* array = value.if_array()) {
    for (const json::value& each : *array) namesInJson(each, use);
  } else if (const json::object* object = value.if_object()) {
    for (const auto& each : *object) namesInJson(each.value(), use);
  }
}

/// Collects the files of one scene.
class InputCollector {
 public:
  explicit InputCollector(const fs::path& scene) : folder_(scene.parent_path()) {}

  void add(const fs::path& path) {
    std::error_code failed;
    if (fs::is_directory(path, failed)) return addDicom(path);
    if (!addFile(path) || !mayNameOthers(path)) {
      if (looksLikeDicom(path.string())) addDicom(path.parent_path());
      return;
    }
    const std::string bytes = unpackedBytesOf(path);
    const fs::path beside = path.parent_path();
    std::unordered_set<std::string> seen;
    const UseName use = [&](std::string_view name) {
      if (seen.insert(std::string(name)).second) addNamed(name, beside);
    };
    const std::string ending = endingOf(path.string());
    json::error_code no_json;
    if (ending == ".json" || ending == ".gltf") {
      const json::value value = json::parse(json::string_view(bytes.data(), bytes.size()), no_json);
      namesInJson(value, use);
    } else {
      namesInText(bytes, use);
    }
  }
  /// By name; `first` before all.
  std::vector<SceneInput> take(const fs::path& first) const {
    std::vector<SceneInput> inputs;
    for (const auto& [name, path] : files_) {
      const auto place = path == first ? inputs.begin() : inputs.end();
      inputs.insert(place, {name, sha256OfFile(path.string())});
    }
    return inputs;
  }

 private:
  bool addFile(const fs::path& path) {
    const std::string name = path.lexically_relative(folder_).string();
    if (!files_.emplace(name.empty() ? path.string() : name, path).second) return false;
    const std::string ending = endingOf(path.string());
    if (readsCad(ending)) addProgram("hl-cad");
    if (readsVdb(ending)) addProgram("hl-vdb");
    return true;
  }
  void addProgram(const std::string& name) {
    try {
      files_.emplace(name, readingProgram(name, ""));
    } catch (const Error&) {  // the task that reads the file will report it
    }
  }
  void addDicom(const fs::path& folder) {
    std::error_code failed;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, failed)) {
      if (entry.is_regular_file(failed) && looksLikeDicom(entry.path().string()))
        addFile(folder / entry.path().filename());
    }
  }
  void addNamed(std::string_view name, const fs::path& beside) {
    if (name.empty() || name.size() > kLongestName) return;
    for (const std::string& form : {std::string(name), unescaped(name)}) {
      for (const fs::path& from : {beside, folder_}) {
        std::error_code failed;
        const fs::path path = (from / form).lexically_normal();
        const bool folder_of_files = fs::is_directory(path, failed) && isDicomFolder(path.string());
        if (fs::is_regular_file(path, failed) || folder_of_files) return add(path);
      }
    }
  }

  const fs::path folder_;
  std::map<std::string, fs::path> files_;  // by their names in the result
};

}  // namespace

std::vector<SceneInput> sceneInputs(const std::string& spec) {
  std::error_code failed;
  if (isBuiltinScene(spec) || (spec.find_first_of("./") == std::string::npos && !fs::exists(spec, failed))) return {};
  const fs::path path = fs::path(spec).lexically_normal();
  if (!fs::is_directory(path, failed)) checkPlainFile(spec);
  InputCollector collector(path);
  collector.add(path);
  return collector.take(path);
}

}  // namespace hl
