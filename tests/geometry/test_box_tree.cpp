// BoxTree against looking at every box.
#include "geometry/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/scenes.h"
#include "guard/realtime_guard.h"

namespace hl::test_box_tree {
namespace {

std::vector<Box> randomBoxes(test::Random& random, int count) {
  std::vector<Box> boxes;
  for (int i = 0; i < count; ++i) {
    Box box;
    if (random.below(20) != 0) {  // else empty
      box.extend(random.inCube(1));
      if (random.below(10) != 0) box.extend(box.min + 0.2 * random.uniform(0, 1) * (random.inCube(1) + Vec3::Ones()));
    }
    boxes.push_back(random.below(10) == 0 && !boxes.empty() ? boxes.front() : box);
  }
  return boxes;
}

std::vector<std::uint32_t> met(const BoxTree& tree, const Box& region) {
  std::vector<std::uint32_t> numbers;
  tree.visitMet(region, [&](std::uint32_t number) { numbers.push_back(number); });
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

std::vector<std::uint32_t> metByAll(const std::vector<Box>& boxes, const Box& region) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (!boxes[i].empty() && boxes[i].meets(region)) numbers.push_back(i);
  }
  return numbers;
}

TEST(BoxTree, FindsWhatLookingAtEveryBoxFinds) {
  test::Random random(5);
  for (const int count : {0, 1, 3, 4, 5, 9, 100, 2000}) {
    const std::vector<Box> boxes = randomBoxes(random, count);
    const BoxTree tree(boxes);
    for (int query = 0; query < 200; ++query) {
      Box region;
      region.extend(random.inCube(1.2));
      region.extend(region.min + random.uniform(0, 0.5) * Vec3::Ones());
      ASSERT_EQ(met(tree, region), metByAll(boxes, region));
    }
    // A touch at one point counts.
    for (const Box& box : boxes) {
      if (box.empty()) continue;
      ASSERT_EQ(met(tree, {box.max, box.max}), metByAll(boxes, {box.max, box.max}));
    }
  }
}

TEST(BoxTree, ManyCopiesOfOneBoxAreAllFound) {
  const std::vector<Box> boxes(1000, Box{Vec3::Zero(), Vec3::Ones()});
  EXPECT_EQ(met(BoxTree(boxes), {Vec3::Ones(), Vec3::Ones()}).size(), boxes.size());
}

TEST(BoxTree, AVisitMayShrinkTheRegion) {
  test::Random random(6);
  const std::vector<Box> boxes = randomBoxes(random, 500);
  const BoxTree tree(boxes);
  Box region{-Vec3::Ones(), Vec3::Ones()};
  int visits = 0;
  tree.visitMet(region, [&](std::uint32_t) {
    ++visits;
    region = {2 * Vec3::Ones(), 2 * Vec3::Ones()};
  });
  EXPECT_EQ(visits, 1);
}

TEST(BoxTree, AskingAllocatesNothing) {
  test::Random random(7);
  const BoxTree tree(randomBoxes(random, 1000));
  std::size_t found = 0;
  const RealtimeGuard guard;
  tree.visitMet({Vec3::Zero(), Vec3::Constant(0.5)}, [&](std::uint32_t) { ++found; });
  EXPECT_GT(found, 0u);
}

}  // namespace
}  // namespace hl::test_box_tree
