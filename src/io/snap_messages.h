// Snaps and fields in messages, for recordings and for the process that reads foreign files. What comes back is the
// same to the bit, or is refused.
#pragma once

#include <recording.pb.h>

#include "scene/field_spec.h"
#include "scene/snap_spec.h"

namespace hl {

void toProto(const SnapSpec& snap, proto::RecordedSnap& out);
/// Throws hl::Error, as what follows.
SnapSpec snapOf(const proto::RecordedSnap& in);
void toProto(const FieldSpec& field, proto::RecordedField& out);
FieldSpec fieldOf(const proto::RecordedField& in);

}  // namespace hl
