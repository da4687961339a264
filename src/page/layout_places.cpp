#include "page/layout_places.h"

#include <algorithm>

#include "base/utf8.h"
#include "session/state_messages.h"

namespace hl {

namespace {

template <typename List>
bool sameLists(const std::vector<std::shared_ptr<const List>>& a, const std::vector<std::shared_ptr<const List>>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
    return one == other || (one && other && *one == *other);
  });
}

// Of those that count: what is the same in both is not looked at.
template <typename Placed>
bool samePlaced(const std::vector<Placed>& a, const std::vector<Placed>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Placed& one, const Placed& other) {
    return one.instance == other.instance && one.number == other.number;
  });
}

template <typename Spec, typename Message>
void describePlace(const Spec& spec, Message& out) {
  out.set_name(printable(spec.name));
  for (const Vec3& point : spec.points) out.mutable_points()->Add(point.data(), point.data() + 3);
  if (spec.normal) toProto(*spec.normal, *out.mutable_normal());
}

void describeSnap(const SnapSpec& snap, proto::Snap& out) {
  describePlace(snap, out);
  out.set_capture(snap.capture_m);
  out.set_release_n(snap.release_N);
}

void describeField(const FieldSpec& field, proto::Field& out) {
  describePlace(field, out);
  out.set_kind(static_cast<proto::FieldKind>(field.kind));
  out.set_reach(field.reach_m);
  out.set_force_n(field.force_N);
  out.set_stiffness_n_m(field.stiffness_N_m);
  out.set_damping_ns_m(field.damping_Ns_m);
  if (field.kind == FieldKind::kConstant) toProto(field.direction, *out.mutable_direction());
}

}  // namespace

LayoutPlaces LayoutPlaces::of(const Snapshot& snapshot) {
  LayoutPlaces contents{{}, {}, snapshot.snaps, snapshot.fields};
  for (const Instance& instance : snapshot.instances) {
    contents.snap_lists.push_back(instance.snaps);
    contents.field_lists.push_back(instance.fields);
  }
  return contents;
}

bool LayoutPlaces::operator==(const LayoutPlaces& other) const {
  return samePlaced(snaps, other.snaps) && samePlaced(fields, other.fields) &&
         sameLists(snap_lists, other.snap_lists) && sameLists(field_lists, other.field_lists);
}

std::optional<std::uint32_t> LayoutPlaces::indexOf(const PlacedSnap& snap) const {
  const auto same = [&](const PlacedSnap& each) {
    return each.instance == snap.instance && each.number == snap.number;
  };
  const auto at = std::find_if(snaps.begin(), snaps.end(), same);
  if (at == snaps.end()) return std::nullopt;
  return static_cast<std::uint32_t>(at - snaps.begin());
}

void addPlaces(const LayoutPlaces& contents, proto::SceneLayout& layout) {
  for (const PlacedSnap& snap : contents.snaps) {
    proto::PlacedSnap& out = *layout.add_snaps();
    describeSnap((*contents.snap_lists[snap.instance])[snap.number], *out.mutable_snap());
    out.set_placed(snap.instance);
  }
  for (const PlacedField& field : contents.fields) {
    proto::PlacedField& out = *layout.add_fields();
    describeField((*contents.field_lists[field.instance])[field.number], *out.mutable_field());
    out.set_placed(field.instance);
  }
}

}  // namespace hl
