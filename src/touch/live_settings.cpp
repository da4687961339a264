#include "touch/live_settings.h"

#include <algorithm>

namespace hl {

LiveSettings::LiveSettings(const TouchSettings& settings, const DeviceInfo& device, const Box& bounds)
    : radius_D_(settings.radius_D),
      side_D_(std::min(settings.side_D, device.smallestReach_D())),
      stiffness_max_N_m_(device.stiffness_max_N_m),
      world_per_device_(settings.world_per_device),
      faults_(settings.faults),
      ledger_(settings.ledger),
      placed_(!bounds.empty()) {
  commands_.workspace = fitted(bounds);
  commands_.radius_W = radius_D_ * commands_.workspace.world_per_device;
  setSurfaces(settings.surfaces);
  setStiffness(settings.stiffness_N_m.value_or(device.stiffness_N_m));
}

Workspace LiveSettings::fitted(const Box& bounds) const {
  Workspace workspace = Workspace::fit(bounds, side_D_);
  if (world_per_device_) workspace.world_per_device = *world_per_device_;
  return workspace;
}

void LiveSettings::setStiffness(double stiffness_N_m) {
  if (!(stiffness_N_m >= 0)) return;
  stiffness_ = std::min(stiffness_N_m, stiffness_max_N_m_);
}

void LiveSettings::setSurfaces(const MaterialOverride& surfaces) {
  const std::lock_guard lock(mutex_);
  MaterialOverride& own = commands_.surfaces;
  own = surfaces;
  for (std::size_t i = 0; i < kNumbers; ++i) {
    std::optional<double>& number = own.number(i);
    if (number && !(*number >= 0)) number.reset();
    if (number) number = std::min(*number, kQuantityInfo[i].most_set);
  }
  commands_for_proxy_.write(commands_);
}

void LiveSettings::restartWith(const Workspace& workspace, double radius_W) {
  commands_.workspace = workspace;
  commands_.radius_W = radius_W;
  ++commands_.restarts;
  commands_for_proxy_.write(commands_);
}

void LiveSettings::setWorkspace(const Workspace& workspace) {
  if (!workspace.valid()) return;
  const std::lock_guard lock(mutex_);
  restartWith(workspace, radiusIn(workspace, commands_.radius_W / commands_.workspace.world_per_device));
  placed_ = true;
}

double LiveSettings::radiusIn(const Workspace& workspace, double radius_D) const {
  return radius_set_ && !placed_ && !world_per_device_ ? commands_.radius_W : radius_D * workspace.world_per_device;
}

void LiveSettings::setRadius(double radius_W) {
  if (!Workspace::validRadius(radius_W)) return;
  const std::lock_guard lock(mutex_);
  radius_set_ = true;
  restartWith(commands_.workspace, radius_W);
}

void LiveSettings::fit(const Box& bounds) {
  const std::lock_guard lock(mutex_);
  if (!world_per_device_) placeAt(bounds);
  placed_ = placed_ || !bounds.empty();
}

double LiveSettings::topOfFitted_D(const Box& bounds) const {
  return bounds.empty() ? 0 : 0.5 * bounds.size().y() / fitted(bounds).world_per_device;
}

void LiveSettings::refit(const Box& bounds) {
  if (bounds.empty()) return;
  const Workspace workspace = fitted(bounds);
  const std::lock_guard lock(mutex_);
  placed_ = true;
  restartWith(workspace, radius_D_ * workspace.world_per_device);
}

void LiveSettings::fitToOthers(const Box& bounds) {
  const std::lock_guard lock(mutex_);
  placeAt(bounds);
}

void LiveSettings::placeAt(const Box& bounds) {
  if (placed_ || bounds.empty()) return;
  const Workspace workspace = fitted(bounds);
  restartWith(workspace, radiusIn(workspace, radius_D_));
  placed_ = true;
}

bool LiveSettings::isPlaced() const {
  const std::lock_guard lock(mutex_);
  return placed_;
}

MaterialOverride LiveSettings::surfaces() const {
  const std::lock_guard lock(mutex_);
  return commands_.surfaces;
}

Workspace LiveSettings::workspace() const {
  const std::lock_guard lock(mutex_);
  return commands_.workspace;
}

double LiveSettings::radius_W() const {
  const std::lock_guard lock(mutex_);
  return commands_.radius_W;
}

}  // namespace hl
