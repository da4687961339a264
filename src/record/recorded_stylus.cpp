#include "record/recorded_stylus.h"

#include <algorithm>
#include <cmath>

#include "base/fields.h"
#include "record/rare_values.h"

namespace hl {

namespace {

template <typename Has>
bool anyHas(std::span<const ServoRecord> records, const Has& has) {
  return std::any_of(records.begin(), records.end(), [&](const ServoRecord& one) { return has(one.sample.stylus); });
}

bool isUnit(const proto::ServoSteps& in, std::int64_t i) {
  constexpr double kRounding = 1e-9;
  double length2 = 0;
  for (std::int64_t j = 4 * i; j < 4 * i + 4; ++j) {
    const double part = in.stylus_turned(static_cast<int>(j));
    length2 += part * part;
  }
  return std::abs(length2 - 1) <= kRounding;
}

}  // namespace

LaterForms laterOfDevice() {
  const Values now = valuesOf(DeviceInfo{});
  return {{{{now.numbers.size() - 1, 0.0}}, {{now.integers.size() - 1, 0}}}};
}

void addStylus(std::span<const ServoRecord> records, proto::ServoSteps& out) {
  const auto turns = [](const Stylus& one) {
    return !isZeroToTheBit(one.turned.vec()) || one.turned.w() != 1 || !isZeroToTheBit(one.spin_rad_s);
  };
  const bool turn = anyHas(records, turns);
  const bool opens = anyHas(records, [](const Stylus& one) { return !isZeroToTheBit(one.gripper_rad); });
  const bool presses = anyHas(records, [](const Stylus& one) { return !isZeroToTheBit(one.gripper_N); });
  for (const ServoRecord& record : records) {
    const Stylus& stylus = record.sample.stylus;
    if (turn) {
      for (const double part : stylus.turned.coeffs()) out.add_stylus_turned(part);
      add(*out.mutable_stylus_spin_rad_s(), stylus.spin_rad_s);
    }
    if (opens) out.add_gripper_rad(stylus.gripper_rad);
    if (presses) out.add_gripper_n(stylus.gripper_N);
  }
}

Stylus stylusAt(const proto::ServoSteps& in, int i) {
  Stylus stylus;
  if (in.stylus_turned_size() > 0) {
    for (int j = 0; j < 4; ++j) stylus.turned.coeffs()[j] = in.stylus_turned(4 * i + j);
    stylus.spin_rad_s = at(in.stylus_spin_rad_s(), i);
  }
  if (in.gripper_rad_size() > 0) stylus.gripper_rad = in.gripper_rad(i);
  if (in.gripper_n_size() > 0) stylus.gripper_N = in.gripper_n(i);
  return stylus;
}

bool stylusAgrees(const proto::ServoSteps& in, std::int64_t steps) {
  const auto none_or = [](std::int64_t size, std::int64_t all) { return size == 0 || size == all; };
  if (!none_or(in.stylus_turned_size(), 4 * steps) || 4 * in.stylus_spin_rad_s_size() != 3 * in.stylus_turned_size())
    return false;
  for (std::int64_t i = 0; 4 * i < in.stylus_turned_size(); ++i) {
    if (!isUnit(in, i)) return false;
  }
  return none_or(in.gripper_rad_size(), steps) && none_or(in.gripper_n_size(), steps);
}

}  // namespace hl
