// Recorded fields: the forces of a scene's fields in the targets of servo steps and ticks, which few scenes have: they
// are written for all of a block, or for none.
#pragma once

#include <algorithm>
#include <span>

#include "io/value_messages.h"
#include "record/rare_values.h"

namespace hl {

/// `Record` has a ServoTarget `target`; `Message` the lists of one number, or three, for each.
template <typename Record, typename Message>
void addFields(std::span<const Record> records, Message& out) {
  const auto acts = [](const Record& record) {
    return !isZeroToTheBit(record.target.field_N) || !isZeroToTheBit(record.target.field_drag_Ns_m);
  };
  if (std::none_of(records.begin(), records.end(), acts)) return;
  for (const Record& record : records) {
    add(*out.mutable_field_n(), record.target.field_N);
    out.add_field_drag_ns_m(record.target.field_drag_Ns_m);
  }
}

}  // namespace hl
