#include "scene/iso_shape.h"

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.h"

namespace hl {

namespace {

const IsoSurface& isoSurfaceOfShape(const Shape& shape) { return dynamic_cast<const IsoSurface&>(*shape.source); }

// "1 (-480), 2 (370)"
std::string listed(const std::vector<const Instance*>& surfaces) {
  constexpr std::size_t kMaxListed = 8;
  std::ostringstream text;
  for (std::size_t i = 0; i < surfaces.size() && i < kMaxListed; ++i) {
    text << (i == 0 ? "" : ", ") << surfaces[i]->key << " (" << isoSurfaceOf(*surfaces[i])->iso().value << ")";
  }
  text << (surfaces.size() > kMaxListed ? ", ..." : "");
  return text.str();
}

}  // namespace

const IsoSurface* isoSurfaceOf(const Instance& instance) {
  return instance.session == 0 ? dynamic_cast<const IsoSurface*>(instance.shape->source.get()) : nullptr;
}

std::shared_ptr<const Shape> withIso(const Shape& of, const IsoChoice& choice) {
  const IsoSurface& before = isoSurfaceOfShape(of);
  auto source =
      std::make_shared<const IsoSurface>(before.volume(), before.frame(), choice.over(before.iso()), before.matter());
  const Material material = materialAt(*source, of.model.materials.front());
  return makeShape(std::move(source), material, of.model.textures, of.repeat, of.model.appearance);
}

Material materialAt(const IsoSurface& surface, Material material) {
  if (!surface.matter()) return material;
  const MatterRow there = surface.matter()->at(surface.iso().value);
  material.stiffness = there.stiffness.value_or(material.stiffness);
  material.strength_N = there.strength_N.value_or(material.strength_N);
  return material;
}

void setIso(Instance& instance, const IsoChoice& choice) {
  instance.shape = withIso(*instance.shape, choice);
  Surfaces surfaces = *instance.surfaces;
  surfaces.materials.front() = materialAt(isoSurfaceOfShape(*instance.shape), surfaces.materials.front());
  if (surfaces != *instance.surfaces) instance.surfaces = std::make_shared<const Surfaces>(std::move(surfaces));
}

std::uint64_t checkIsoChange(const Snapshot& scene, std::uint64_t surface, const IsoChoice& choice) {
  if (choice.value && !std::isfinite(*choice.value)) throw Error("iso: the value must be a finite number");
  std::vector<const Instance*> surfaces;
  for (const Instance& instance : scene.instances) {
    if (isoSurfaceOf(instance) == nullptr) continue;
    if (instance.key == surface) return surface;
    surfaces.push_back(&instance);
  }
  if (surfaces.empty()) throw Error("iso: the scene of this server has no volume");
  if (surface == 0 && surfaces.size() == 1) return surfaces.front()->key;
  throw Error((surface == 0 ? "iso: say which surface" : "iso: there is no surface " + std::to_string(surface)) +
              "; those of volumes, with their values, are " + listed(surfaces));
}

}  // namespace hl
