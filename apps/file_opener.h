// FileOpener: puts a file that a page has sent in the place of the scene, as `hl touch FILE` shows it.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "io/cad_file.h"
#include "scene/scene_model.h"
#include "session/touch_server.h"

namespace hl {

/// The largest file that a page may send, bytes.
inline constexpr std::uint64_t kUpload_bytes = 256'000'000;

/// The word after which this program reads a file for a server: `hl read-sent NAME`. Not for people.
inline constexpr const char* kReadSent = "read-sent";

class FileOpener {
 public:
  /// `smooth`: a bare model feels as smooth as it looks; false: the user has said how surfaces are shaded. `touch`
  /// outlives this.
  FileOpener(TouchServer& touch, HierarchyKind hierarchy, const CadMeshing& cad, bool smooth)
      : touch_(touch), hierarchy_(hierarchy), cad_(cad), smooth_(smooth) {}

  /// Returns what it is now, as JSON: name, triangles, points, primitives, world_per_device, warnings. Throws
  /// hl::Error, one line, and changes nothing. One call at a time.
  std::string open(int descriptor, const std::string& name);
  /// From now on nothing is opened, and what is under way ends soon. Any thread.
  void giveUp() { given_up_ = true; }

 private:
  SceneModel read(int descriptor, const std::string& name) const;

  TouchServer& touch_;
  const HierarchyKind hierarchy_;
  const CadMeshing cad_;
  const bool smooth_;
  std::atomic<bool> given_up_{false};
};

}  // namespace hl
