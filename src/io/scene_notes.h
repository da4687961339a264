// Scene notes: what is to be said of a scene file that is no error: what is harmless, but hardly meant.
#pragma once

#include <hl.pb.h>

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "io/json_lines.h"
#include "scene/idle_settings.h"

namespace hl {

/// Places are paths of values, such as "objects[2].material".
class SceneNotes {
 public:
  void say(const std::string& where, const std::string& message) { said_.emplace_back(where, message); }
  /// Takes out of the material of an object, at the path `where`, the textures that nobody can feel where there is this
  /// room for them, and says so; and what else in it has no effect.
  void leaveIdleOut(Material& material, const TextureRoom& room, const std::vector<Texture>& textures,
                    const proto::SceneObject& object, const std::string& where);
  /// Calls `tell` for each note with its line, in the order of saying, and first for what was left unsaid.
  void forEach(const JsonLines& lines,
               const std::function<void(std::size_t line, const std::string& message)>& tell) const;

 private:
  using Said = std::vector<std::pair<std::string, std::string>>;
  static std::vector<std::string> placesOf(const Said& said);

  Said said_;
  Said unless_there_;  // said where the file has no value
};

}  // namespace hl
