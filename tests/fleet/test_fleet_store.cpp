// The store: what is kept is found, what was cut or changed is not, and a failure lasts until there is a result.
#include "fleet/fleet_store.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "fleet/beside.h"
#include "temp_folder.h"

namespace hl::test_fleet_store {
namespace {

namespace fs = std::filesystem;

const std::string kName(64, 'a');

FleetResult sample() {
  FleetResult result;
  result.name = kName;
  result.summary.ticks = 3;
  result.rows_sha256 = sha256Of("rows");
  return result;
}

fs::path onlyFile() {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(test::tempFile("results"))) {
    if (entry.is_regular_file()) return entry.path();
  }
  return {};
}

TEST(FleetStores, FindWhatTheyKeep) {
  const FleetStore store(test::tempFile("results"));
  EXPECT_FALSE(store.find(kName));
  store.keep(sample());
  const auto found = store.find(kName);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->result.summary.ticks, 3);
  EXPECT_EQ(found->sha256, sha256Of(bytesOf(sample())));
  store.keep(sample());  // twice is as once
  EXPECT_EQ(store.find(kName)->sha256, found->sha256);
}

TEST(FleetStores, DoNotFindWhatWasCutOrChanged) {
  const FleetStore store(test::tempFile("results"));
  store.keep(sample());
  const fs::path file = onlyFile();
  const auto size = fs::file_size(file);
  for (std::uintmax_t cut : {std::uintmax_t{0}, std::uintmax_t{20}, size - 1}) {
    store.keep(sample());
    fs::resize_file(file, cut);
    EXPECT_FALSE(store.find(kName)) << cut;
  }
  for (std::uintmax_t place = 0; place < size; ++place) {
    store.keep(sample());
    std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekg(static_cast<std::streamoff>(place));
    const auto byte = static_cast<char>(bytes.get() ^ 1);
    bytes.seekp(static_cast<std::streamoff>(place));
    bytes.put(byte);
    bytes.close();
    EXPECT_FALSE(store.find(kName)) << place;
  }
}

TEST(FleetStores, DoNotTakeAResultForAnotherOne) {
  const FleetStore store(test::tempFile("results"));
  store.keep(sample());
  const std::string other(64, 'b');
  fs::create_directories(test::tempFile("results/bb"));
  fs::copy_file(onlyFile(), test::tempFile("results/bb/" + other + ".result"));
  EXPECT_FALSE(store.find(other));
}

TEST(FleetStores, RememberAFailureUntilThereIsAResult) {
  const FleetStore store(test::tempFile("results"));
  const std::string name(64, 'c');
  store.keepFailure(name, "it was too hot");
  EXPECT_EQ(store.failureOf(name), "it was too hot");
  EXPECT_FALSE(store.find(name));
  FleetResult result = sample();
  result.name = name;
  store.keep(result);
  EXPECT_FALSE(store.failureOf(name));
  EXPECT_TRUE(store.find(name));
}

void makeOld(const fs::path& file) {
  fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::minutes(11));
}

TEST(FleetStores, RemoveWhatKilledProgramsLeft) {
  const FleetStore store(test::tempFile("remains"));
  store.keep(sample());
  fs::create_directories(test::tempFile("remains/bb"));
  const fs::path left = test::tempFile("remains/bb/x.result.part-0123456789abcdef");
  const fs::path written_now = test::tempFile("remains/bb/y.result.part-0123456789abcdef");
  std::ofstream(left) << "half";
  std::ofstream(written_now) << "half";
  makeOld(left);
  store.removeRemains();
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(written_now));
  EXPECT_TRUE(store.find(kName));
}

TEST(FleetStores, RemovesWhatKilledProgramsLeftOfATable) {
  const std::string path = test::tempFile("table.npz"), left = nameBeside(path),
                    other = test::tempFile("table.npz.bak");
  const std::string written_now = nameBeside(path);
  std::ofstream(left) << "half";
  std::ofstream(written_now) << "half";
  std::ofstream(other) << "mine";
  makeOld(left);
  removeBeside(path);
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(written_now));
  EXPECT_TRUE(fs::exists(other));
}

TEST(FleetStores, AFolderInThePlaceOfAResultIsNamed) {
  const fs::path folder = test::tempFile("occupied"), place = folder / "aa" / (kName + ".result");
  fs::create_directories(place);
  const FleetStore store(folder.string());
  EXPECT_FALSE(store.find(kName));
  try {
    store.keep(sample());
    ADD_FAILURE() << "it was kept";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(place.string()), std::string::npos) << error.what();
  }
}

TEST(FleetStores, ReportWhereTheyCannotWrite) {
  EXPECT_THROW(FleetStore("/proc/none").keep(sample()), Error);
  EXPECT_THROW(FleetStore("/proc/none").keepFailure(kName, "x"), Error);
}

}  // namespace
}  // namespace hl::test_fleet_store
