// NIfTI files: types, byte orders and orientations come out as the standard says, and what is broken gives one line.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <bit>
#include <filesystem>
#include <limits>
#include <random>

#include "io/load_model.h"
#include "io/volume_taker.h"
#include "temp_folder.h"

namespace hl::test_read_nifti {
namespace {

using test::fileWith;
using test::packed;
using test::testSample;
using test::volumeIn;
using test::VolumeTaker;
using Side = std::array<std::size_t, 3>;

constexpr Side kSide{5, 4, 3};

// Writes fields of a header where the standard puts them.
struct NiftiFile {
  bool wide = false, swap = false;
  std::string bytes;
  std::size_t data = 0;

  explicit NiftiFile(bool is_wide = false, bool swapped_bytes = false)
      : wide(is_wide), swap(swapped_bytes), bytes(wide ? 544 : 352, '\0'), data(bytes.size()) {
    put(0, std::int32_t{wide ? 540 : 348});
    bytes.replace(wide ? 4 : 344, wide ? 8 : 4, wide ? std::string("n+2\0\r\n\032\n", 8) : std::string("n+1\0", 4));
    dims({3, 5, 4, 3, 1, 1, 1, 1});
    for (std::size_t i = 0; i < 8; ++i) real(wide ? 104 : 76, i, 1);
    if (wide) put(168, static_cast<std::int64_t>(data));
    if (!wide) put(108, static_cast<float>(data));
    wide ? put(500, std::int32_t{2}) : put(123, std::int8_t{2});
    type(4);
  }
  template <typename Number>
  void put(std::size_t at, Number number) {
    bytes.replace(at, sizeof number, test::bytesOf(number, swap));
  }
  void real(std::size_t at, std::size_t index, double value) {
    wide ? put(at + 8 * index, value) : put(at + 4 * index, static_cast<float>(value));
  }
  void dims(const std::array<int, 8>& counts) {
    for (std::size_t i = 0; i < 8; ++i) {
      if (wide) put(16 + 8 * i, std::int64_t{counts[i]});
      if (!wide) put(40 + 2 * i, static_cast<std::int16_t>(counts[i]));
    }
  }
  void type(int code) { put(wide ? 12 : 70, static_cast<std::int16_t>(code)); }
  void code(bool sform, int value) {
    if (wide) put(sform ? 348 : 344, std::int32_t{value});
    if (!wide) put(sform ? 254 : 252, static_cast<std::int16_t>(value));
  }
  void spacing(const Vec3& mm, double sign = 1) {
    real(wide ? 104 : 76, 0, sign);
    for (std::size_t i = 0; i < 3; ++i) real(wide ? 104 : 76, i + 1, mm[static_cast<Eigen::Index>(i)]);
  }
  void sform(const Mat3& mm) {
    code(true, 1);
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 3; ++column)
        real(wide ? 400 : 280, 4 * row + column, mm(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)));
      real(wide ? 400 : 280, 4 * row + 3, 77);
    }
  }
  void qform(const Eigen::Quaterniond& turn) {
    code(false, 1);
    real(wide ? 352 : 256, 0, turn.x());
    real(wide ? 352 : 256, 1, turn.y());
    real(wide ? 352 : 256, 2, turn.z());
  }
  void scale(double slope, double offset) {
    real(wide ? 176 : 112, 0, slope);
    real(wide ? 184 : 116, 0, offset);
  }
  template <typename Number>
  std::string with() const {
    return bytes + test::testSamples<Number>(kSide, swap);
  }
};

VolumeTaker taken(const std::string& bytes) { return volumeIn(fileWith("a.nii", bytes)); }
std::string refusal(const std::string& bytes) { return test::volumeRefusalOf(fileWith("a.nii", bytes)); }

void expectSamples(const VolumeTaker& volume) {
  ASSERT_EQ(volume.header().side, (std::array<std::uint32_t, 3>{5, 4, 3}));
  ASSERT_TRUE(volume.whole());
  for (std::size_t z = 0; z < 3; ++z) {
    for (std::size_t y = 0; y < 4; ++y) {
      for (std::size_t x = 0; x < 5; ++x)
        ASSERT_EQ(volume.at(x, y, z), testSample(x, y, z)) << x << " " << y << " " << z;
    }
  }
}

template <typename Number>
void expectType(int code, SampleKind kind) {
  for (const bool wide : {false, true}) {
    for (const bool swap : {false, true}) {
      NiftiFile file(wide, swap);
      file.type(code);
      const VolumeTaker volume = taken(file.with<Number>());
      expectSamples(volume);
      EXPECT_EQ(volume.header().kind, kind);
      EXPECT_TRUE(volume.warnings().empty());
      expectSamples(volumeIn(fileWith("b.nii.gz", packed(file.with<Number>()))));
    }
  }
}

