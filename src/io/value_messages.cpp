#include "io/value_messages.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "geometry/primitive.h"

namespace hl {

namespace {

constexpr double kAny = std::numeric_limits<double>::max();

}  // namespace

void toProto(const Values& values, proto::Values& out) {
  out.mutable_numbers()->Add(values.numbers.begin(), values.numbers.end());
  out.mutable_integers()->Add(values.integers.begin(), values.integers.end());
}

Values fromProto(const proto::Values& in) {
  return {{in.numbers().begin(), in.numbers().end()}, {in.integers().begin(), in.integers().end()}};
}

void add(google::protobuf::RepeatedField<double>& list, const Vec3& v) { list.Add(v.data(), v.data() + 3); }
Vec3 at(const google::protobuf::RepeatedField<double>& list, int i) {
  return {list[3 * i], list[3 * i + 1], list[3 * i + 2]};
}

void checkRanges(const std::string& what, std::initializer_list<FieldRange> fields) {
  for (const FieldRange& field : fields) {
    if (field.value >= field.least && field.value <= field.most) continue;
    const std::string up_to = field.most > field.least ? fmt::format(" to {}", field.most) : "";
    throw Error(
        fmt::format("{} makes no sense: {} is {}, not {}{}", what, field.name, field.value, field.least, up_to));
  }
}

void checkRecorded(const DeviceInfo& info) {
  // Ten times what any device takes, and a workspace that a hand would not reach the ends of.
  constexpr double kSlowest_Hz = 1, kFastest_Hz = 100e3, kWidest_m = 1e3;
  for (int i = 0; i < 3; ++i) {
    checkRanges("the device", {{"workspace_min", info.workspace_min[i], -kWidest_m, kWidest_m},
                               {"workspace_max", info.workspace_max[i], info.workspace_min[i], kWidest_m}});
  }
  checkRanges("the device", {{"force_max_N", info.force_max_N, 0, kAny},
                             {"force_continuous_N", info.force_continuous_N, 0, kAny},
                             {"force_rate_max_N_s", info.force_rate_max_N_s, 0, kAny},
                             {"stiffness_N_m", info.stiffness_N_m, 0, kAny},
                             {"stiffness_max_N_m", info.stiffness_max_N_m, 0, kAny},
                             {"damping_Ns_m", info.damping_Ns_m, 0, kAny},
                             {"friction_N", info.friction_N, 0, kAny},
                             {"resolution_m", info.resolution_m, 0, kAny},
                             {"velocity_max_m_s", info.velocity_max_m_s, 0, kAny},
                             {"servo_rate_Hz", info.servo_rate_Hz, kSlowest_Hz, kFastest_Hz},
                             {"servo_rate_max_Hz", info.servo_rate_max_Hz, kSlowest_Hz, kFastest_Hz}});
}

void checkRecorded(const Material& material) {
  for (std::size_t i = 0; i < kNumbers; ++i) {
    const QuantityInfo& info = kQuantityInfo[i];
    checkRanges("a material", {{info.field, material.*kMaterialNumbers[i], 0, info.most}});
    const TextureUse& use = material.textures[i];
    checkRanges("a texture of a material", {{"low", use.low, 0, info.most}, {"high", use.high, 0, info.most}});
  }
  const TextureUse& height = material.textureOf(Quantity::kHeight);
  checkRanges("a bump map of a material",
              {{"low", height.low, -kMaxHeight_m, kMaxHeight_m}, {"high", height.high, -kMaxHeight_m, kMaxHeight_m}});
}

void checkRecorded(const MaterialOverride& surfaces) {
  for (std::size_t i = 0; i < kNumbers; ++i) {
    const QuantityInfo& info = kQuantityInfo[i];
    checkRanges("what is set for all surfaces", {{info.field, surfaces.number(i).value_or(0), 0, info.most}});
  }
}

void checkRecorded(const Pose& pose, const std::string& what) {
  // Rotations are computed: to 1e-12, or so.
  constexpr double kTurned = 1e-6;
  const Mat3 off = pose.rotation * pose.rotation.transpose() - Mat3::Identity();
  const bool rigid = (off.array().abs() < kTurned).all();  // unlike maxCoeff(), false for NaN
  if (!rigid || !withinReach(pose.origin))
    throw Error(what + " makes no sense: a pose in it is not rigid, or out of reach");
}

void requireFit(Fit fit, const std::string& what) {
  if (fit == Fit::kOtherForm)
    throw Error(what + " has another form than in this version of HL: replay it with the one that made it");
  if (fit == Fit::kImpossible) throw Error(what + " makes no sense: it has a number that stands for nothing");
}

LaterForms laterOfMaterial() {
  const TextureUse none;
  LaterForms forms;
  for (std::size_t first = kNumbers - 1; first >= kNumbers - kLaterQuantities; --first) {
    LaterValues& later = forms.emplace_back();
    for (std::size_t i = first; i < kNumbers; ++i) later.numbers.emplace_back(i, kQuantityInfo[i].otherwise);
    for (std::size_t i = first; i < kNumbers; ++i) {
      later.numbers.emplace_back(kNumbers + 2 * i, none.low);
      later.numbers.emplace_back(kNumbers + 2 * i + 1, none.high);
      later.integers.emplace_back(1 + i, static_cast<std::int64_t>(none.texture));
    }
  }
  return forms;
}

LaterForms laterOfOverride(std::size_t numbers_before, std::size_t integers_before) {
  LaterForms forms;
  for (std::size_t first = kNumbers - 1; first >= kNumbers - kLaterQuantities; --first) {
    LaterValues& later = forms.emplace_back();
    for (std::size_t i = first; i < kNumbers; ++i) {
      later.numbers.emplace_back(numbers_before + i, 0);
      later.integers.emplace_back(integers_before + i, 0);
    }
  }
  return forms;
}

Values withLater(Values values, const Values& now, const LaterForms& forms) {
  const auto later = std::find_if(forms.begin(), forms.end(), [&](const LaterValues& form) {
    return values.numbers.size() + form.numbers.size() == now.numbers.size() &&
           values.integers.size() + form.integers.size() == now.integers.size();
  });
  if (later == forms.end()) return values;
  const auto insert = [](auto& list, const auto& added) {
    for (const auto& [at, value] : added) list.insert(list.begin() + static_cast<std::ptrdiff_t>(at), value);
  };
  insert(values.numbers, later->numbers);
  insert(values.integers, later->integers);
  return values;
}

void checkTime(std::int64_t time_ns, const char* what) {
  if (time_ns < -kMaxTime_ns || time_ns > kMaxTime_ns)
    throw Error(fmt::format("{} is at {} ns, which no clock tells", what, time_ns));
}

}  // namespace hl
