// Structures in the messages of a recording, and the rule that a file may say anything: a number that no session has
// is refused with one line that names it.
#pragma once

#include <recording.pb.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "base/values.h"
#include "device/device.h"
#include "scene/material.h"
#include "scene/pose.h"

namespace hl {

void toProto(const Values& values, proto::Values& out);
Values fromProto(const proto::Values& in);

/// Lists of vectors, three numbers each.
void add(google::protobuf::RepeatedField<double>& list, const Vec3& v);
Vec3 at(const google::protobuf::RepeatedField<double>& list, int i);

/// A field, and what it may be.
struct FieldRange {
  const char* name;
  double value, least, most;
};

/// Throws hl::Error for the first field that is out of its range, or no number. `what` has the fields: "the device".
void checkRanges(const std::string& what, std::initializer_list<FieldRange> fields);
/// What a device, or a surface, can be. Throws hl::Error.
void checkRecorded(const DeviceInfo& info);
void checkRecorded(const Material& material);
void checkRecorded(const MaterialOverride& surfaces);
/// That it is rigid, and not out of reach. `what` has it: "a motion".
void checkRecorded(const Pose& pose, const std::string& what);

/// Throws the hl::Error that says why the values of `what` do not fit.
void requireFit(Fit fit, const std::string& what);

/// Sets `value` to what was recorded of it. Throws hl::Error.
template <typename T>
void readValues(const proto::Values& in, const std::string& what, T& value) {
  requireFit(setFrom(fromProto(in), value), what);
}

/// Quantities that were added to base/quantities.def since recordings are read that lack some of the last of them.
inline constexpr std::size_t kLaterQuantities = 2;

/// Numbers and integers of a structure, and where they stand in its lists, that recordings of an earlier form do not
/// have. By rising places.
struct LaterValues {
  std::vector<std::pair<std::size_t, double>> numbers;
  std::vector<std::pair<std::size_t, std::int64_t>> integers;
};
/// Of the form before the last quantity, of that before the last two, and so on.
using LaterForms = std::vector<LaterValues>;
/// Of a Material; of a structure with a MaterialOverride after so many numbers and integers.
LaterForms laterOfMaterial();
LaterForms laterOfOverride(std::size_t numbers_before, std::size_t integers_before);
/// The values of an earlier form, as if those had been there; others stay as they are. `now`: those of the form of
/// today.
Values withLater(Values values, const Values& now, const LaterForms& forms);

/// As readValues(), of a recording that may have been made before the last quantities were added.
template <typename T>
void readValues(const proto::Values& in, const std::string& what, T& value, const LaterForms& later) {
  requireFit(setFrom(withLater(fromProto(in), valuesOf(value), later), value), what);
}

/// Times of a recording: no further from zero than this, so that twice the difference of two is a number of 64 bits.
inline constexpr std::int64_t kMaxTime_ns = std::int64_t{1} << 61;
/// Throws hl::Error for a time beyond that.
void checkTime(std::int64_t time_ns, const char* what);

}  // namespace hl
