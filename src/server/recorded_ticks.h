// Ticks of the proxy as a recording holds them: all that goes into one and comes out of it.
#pragma once

#include <recording.pb.h>

#include <cstdint>
#include <span>
#include <vector>

#include "base/values.h"
#include "server/proxy_loop.h"

namespace hl {

/// What a tick is told.
struct TickInput {
  std::int64_t time_ns = 0;
  Vec3 finger_D = Vec3::Zero();
  ProxyCommands commands;
  SpringOfServo spring;
};

struct TickRecord {
  TickInput in;
  std::uint64_t scene = 0;  ///< identity of the snapshot
  ServoTarget target;
  Vec3 proxy = Vec3::Zero();  ///< world
  std::uint64_t contacts = 0;
  std::int64_t work_ns = 0;
};

/// What seldom changes from tick to tick.
struct TickContext {
  ProxyCommands commands;
  SpringOfServo spring;
  std::uint64_t scene = 0;
};

template <typename Visit>
void visitFields(ProxySettings& settings, Visit& visit) {
  visit(settings.iteration_cap);
  visit(settings.shading);
}

template <typename T, typename Visit>
void visitOptional(std::optional<T>& optional, Visit& visit) {
  bool there = optional.has_value();
  T value = optional.value_or(T{});
  visit(there);
  visit(value);
  optional = there ? std::optional<T>(value) : std::nullopt;
}

template <typename Visit>
void visitFields(TickContext& context, Visit& visit) {
  MaterialOverride& surfaces = context.commands.surfaces;
  for (std::optional<double>* number :
       {&surfaces.stiffness, &surfaces.static_friction, &surfaces.dynamic_friction, &surfaces.viscosity_Ns_m})
    visitOptional(*number, visit);
  visitOptional(surfaces.smooth, visit);
  visit(surfaces.textures);
  visit(context.commands.workspace.origin_W);
  visit(context.commands.workspace.world_per_device);
  visit(context.commands.radius_W);
  visit(context.commands.restarts);
  visit(context.spring.stiffness_N_m);
  visit(context.spring.ledger);
  visit(context.spring.period_s);
  visit(context.scene);
}

/// Consecutive ticks, at least one; `first` is the number of the first.
void toProto(std::span<const TickRecord> records, std::uint64_t first, proto::ProxyTicks& out);
/// Throws hl::Error when the message does not fit.
std::vector<TickRecord> fromProto(const proto::ProxyTicks& in);

}  // namespace hl
