#include "bodies/world_hash.h"

#include <bit>
#include <concepts>
#include <type_traits>

#include "base/fields.h"
#include "base/splitmix64.h"

namespace hl {

namespace {

/// Takes in each number that it is shown, in this order.
class BitHasher {
 public:
  explicit BitHasher(std::uint64_t seed) : value_(seed) {}
  void operator()(const double& number) { add(std::bit_cast<std::uint64_t>(number)); }
  template <int kRows, int kColumns>
  void operator()(const Eigen::Matrix<double, kRows, kColumns>& m) {
    for (Eigen::Index i = 0; i < m.size(); ++i) add(std::bit_cast<std::uint64_t>(m(i)));
  }
  template <typename T>
  requires std::integral<T> || std::is_enum_v<T>
  void operator()(const T& integer) { add(static_cast<std::uint64_t>(integer)); }
  std::uint64_t value() const { return value_; }

 private:
  void add(std::uint64_t bits) { value_ = splitmix64(value_ ^ bits); }

  std::uint64_t value_;
};

// By value: the fields of a constant structure cannot be visited.
template <typename T>
std::uint64_t hashOfFields(T value, std::uint64_t seed) {
  BitHasher hasher(seed);
  visitFields(value, hasher);
  return hasher.value();
}

}  // namespace

// Bodies and contacts are hashed apart and then in a row, so that the processor works at several at once.
std::uint64_t hashOf(const World& world, const WorldState& state) {
  BitHasher hasher(hashOfFields(state.energy, state.steps));
  hasher(state.bodies.size());
  for (std::size_t i = 0; i < state.bodies.size(); ++i) hasher(hashOfFields(state.bodies[i], world.bodies[i].key));
  hasher(state.joints.size());
  for (std::size_t i = 0; i < state.joints.size(); ++i) hasher(hashOfFields(state.joints[i], world.joints[i].key));
  hasher(state.gravity_m_s2);
  for (const ContactMemory* const memory : {&state.memory, &state.asleep}) {
    hasher(memory->all().size());
    for (const RememberedContact& contact : memory->all()) hasher(hashOfFields(contact, 0));
  }
  return hasher.value();
}

}  // namespace hl
