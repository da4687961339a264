// DICOM: series lie as their positions say, and what is missing or broken gives one line.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <random>

#include "io/dicom_stack.h"
#include "io/dicom_writer.h"
#include "io/volume_taker.h"
#include "surfaces/iso_surface.h"
#include "temp_folder.h"

namespace hl::test_read_dicom {
namespace {

using test::dicomFile;
using test::DicomForm;
using test::DicomSet;
using test::dicomSlice;
using test::testSample;
using test::volumeIn;
using test::VolumeTaker;

constexpr std::size_t kSlices = 6;

/// A folder of its own, empty at first.
class Folder {
 public:
  Folder() : path_(test::tempFile("series")) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directory(path_);
  }
  std::string put(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ + "/" + name, std::ios::binary) << bytes;
    return path_ + "/" + name;
  }
  const std::string& path() const { return path_; }
  VolumeTaker taken() const { return volumeIn(path_); }
  std::string refusal() const { return test::volumeRefusalOf(path_); }

 private:
  std::string path_;
};

std::string samplesOf(const DicomForm& form, std::size_t slice) {
  std::string bytes;
  for (std::size_t y = 0; y < form.rows; ++y) {
    for (std::size_t x = 0; x < form.columns; ++x) {
      const int sample = testSample(x, y, slice);
      bytes += form.bytes == 1 ? std::string(1, static_cast<char>(sample))
                               : test::bytesOf(static_cast<std::uint16_t>(sample), false);
    }
  }
  return bytes;
}

// Slices from `position` on, `step` apart, whose names are not in their order.
void putSeries(const Folder& folder, const DicomForm& form, const Vec3& step, const Vec3& position = {3, 4, 5}) {
  for (std::size_t i = 0; i < kSlices; ++i)
    folder.put(form.series + "_" + std::to_string(5 * i % kSlices) + ".dcm",
               dicomFile(dicomSlice(form, samplesOf(form, i), position + static_cast<double>(i) * step)));
}

void expectSamples(const VolumeTaker& volume) {
  ASSERT_EQ(volume.header().side, (std::array<std::uint32_t, 3>{5, 4, kSlices}));
  ASSERT_TRUE(volume.whole());
  for (std::size_t z = 0; z < kSlices; ++z) {
    for (std::size_t y = 0; y < 4; ++y) {
      for (std::size_t x = 0; x < 5; ++x)
        ASSERT_EQ(volume.at(x, y, z), testSample(x, y, z)) << x << " " << y << " " << z;
    }
  }
}

// A patient's left, back and head are HL's -x, +z and +y.
Mat3 inHl(const Mat3& lps_mm) {
  Mat3 turn;
  turn << -1, 0, 0, 0, 0, 1, 0, 1, 0;
  return 1e-3 * turn * lps_mm;
}
Mat3 columns(const Vec3& a, const Vec3& b, const Vec3& c) {
  Mat3 axes;
  axes << a, b, c;
  return axes;
}

TEST(ReadDicom, AFolderOrAnyFileOfASeries) {
  const Folder folder;
  DicomForm form;
  form.column_step = 0.5;
  form.row_step = 0.75;
  form.slope = 2;
  form.offset = -1024;
  putSeries(folder, form, {0, 0, 2.5});
  folder.put("notes.txt", "no image");
  for (const std::string& path : {folder.path(), folder.path() + "/1.2.3.4_3.dcm"}) {
    const VolumeTaker volume = volumeIn(path);
    expectSamples(volume);
    EXPECT_TRUE(volume.warnings().empty());
    EXPECT_EQ(volume.header().kind, SampleKind::kInt16);
    EXPECT_EQ(volume.value(1, 2, 3), -1024 + 2 * testSample(1, 2, 3));
    const Mat3 axes = columns({0.5, 0, 0}, {0, 0.75, 0}, {0, 0, 2.5});
    EXPECT_LT((volume.header().frame.axes - inHl(axes)).norm(), 1e-15);
    EXPECT_LT(volume.header().frame.point(2, 1.5, 2.5).norm(), 1e-15);
  }
  EXPECT_TRUE(isDicomFolder(folder.path()));
  EXPECT_FALSE(isDicomFolder(folder.path() + "/notes.txt"));
  EXPECT_FALSE(isDicomFolder("/nowhere"));
  EXPECT_EQ(test::volumeRefusalOf(folder.path() + "/1.2.3.4_3.dcm", true),
            "is one slice, and a file comes alone: save the series as one .nii, .nrrd or multi-frame file");
}

