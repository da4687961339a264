// What servers of a shared world send of an object: read and written again it is the same, to the bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "base/error.h"
#include "builtin.h"
#include "io/load_scene_file.h"
#include "scene/scene_model.h"
#include "share/item_content.h"
#include "share/share_messages.h"

namespace hl::test::test_item_content {
namespace {

std::shared_ptr<const Snapshot> sceneOf(const std::string& name) {
  const std::string file = std::string(HL_SCENES) + "/examples/" + name + ".hl.json";
  return makeSnapshot(isBuiltinScene(name) ? makeBuiltinWorld(name) : loadSceneFile(file));
}

Instance readBack(const WrittenItem& item) {
  return ItemReader().read(*item.content, *item.shape.bytes, *item.surfaces.bytes);
}

class ItemContent : public testing::TestWithParam<const char*> {};

TEST_P(ItemContent, IsTheSameToTheBitWhenItIsReadAndWrittenAgain) {
  const auto scene = sceneOf(GetParam());
  ASSERT_FALSE(scene->instances.empty());
  ItemWriter writer;
  for (const Instance& instance : scene->instances) {
    const WrittenItem first = writer.write(instance, false);
    const Instance there = readBack(first);
    const WrittenItem second = ItemWriter().write(there, false);
    EXPECT_EQ(first.shape.name, second.shape.name);
    EXPECT_EQ(first.surfaces.name, second.surfaces.name);
    EXPECT_EQ(first.content->SerializeAsString(), second.content->SerializeAsString());
    EXPECT_EQ(there.movesAsBody(), instance.movesAsBody());
    EXPECT_EQ(there.surfaces->materials, instance.surfaces->materials);
    EXPECT_EQ(there.shape->bounds.min, instance.shape->bounds.min);
    EXPECT_EQ(there.shape->elements(), instance.shape->elements());
  }
}

INSTANTIATE_TEST_SUITE_P(OfScenes, ItemContent,
                         testing::Values("workshop", "terrain:2000", "blocks", "clouds", "depth", "fields", "heights",
                                         "hollow", "implicit", "parts", "patches", "snaps", "textured_heights",
                                         "textured_tiles", "volume"),
                         [](const auto& one) {
                           std::string name = one.param;
                           std::replace(name.begin(), name.end(), ':', '_');
                           return name;
                         });

TEST(ItemWriterTest, WritesAShapeOfSeveralObjectsOnce) {
  const auto scene = sceneOf("blocks");
  ItemWriter writer;
  const WrittenItem a = writer.write(scene->instances[0], false), b = writer.write(scene->instances[0], true);
  EXPECT_EQ(a.shape.bytes, b.shape.bytes);
  EXPECT_NE(a.content->SerializeAsString(), b.content->SerializeAsString());
}

TEST(ItemReaderTest, MakesAShapeOfSeveralObjectsOnce) {
  const WrittenItem item = ItemWriter().write(sceneOf("blocks")->instances[0], false);
  ItemReader reader;
  const Instance a = reader.read(*item.content, *item.shape.bytes, *item.surfaces.bytes);
  const Instance b = reader.read(*item.content, "not even read", "the same");
  EXPECT_EQ(a.shape, b.shape);
  EXPECT_EQ(a.surfaces, b.surfaces);
}

TEST(ItemReaderTest, CountsWhatItMakesAndMakesNothingThatDoesNotFit) {
  const WrittenItem item = ItemWriter().write(*makeSnapshot(makeBuiltinScene("sphere:2000"))->instances.begin(), false);
  const MemoryBudget most(100'000'000), few(item.shape.name.bytes);
  {
    const Instance made = ItemReader(most).read(*item.content, *item.shape.bytes, *item.surfaces.bytes);
    EXPECT_GT(most.used_bytes(), item.shape.name.bytes);
    EXPECT_LT(most.used_bytes(), 8 * item.shape.name.bytes);
  }
  EXPECT_EQ(most.used_bytes(), 0);
  EXPECT_THROW(ItemReader(few).read(*item.content, *item.shape.bytes, *item.surfaces.bytes), Error);
  EXPECT_EQ(few.used_bytes(), 0);
}

TEST(ItemReaderTest, RefusesWhatMakesNoSense) {
  const WrittenItem item = ItemWriter().write(sceneOf("blocks")->instances[0], false);
  const auto refused = [&](const proto::ShareContent& content, const std::string& shape, const std::string& surfaces) {
    EXPECT_THROW(ItemReader().read(content, shape, surfaces), Error);
  };
  refused(*item.content, "no blocks", *item.surfaces.bytes);
  refused(*item.content, *item.surfaces.bytes, *item.surfaces.bytes);
  refused(*item.content, *item.shape.bytes, *item.shape.bytes);
  refused(*item.content, "", "");
  proto::ShareContent other = *item.content;
  other.set_body(!other.body());
  refused(other, *item.shape.bytes, *item.surfaces.bytes);
  other = *item.content;
  other.set_look("");
  refused(other, *item.shape.bytes, *item.surfaces.bytes);
  other.set_look(*item.shape.bytes);
  refused(other, *item.shape.bytes, *item.surfaces.bytes);
}

}  // namespace
}  // namespace hl::test::test_item_content