TEST(ReadNifti, EveryTypeInBothByteOrders) {
  expectType<std::uint8_t>(2, SampleKind::kUint16);
  expectType<std::int16_t>(4, SampleKind::kInt16);
  expectType<std::int32_t>(8, SampleKind::kFloat32);
  expectType<float>(16, SampleKind::kFloat32);
  expectType<double>(64, SampleKind::kFloat32);
  expectType<std::int8_t>(256, SampleKind::kInt16);
  expectType<std::uint16_t>(512, SampleKind::kUint16);
  expectType<std::uint32_t>(768, SampleKind::kFloat32);
}

TEST(ReadNifti, RoundingIsReported) {
  NiftiFile file;
  file.type(8);
  std::string bytes = file.with<std::int32_t>();
  bytes.replace(file.data, 4, test::bytesOf(std::int32_t{(1 << 24) + 1}, false));
  const VolumeTaker volume = taken(bytes);
  ASSERT_EQ(volume.warnings().size(), 1U);
  EXPECT_EQ(volume.warnings()[0], "1 of its 60 numbers are rounded to single precision");
}

// A patient's right, front and head are HL's +x, -z and +y.
TEST(ReadNifti, PatientAxesBecomeHls) {
  for (const bool wide : {false, true}) {
    NiftiFile file(wide);
    file.spacing({1, 2, 3});
    const VolumeTaker volume = taken(file.with<std::int16_t>());
    const GridFrame& frame = volume.header().frame;
    EXPECT_LT((frame.axes.col(0) - Vec3(1e-3, 0, 0)).norm(), 1e-18);
    EXPECT_LT((frame.axes.col(1) - Vec3(0, 0, -2e-3)).norm(), 1e-18);
    EXPECT_LT((frame.axes.col(2) - Vec3(0, 3e-3, 0)).norm(), 1e-18);
    EXPECT_LT(frame.point(2, 1.5, 1).norm(), 1e-18);
  }
}

Mat3 inHl(const Mat3& ras_mm) {
  Mat3 turn;
  turn << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return 1e-3 * turn * ras_mm;
}

TEST(ReadNifti, SformBeforeQformBeforeSpacing) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100; ++i) {
    NiftiFile file(i % 2 == 1, i % 4 > 1);
    const Vec3 spacing(0.5, 0.75, 2);
    const double sign = i % 8 < 4 ? 1 : -1;
    file.spacing(spacing, sign);
    const auto drawn = [&] { return normal(random); };
    const auto turn = Eigen::Quaterniond(std::abs(drawn()), drawn(), drawn(), drawn()).normalized();
    file.qform(turn);
    const Mat3 turned = turn.toRotationMatrix() * Vec3(0.5, 0.75, sign * 2).asDiagonal();
    // Half of a turn is as near as the square root of what float keeps of the quaternion's first number.
    const double most = file.wide ? 1e-9 : 3e-6;
    EXPECT_LT((taken(file.with<std::int16_t>()).header().frame.axes - inHl(turned)).norm(), most);
    Mat3 sheared = turned + 0.1 * Mat3::NullaryExpr(3, 3, drawn);
    sheared = sheared.cast<float>().cast<double>().eval();
    file.sform(sheared);
    EXPECT_LT((taken(file.with<std::int16_t>()).header().frame.axes - inHl(sheared)).norm(), 1e-12);
    file.code(true, 0);
    file.code(false, 0);
    const Mat3 plain = spacing.asDiagonal();
    EXPECT_LT((taken(file.with<std::int16_t>()).header().frame.axes - inHl(plain)).norm(), 1e-12);
  }
}

TEST(ReadNifti, AnEmptySformIsPassedOver) {
  NiftiFile file;
  file.sform(Mat3::Zero());
  file.spacing({1, 1, 4});
  const VolumeTaker volume = taken(file.with<std::int16_t>());
  EXPECT_LT((volume.header().frame.axes - inHl(Vec3(1, 1, 4).asDiagonal())).norm(), 1e-15);
  ASSERT_EQ(volume.warnings().size(), 1U);
  EXPECT_EQ(volume.warnings()[0], "has a sform that is no frame: it is passed over");
}

TEST(ReadNifti, UnitsOfLength) {
  const std::pair<int, double> units[] = {{1, 1}, {2, 1e-3}, {3, 1e-6}, {2 + 8, 1e-3}};
  for (const auto& [code, metres] : units) {
    NiftiFile file;
    file.put(123, static_cast<std::int8_t>(code));
    EXPECT_NEAR(taken(file.with<std::int16_t>()).header().frame.axes(0, 0), metres, 1e-15);
  }
  NiftiFile file;
  file.put(123, std::int8_t{0});
  EXPECT_EQ(taken(file.with<std::int16_t>()).warnings(),
            std::vector<std::string>{"says nothing of its unit of length: mm"});
}