TEST(ReadDicom, TypesOfNumbers) {
  const std::tuple<int, int, bool, SampleKind> types[] = {{8, 1, false, SampleKind::kUint16},
                                                          {8, 1, true, SampleKind::kInt16},
                                                          {12, 2, false, SampleKind::kUint16},
                                                          {16, 2, false, SampleKind::kUint16},
                                                          {12, 2, true, SampleKind::kInt16}};
  for (const auto& [bits, bytes, is_signed, kind] : types) {
    const Folder folder;
    DicomForm form;
    form.bits = static_cast<std::uint16_t>(bits);
    form.bytes = static_cast<std::uint16_t>(bytes);
    form.is_signed = is_signed;
    putSeries(folder, form, {0, 0, 1});
    const VolumeTaker volume = folder.taken();
    expectSamples(volume);
    EXPECT_EQ(volume.header().kind, kind);
  }
}

TEST(ReadDicom, BitsAboveANumberAreNoPartOfIt) {
  const Folder folder;
  DicomForm form;
  form.bits = 12;
  form.columns = form.rows = 2;
  std::string samples;
  for (const std::uint16_t stored : {0xf001, 0x0fff, 0xa800, 0x07ff}) samples += test::bytesOf(stored, false);
  for (int i = 0; i < 2; ++i)
    folder.put(std::to_string(i) + ".ima", dicomFile(dicomSlice(form, samples, Vec3(0, 0, i))));
  const VolumeTaker volume = folder.taken();
  EXPECT_EQ(volume.at(0, 0, 0), 1);
  EXPECT_EQ(volume.at(1, 0, 0), -1);
  EXPECT_EQ(volume.at(0, 1, 0), -2048);
  EXPECT_EQ(volume.at(1, 1, 0), 2047);
}

TEST(ReadDicom, AnyOrientationAndShear) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const auto drawn = [&] { return normal(random); };
  for (int i = 0; i < 300; ++i) {
    const Mat3 turn = Eigen::Quaterniond(drawn(), drawn(), drawn(), drawn()).normalized().toRotationMatrix();
    const Vec3 step = turn * Vec3(0.3 * drawn(), 0.3 * drawn(), i % 2 == 0 ? 1.25 : -1.25), begin(drawn(), 9, drawn());
    std::vector<DicomSlice> slices;
    for (std::size_t k = 0; k < 9; ++k)
      slices.push_back({"", k, begin + static_cast<double>(k) * step, turn.col(0), turn.col(1), 0.7, 0.6, {}});
    std::shuffle(slices.begin(), slices.end(), random);
    const Mat3 axes = stackSlices(slices);
    const double sign = i % 2 == 0 ? 1 : -1;  // slices follow each other along their normal
    EXPECT_LT((axes - columns(0.7 * turn.col(0), 0.6 * turn.col(1), sign * step)).norm(), 1e-12);
    for (std::size_t k = 0; k < 9; ++k) EXPECT_EQ(slices[k].frame, i % 2 == 0 ? k : 8 - k);
  }
}

