#include "io/scene_notes.h"

#include <algorithm>

#include "io/decode_scene.h"

namespace hl {

std::vector<std::string> SceneNotes::placesOf(const Said& said) {
  std::vector<std::string> places;
  places.reserve(said.size());
  for (const auto& [where, message] : said) places.push_back(where);
  return places;
}

void SceneNotes::leaveIdleOut(Material& material, const TextureRoom& room, const std::vector<Texture>& textures,
                              const proto::SceneObject& object, const std::string& where) {
  const std::string at = where + ".material";
  const std::string name = object.name().empty() ? "" : " ('" + object.name() + "')";
  for (int i = 0; i < object.material().textures_size(); ++i) {
    const std::string use = pathOf(at + ".textures", i);
    if (object.material().textures(i).quantity() == proto::STIFFNESS)
      unless_there_.emplace_back(use + ".quantity", use + name + " says no quantity: STIFFNESS is taken");
  }
  for (const IdleSetting& idle : hl::leaveIdleOut(material, room, textures)) say(at, at + name + ": " + idle.words);
}

void SceneNotes::forEach(const JsonLines& lines,
                         const std::function<void(std::size_t line, const std::string& message)>& tell) const {
  const std::vector<bool> there = lines.have(placesOf(unless_there_));
  Said all;
  for (std::size_t i = 0; i < there.size(); ++i) {
    if (!there[i]) all.push_back(unless_there_[i]);
  }
  all.insert(all.end(), said_.begin(), said_.end());
  const std::vector<std::size_t> at = lines.linesOf(placesOf(all));
  for (std::size_t i = 0; i < all.size(); ++i) tell(at[i], all[i].second);
}

}  // namespace hl