TEST(ReadNifti, SlopeAndOffset) {
  for (const bool wide : {false, true}) {
    NiftiFile file(wide);
    file.scale(0.5, -1024);
    EXPECT_EQ(taken(file.with<std::int16_t>()).value(1, 2, 1), -1024 + 0.5 * testSample(1, 2, 1));
    file.scale(0, 7);
    EXPECT_EQ(taken(file.with<std::int16_t>()).value(1, 2, 1), testSample(1, 2, 1));
    for (const double none : {0.0, std::nan("")}) {
      file.scale(none, std::nan(""));
      EXPECT_EQ(taken(file.with<std::int16_t>()).value(1, 2, 1), testSample(1, 2, 1));
    }
  }
}

TEST(ReadNifti, AScaleThatIsNoNumberIsRefused) {
  const double none = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  for (const bool wide : {false, true}) {
    NiftiFile file(wide);
    for (const auto& [slope, offset] : {std::pair{infinite, 0.0}, {-infinite, none}, {1.0, none}}) {
      file.scale(slope, offset);
      EXPECT_EQ(refusal(file.with<std::int16_t>()).find("has values that are no numbers: scl_slope is "), 0U);
    }
  }
}

// What the file says of its values comes with the samples, and is looked at when they are there.
TEST(ReadNifti, AFileWithoutValuesSaysWhy) {
  const auto said = [](const std::string& bytes) {
    try {
      loadModelScene(fileWith("said.nii", bytes));
    } catch (const Error& error) {
      return std::string(error.what()).substr(std::string(error.what()).find("said.nii: ") + 10);
    }
    return std::string();
  };
  NiftiFile file;
  file.scale(1e38, 0);
  EXPECT_EQ(said(file.with<std::int16_t>()),
            "its scale (the slope of a NIfTI file) of 1e+38 and offset of 0 take values beyond 3.4e38");
  for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    NiftiFile real;
    real.type(16);
    for (int i = 0; i < 60; ++i) real.bytes += test::bytesOf(value, false);
    EXPECT_EQ(said(real.bytes), "no voxel of it has a finite value");
  }
}

TEST(ReadNifti, TheFirstOfManyVolumes) {
  NiftiFile file;
  file.dims({5, 5, 4, 3, 2, 3, 1, 1});
  std::string bytes = file.with<std::int16_t>();
  for (int i = 1; i < 6; ++i) bytes += std::string(120, '\x11');
  const VolumeTaker volume = taken(bytes);
  expectSamples(volume);
  EXPECT_EQ(volume.warnings(), std::vector<std::string>{"has 6 volumes: the first is read"});
}

TEST(ReadNifti, SamplesAfterExtensions) {
  NiftiFile file;
  file.put(108, 400.F);
  const std::string bytes = file.with<std::int16_t>();
  expectSamples(taken(bytes.substr(0, 352) + std::string(48, 'x') + bytes.substr(352)));
}

TEST(ReadNifti, WhatIsBrokenGivesOneLine) {
  const NiftiFile good;
  const auto with = [&](const auto& change) {
    NiftiFile file;
    change(file);
    return refusal(file.with<std::int16_t>());
  };
  const std::string whole = good.with<std::int16_t>();
  EXPECT_EQ(refusal(whole.substr(0, whole.size() - 1)), "ends before its last sample");
  EXPECT_EQ(refusal(whole.substr(0, 200)), "ends before its last sample");
  EXPECT_EQ(refusal("This is a text, and no volume at all."), "is not a NIfTI file");
  EXPECT_EQ(with([](NiftiFile& f) { f.bytes.replace(344, 4, "abcd"); }), "is not a NIfTI file");
  EXPECT_EQ(with([](NiftiFile& f) { f.bytes.replace(344, 3, "ni1"); }),
            "has its samples in another file: save both as one .nii file");
  EXPECT_EQ(with([](NiftiFile& f) { f.type(128); }).find("has numbers of type 128: "), 0U);
  EXPECT_EQ(with([](NiftiFile& f) { f.dims({3, 5, -4, 3, 1, 1, 1, 1}); }).find("has 5 x -4 x 3 samples: "), 0U);
  EXPECT_EQ(with([](NiftiFile& f) { f.dims({2, 5, 4, 3, 1, 1, 1, 1}); }).find("has 5 x 4 x 1 samples: "), 0U);
  EXPECT_EQ(with([](NiftiFile& f) { f.dims({99, 5, 4, 3, 1, 1, 1, 1}); }), "is not a sound NIfTI file: it has 99 axes");
  EXPECT_EQ(with([](NiftiFile& f) { f.put(108, -5.F); }), "is not a sound NIfTI file: its samples begin at byte -5");
  EXPECT_EQ(with([](NiftiFile& f) { f.put(108, 1e9F); }), "ends before its last sample");
  EXPECT_EQ(with([](NiftiFile& f) { f.dims({3, 32000, 32000, 32000, 1, 1, 1, 1}); }), "ends before its last sample");
  EXPECT_EQ(with([](NiftiFile& f) {
              f.spacing({1, 0, 1});
            }),
            "says no distances and directions between its samples that could be");
  EXPECT_EQ(with([](NiftiFile& f) {
              f.spacing({1, std::nan(""), 1});
            }),
            "says no distances and directions between its samples that could be");
}