// A gantry tilted by 13.5 degrees: slices are turned about x, and each lies 1 mm further along the patient.
TEST(ReadDicom, BallsUnderATiltedGantryAreRound) {
  constexpr double kRadius_mm = 8, kScale = 1e-3, kTilt = 13.5 * M_PI / 180;
  const Folder folder;
  DicomForm form;
  form.columns = form.rows = 30;
  form.along_column = {0, std::cos(kTilt), -std::sin(kTilt)};
  form.column_step = form.row_step = 0.8;
  form.slope = kScale;
  const Vec3 centre(11.5, 11, 8.5);
  for (int z = 0; z < 30; ++z) {
    std::string samples;
    for (int n = 0; n < 900; ++n) {
      const Vec3 p = Vec3(0, 0, z) + 0.8 * (n % 30) * form.along_row + 0.8 * (n / 30) * form.along_column;
      samples +=
          test::bytesOf(static_cast<std::int16_t>(std::lround((kRadius_mm - (p - centre).norm()) / kScale)), false);
    }
    folder.put(std::to_string(z) + ".dcm", dicomFile(dicomSlice(form, samples, Vec3(0, 0, z))));
  }
  const VolumeTaker taken = folder.taken();
  const VolumeHeader& header = taken.header();
  const auto data = std::make_shared<std::vector<char>>(taken.bytes());
  const auto volume = std::make_shared<const Volume>(
      VoxelGrid(header.side, Samples(header.kind, std::shared_ptr<const void>(data, data->data())), header.values));
  const DrawnMesh mesh = IsoSurface(volume, header.frame, {0, SolidSide::kAbove}).drawn(1'000'000);
  ASSERT_GT(mesh.positions.size(), 500U);
  Box box;
  for (const auto& p : mesh.positions) box.extend(Vec3(p.cast<double>()));
  // Linear between samples at most 1 mm apart: off by 1 / (8 R) mm, and by the rounding of samples.
  constexpr double kMax_m = 1e-3 * (1 / (8 * (kRadius_mm - 1)) + kScale);
  EXPECT_NEAR(box.size().maxCoeff(), 2e-3 * kRadius_mm, 2e-4);
  EXPECT_NEAR(box.size().minCoeff(), 2e-3 * kRadius_mm, 2e-4);
  for (const auto& p : mesh.positions)
    ASSERT_NEAR((Vec3(p.cast<double>()) - box.centre()).norm(), 1e-3 * kRadius_mm, kMax_m + 1e-4);
}

TEST(ReadDicom, LowNumbersThatAreBright) {
  const Folder folder;
  DicomForm form;
  form.kind = "MONOCHROME1";
  form.is_signed = false;
  form.bits = 12;
  form.slope = 2;
  form.offset = 5;
  putSeries(folder, form, {0, 0, 1});
  const VolumeTaker volume = folder.taken();
  EXPECT_EQ(volume.value(1, 2, 3), 5 + 2 * (4095 - testSample(1, 2, 3)));
  ASSERT_EQ(volume.warnings().size(), 1U);
  EXPECT_NE(volume.warnings()[0].find("MONOCHROME1"), std::string::npos);
}

TEST(ReadDicom, EachSliceMayHaveItsScale) {
  const Folder folder;
  DicomForm form;
  for (int i = 0; i < 3; ++i) {
    form.slope = 0.5 + i;
    form.offset = -i;
    folder.put(std::to_string(i) + ".dcm", dicomFile(dicomSlice(form, samplesOf(form, i), Vec3(0, 0, i))));
  }
  const VolumeTaker volume = folder.taken();
  EXPECT_EQ(volume.header().kind, SampleKind::kFloat32);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(volume.value(3, 1, i), (0.5 + static_cast<double>(i)) * testSample(3, 1, i) - static_cast<double>(i));
}

TEST(ReadDicom, TheLargestOfManySeries) {
  const Folder folder;
  DicomForm form;
  putSeries(folder, form, {0, 0, 1});
  form.series = "1.2.3.3";
  form.name = "Scout\xff";
  folder.put("0.dcm", dicomFile(dicomSlice(form, samplesOf(form, 0), Vec3(0, 0, 0))));
  const VolumeTaker volume = folder.taken();
  expectSamples(volume);
  EXPECT_EQ(volume.warnings(),
            std::vector<std::string>{"has 2 series: 'Test' (6) with the most slices is read, not 'Scout?' (1)"});
  EXPECT_TRUE(volumeIn(folder.path() + "/1.2.3.4_1.dcm").warnings().empty());
}

