// The order of what is remembered, and how it goes from one list to the other.
#include "bodies/contact_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "bodies/world.h"
#include "guard/realtime_guard.h"

namespace hl::test_contact_memory {
namespace {

// The place says in which order they were added.
RememberedContact contactOf(const ContactPair& pair, std::size_t number) {
  RememberedContact contact;
  contact.pair = pair;
  contact.place.x() = static_cast<double>(number);
  return contact;
}

std::vector<std::pair<ContactPair, double>> listOf(const ContactMemory& memory) {
  std::vector<std::pair<ContactPair, double>> list;
  for (const RememberedContact& contact : memory.all()) list.emplace_back(contact.pair, contact.place.x());
  return list;
}

ContactPair randomPair(std::mt19937& random, std::uint64_t bodies) {
  return {1 + random() % bodies, random() % bodies};
}

// Pairs at random, a few contacts each; a copy is sorted by the library.
TEST(ContactMemory, IsSortedByPairAndThoseOfAPairKeepTheirOrder) {
  std::mt19937 random(6);
  for (const std::size_t count : {0, 1, 2, 3, 10, 1000}) {
    ContactMemory memory;
    memory.reserve(count);
    for (std::size_t i = 0; i < count; ++i) memory.add(contactOf(randomPair(random, 1 + count / 8), i));
    auto expected = listOf(memory);
    std::stable_sort(expected.begin(), expected.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    {
      const RealtimeGuard guard;
      memory.sort();
    }
    EXPECT_EQ(listOf(memory), expected) << count;
  }
}

// As many as a thousand bodies may have, of islands that come in the order opposite to that of their keys.
TEST(ContactMemory, RowsThatCameByIslandsAreSortedWithinAStep) {
  ContactMemory memory;
  const std::size_t bodies = 1000, count = mostRows(bodies);
  memory.reserve(count);
  for (std::size_t i = 0; i < count; ++i) memory.add(contactOf({bodies - i * bodies / count, 0}, i));
  memory.sort();
  EXPECT_EQ(memory.all().size(), count);
  EXPECT_TRUE(std::is_sorted(memory.all().begin(), memory.all().end(),
                             [](const auto& x, const auto& y) { return x.pair < y.pair; }));
}

// Those of some bodies go behind what the other list has of the same pairs; what finds no room is forgotten.
TEST(ContactMemory, WhatGoesToAnotherListIsMergedIntoIt) {
  std::mt19937 random(16);
  for (int round = 0; round < 200; ++round) {
    const std::size_t count = random() % 40, there = random() % 40, room = there + random() % 40;
    ContactMemory from, to;
    from.reserve(count);
    to.reserve(room);
    for (std::size_t i = 0; i < count; ++i) from.add(contactOf(randomPair(random, 6), i));
    for (std::size_t i = 0; i < there; ++i) to.add(contactOf(randomPair(random, 6), 1000 + i));
    from.sort();
    to.sort();
    const auto belongs = [](const RememberedContact& contact) { return contact.pair.a % 2 == 0; };
    std::vector<std::pair<ContactPair, double>> kept, merged = listOf(to);
    for (const RememberedContact& contact : from.all()) {
      auto& list = belongs(contact) ? merged : kept;
      if (!belongs(contact) || merged.size() < room) list.emplace_back(contact.pair, contact.place.x());
    }
    std::stable_sort(merged.begin(), merged.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    {
      const RealtimeGuard guard;
      from.moveTo(to, belongs);
    }
    ASSERT_EQ(listOf(from), kept) << round;
    ASSERT_EQ(listOf(to), merged) << round;
  }
}

}  // namespace
}  // namespace hl::test_contact_memory