TEST(ReadNifti, BadGzipGivesOneLine) {
  const std::string good = packed(NiftiFile().with<std::int16_t>());
  const std::string broken = "is not sound gzip: it is broken, or cut off";
  EXPECT_EQ(test::volumeRefusalOf(fileWith("a.nii.gz", good.substr(0, good.size() - 12))), broken);
  std::string bad_sum = good;
  bad_sum[bad_sum.size() - 6] ^= 1;
  EXPECT_EQ(test::volumeRefusalOf(fileWith("a.nii.gz", bad_sum)), broken);
  std::string bad_middle = good;
  bad_middle[bad_middle.size() / 2] ^= 85;
  EXPECT_NE(test::volumeRefusalOf(fileWith("a.nii.gz", bad_middle)), "");
  NiftiFile more;
  more.dims({3, 5, 4, 4, 1, 1, 1, 1});
  EXPECT_EQ(test::volumeRefusalOf(fileWith("a.nii.gz", packed(more.with<std::int16_t>()))),
            "ends before its last sample");
}

// Takes what comes before samples are read: what a file cannot have is refused before anybody makes room for it.
TEST(ReadNifti, MoreThanGzipCanHoldIsRefusedUnread) {
  constexpr std::size_t kZeros = 3'000'000;
  const auto refused = [](const NiftiFile& file) {
    VolumeTaker taker;
    const std::string path = fileWith("a.nii.gz", packed(file.bytes + std::string(kZeros, '\0')));
    std::string why;
    try {
      readVolume({path, ".nii.gz", false}, taker);
    } catch (const Error& error) {
      why = error.what();
    }
    EXPECT_TRUE(taker.bytes().empty());
    return why;
  };
  NiftiFile claim;
  claim.dims({3, 2000, 2000, 2000, 1, 1, 1, 1});
  EXPECT_EQ(refused(claim), "ends before its last sample");
  NiftiFile far;
  far.put(108, 1e14F);
  EXPECT_EQ(refused(far), "ends before its last sample");
  NiftiFile dense;
  dense.dims({3, 100, 100, 150, 1, 1, 1, 1});
  EXPECT_TRUE(volumeIn(fileWith("a.nii.gz", packed(dense.bytes + std::string(kZeros, '\0')))).whole());
}

TEST(ReadNifti, AnyDamageIsTakenOrRefusedInOneLine) {
  std::mt19937 random(2);
  for (int i = 0; i < 1000; ++i) {
    std::string bytes = NiftiFile(i % 2 == 1, i % 4 > 1).with<std::int16_t>();
    for (int k = 0; k < 1 + i % 5; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
    if (i % 5 == 0) bytes.resize(random() % bytes.size());
    if (i % 3 == 0) bytes = packed(bytes);
    EXPECT_EQ(refusal(bytes).find('\n'), std::string::npos);
  }
}

TEST(ReadNifti, EndingsInAnyCase) {
  EXPECT_EQ(endingOf("/a.b/C.NII.GZ"), ".nii.gz");
  EXPECT_EQ(endingOf("c.nii"), ".nii");
  EXPECT_EQ(endingOf("c.gz"), ".gz");
  EXPECT_EQ(endingOf("/a.nii/c"), "");
  EXPECT_TRUE(readsVolumes(".nii.gz"));
  EXPECT_FALSE(readsVolumes(".gz"));
}

// The head of Debian's mricron-data: 1 mm apart, axial, in the space of MNI.
TEST(ReadNifti, RealHead) {
  const std::string path = "/usr/share/mricron/templates/ch2.nii.gz";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "needs the package mricron-data";
  const VolumeTaker head = volumeIn(path);
  EXPECT_EQ(head.header().side, (std::array<std::uint32_t, 3>{181, 217, 181}));
  EXPECT_TRUE(head.whole());
  EXPECT_LT((head.header().frame.axes - inHl(Mat3::Identity())).norm(), 1e-9);
  EXPECT_GT(head.value(90, 108, 90), head.value(2, 2, 2));
}

}  // namespace
}  // namespace hl::test_read_nifti