// Groups of all frames and of each (PS3.3 C.7.6.16), frames in no order.
std::string enhanced(const DicomForm& form, std::size_t frames) {
  std::string samples;
  std::vector<DicomSet> own;
  for (std::size_t i = 0; i < frames; ++i) {
    const std::size_t slice = 5 * i % frames;
    samples += samplesOf(form, slice);
    DicomSet place;
    place.numbers({0x20, 0x32}, {1, 0.25 * static_cast<double>(slice), 3.0 * static_cast<double>(slice)});
    own.push_back(DicomSet().sequence({0x20, 0x9113}, {place}));
  }
  DicomSet set = dicomSlice(form, samples);
  for (const DicomSet::Tag& tag : {DicomSet::Tag{0x20, 0x37}, {0x28, 0x30}, {0x28, 0x1052}, {0x28, 0x1053}})
    set.remove(tag);
  DicomSet turn, steps, values;
  turn.numbers({0x20, 0x37}, {1, 0, 0, 0, 1, 0});
  steps.numbers({0x28, 0x30}, {0.6, 0.4});
  values.numbers({0x28, 0x1052}, {-7}).numbers({0x28, 0x1053}, {3});
  DicomSet shared;
  shared.sequence({0x20, 0x9116}, {turn}).sequence({0x28, 0x9110}, {steps}).sequence({0x28, 0x9145}, {values});
  set.text({0x28, 8}, "IS", std::to_string(frames)).sequence({0x5200, 0x9229}, {shared});
  return dicomFile(set.sequence({0x5200, 0x9230}, own));
}

TEST(ReadDicom, FramesOfOneFile) {
  const std::string path = test::fileWith("enhanced.dcm", enhanced({}, kSlices));
  for (const bool alone : {false, true}) {
    const VolumeTaker volume = volumeIn(path, alone);
    expectSamples(volume);
    EXPECT_EQ(volume.value(1, 2, 3), -7 + 3 * testSample(1, 2, 3));
    EXPECT_LT((volume.header().frame.axes - inHl(columns({0.4, 0, 0}, {0, 0.6, 0}, {0, 0.25, 3}))).norm(), 1e-15);
  }
}

std::string refusalOf(const std::vector<Vec3>& positions) {
  const Folder folder;
  const DicomForm form;
  for (std::size_t i = 0; i < positions.size(); ++i)
    folder.put(std::to_string(i) + ".dcm", dicomFile(dicomSlice(form, samplesOf(form, i), positions[i])));
  return folder.refusal();
}

TEST(ReadDicom, MissingAndUnequalSlicesAreRefused) {
  EXPECT_EQ(refusalOf({{0, 0, 0}, {0, 0, 2}, {0, 0, 4}, {0, 0, 8}, {0, 0, 10}}),
            "misses slices: 3 and 4 of 5 lie 4 mm apart, others 2 mm");
  EXPECT_EQ(refusalOf({{0, 0, 0}, {0, 0, 2}, {0, 0, 4}, {0, 0, 5}, {0, 0, 7}}),
            "has slices that lie unequally: 3 and 4 of 5 lie 1 mm apart, others 2 mm");
  EXPECT_EQ(refusalOf({{0, 0, 0}, {0, 0, 2}, {0, 0, 2}, {0, 0, 4}}),
            "has two slices in one place, 2 and 3 of 4: export one moment or kind of image alone");
  EXPECT_EQ(refusalOf({{0, 0, 0}, {0, 0, 2}, {0, 1, 4}, {0, 0, 6}}), "has slices that do not lie along a line");
  EXPECT_EQ(refusalOf({{0, 0, 0}}), "has one slice: a volume has at least two");
  EXPECT_EQ(refusalOf({{0, 0, 0}, {0, 0, 0.996}, {0, 0, 2.004}, {0, 0.002, 3}}), "");
}

TEST(ReadDicom, WhatMakesNoVolumeIsRefused) {
  const auto refused = [](const auto& change) {
    const Folder folder;
    for (int i = 0; i < 3; ++i) {
      DicomForm form;
      DicomSet set = dicomSlice(form, samplesOf(form, 0), Vec3(0, 0, i));
      if (i == 2) change(set);
      folder.put(std::to_string(i) + ".dcm", dicomFile(set));
    }
    return folder.refusal();
  };
  EXPECT_EQ(refused([](DicomSet& set) { set.remove({0x20, 0x32}); }), "does not say where its slices lie");
  EXPECT_EQ(refused([](DicomSet& set) {
              set.remove({0x28, 0x30});
            }),
            "says no distance between its samples that could be");
  EXPECT_EQ(refused([](DicomSet& set) {
              set.numbers({0x20, 0x37}, {1, 0, 0, 1, 0, 0});
            }),
            "says no direction of its slices that could be");
  EXPECT_EQ(refused([](DicomSet& set) {
              set.numbers({0x20, 0x37}, {0, 1, 0, 0, 0, 1});
            }),
            "has slices that are not parallel to each other: export one stack of them");
  EXPECT_EQ(refused([](DicomSet& set) {
              set.numbers({0x28, 0x30}, {1, 2});
            }),
            "has slices of unequal scale: export one stack of them");
  for (const char* slope : {"banana", "1e999", "0", "nan"}) {
    const auto change = [&](DicomSet& set) { set.text({0x28, 0x1053}, "DS", slope); };
    EXPECT_EQ(refused(change), "says no scale of its values that could be") << slope;
  }
  EXPECT_EQ(refused([](DicomSet& set) {
              set.number({0x28, 0x10}, 2);
            }),
            "has slices of 5 x 4 and of 5 x 2 samples: export one stack of them");
  EXPECT_EQ(refused([](DicomSet& set) {
              set.text({0x28, 4}, "CS", "RGB");
            }),
            "is a picture in colour: a volume has one number a sample");
  EXPECT_EQ(refused([](DicomSet& set) { set.number({0x28, 0x103}, 0); }), "has slices with numbers of different types");
  EXPECT_EQ(refused([](DicomSet& set) {
              set.text({0x7fe0, 0x10}, "OW", "short!");
            }),
            "is not sound DICOM: it is broken, or cut off (slice '2.dcm')");
  EXPECT_EQ(Folder().refusal(), "has no DICOM image in it");
  EXPECT_EQ(test::volumeRefusalOf(test::fileWith("text.dcm", "This is a text, and no image.")),
            "is not sound DICOM: it is broken, or cut off");
}

TEST(ReadDicom, ASliceThatIsCutOffAnywhereIsRefused) {
  const DicomForm form;
  const std::string whole = dicomFile(dicomSlice(form, samplesOf(form, 0), Vec3(0, 0, 1)));
  const std::size_t samples = std::size_t{form.columns} * form.rows * form.bytes;
  for (std::size_t missing = 1; missing <= samples; ++missing) {
    const Folder folder;
    folder.put("0.dcm", dicomFile(dicomSlice(form, samplesOf(form, 0), Vec3(0, 0, 0))));
    folder.put("1.dcm", whole.substr(0, whole.size() - missing));
    const std::string refusal = folder.refusal();
    EXPECT_TRUE(refusal.starts_with("is not sound DICOM: it is broken, or cut off")) << missing << ": " << refusal;
  }
}

// Debian's python3-pydicom: a chest, five slices of 16 x 16, and a dose of fifteen frames.
TEST(ReadDicom, RealFiles) {
  const std::string files = "/usr/lib/python3/dist-packages/pydicom/data/test_files/";
  if (!std::filesystem::exists(files + "rtdose.dcm")) GTEST_SKIP() << "needs the package python3-pydicom";
  EXPECT_TRUE(isDicomFolder(files + "dicomdirtests/98892001/CT5N"));
  const VolumeTaker chest = volumeIn(files + "dicomdirtests/98892001/CT5N");
  EXPECT_EQ(chest.header().side, (std::array<std::uint32_t, 3>{16, 16, 5}));
  EXPECT_EQ(chest.header().values.offset, -1024);
  EXPECT_NEAR(chest.header().frame.axes(1, 2), 2.5e-3, 1e-12);
  EXPECT_TRUE(chest.whole());
  for (const char* const name : {"rtdose.dcm", "rtdose_expb.dcm", "rtdose_rle.dcm"}) {
    const VolumeTaker dose = volumeIn(files + name, true);
    EXPECT_EQ(dose.header().side, (std::array<std::uint32_t, 3>{10, 10, 15})) << name;
    EXPECT_EQ(dose.header().kind, SampleKind::kFloat32);
    EXPECT_TRUE(dose.whole());
  }
  EXPECT_EQ(test::volumeRefusalOf(files + "rtplan.dcm"), "is DICOM, and no image");
  EXPECT_EQ(test::volumeRefusalOf(files + "SC_rgb_rle_2frame.dcm"),
            "is a picture in colour: a volume has one number a sample");
}

}  // namespace
}  // namespace hl::test_read_dicom
