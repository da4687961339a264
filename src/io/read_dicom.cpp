// DICOM series: the files of a folder, or the frames of a file.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <vector>

#include "base/error.h"
#include "io/dicom_file.h"
#include "io/dicom_stack.h"
#include "io/read_volumes.h"
#include "io/text_words.h"
#include "io/volume_frame.h"

namespace hl {

namespace {

namespace fs = std::filesystem;
using Series = std::vector<DicomFile>;

std::size_t slicesIn(const Series& series) {
  std::size_t count = 0;
  for (const DicomFile& file : series) count += file.frames;
  return count;
}

std::vector<std::string> dicomFilesIn(const fs::path& folder) {
  std::vector<std::string> paths;
  std::error_code failed;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, failed)) {
    if (entry.is_regular_file(failed) && looksLikeDicom(entry.path().string())) paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

// By SeriesInstanceUID. Files that are no images are left out, and so are broken ones, with a warning.
std::map<std::string, Series> seriesIn(const fs::path& folder, VolumeSink& sink) {
  std::map<std::string, Series> all;
  std::size_t broken = 0;
  for (const std::string& path : dicomFilesIn(folder)) {
    try {
      DicomFile file = readDicomHeader(path);
      if (!file.series.empty()) all[file.series].push_back(std::move(file));
    } catch (const Error&) {
      ++broken;
    }
  }
  if (broken > 0) sink.warn(fmt::format("{} files in the folder are not sound DICOM: they are left out", broken));
  if (all.empty()) throw Error("has no DICOM image in it");
  return all;
}

std::string inWords(const Series& series) {
  const std::string& name = series.front().description.empty() ? series.front().series : series.front().description;
  return fmt::format("'{}' ({})", shown(name), slicesIn(series));
}

// The one with the most slices; the first by its UID of several such.
Series largestIn(const fs::path& folder, VolumeSink& sink) {
  std::map<std::string, Series> all = seriesIn(folder, sink);
  const auto fewer = [](const auto& a, const auto& b) { return slicesIn(a.second) < slicesIn(b.second); };
  const auto largest = std::max_element(all.begin(), all.end(), fewer);
  constexpr std::size_t kMaxNamed = 10;
  std::string others;
  std::size_t named = 0;
  for (const auto& [uid, series] : all) {
    if (uid == largest->first || named == kMaxNamed) continue;
    others += (named++ > 0 ? ", " : "") + inWords(series);
  }
  if (all.size() > 1)
    sink.warn(fmt::format("has {} series: {} with the most slices is read, not {}{}", all.size(),
                          inWords(largest->second), others, all.size() > kMaxNamed + 1 ? ", and others" : ""));
  return largest->second;
}

Series seriesOf(const ModelFile& file, VolumeSink& sink) {
  if (fs::is_directory(file.path)) return largestIn(file.path, sink);
  const DicomFile one = readDicomHeader(file.path);
  if (one.series.empty()) throw Error("is DICOM, and no image");
  if (one.frames > 1) return {one};
  if (file.alone)
    throw Error("is one slice, and a file comes alone: save the series as one .nii, .nrrd or multi-frame file");
  const std::map<std::string, Series> all = seriesIn(fs::path(file.path).parent_path(), sink);
  const auto found = all.find(one.series);  // not there if the file has no ending and no magic number of DICOM
  return found == all.end() ? Series{one} : found->second;
}

// Of several files, an error says which of them it is of.
std::vector<std::byte> samplesOf(const DicomFile& file, bool one_of_many) {
  try {
    return readDicomSamples(file);
  } catch (const Error& error) {
    if (!one_of_many) throw;
    throw Error(fmt::format("{} (slice '{}')", error.what(), shown(fs::path(file.path).filename().string())));
  }
}

void checkSameForm(const Series& series) {
  const DicomFile& first = series.front();
  for (const DicomFile& file : series) {
    if (!file.is_grey) throw Error("is a picture in colour: a volume has one number a sample");
    if (file.slices.empty()) throw Error("does not say where its slices lie");
    if (file.columns != first.columns || file.rows != first.rows)
      throw Error(fmt::format("has slices of {} x {} and of {} x {} samples: export one stack of them", first.columns,
                              first.rows, file.columns, file.rows));
    const bool same = file.bits == first.bits && file.bytes == first.bytes && file.is_signed == first.is_signed &&
                      file.low_is_bright == first.low_is_bright;
    if (!same) throw Error("has slices with numbers of different types");
  }
  const bool can =
      (first.bytes == 1 || first.bytes == 2 || first.bytes == 4) && first.bits >= 1 && first.bits <= 8 * first.bytes;
  if (!can)
    throw Error(
        fmt::format("has {} bits a sample, {} of them used: 8, 16 and 32 can be read", 8 * first.bytes, first.bits));
}

/// Stored numbers of one series as samples. All slices have one scale, or else each sample becomes its value.
class DicomNumbers {
 public:
  DicomNumbers(const DicomFile& form, const std::vector<DicomSlice>& slices) : form_(form), scale_(slices[0].values) {
    for (const DicomSlice& slice : slices) {
      one_scale_ = one_scale_ && slice.values.scale == scale_.scale && slice.values.offset == scale_.offset;
      if (!std::isfinite(slice.values.scale) || !std::isfinite(slice.values.offset))
        throw Error("says no scale of its values that could be");
    }
  }

  SampleKind kind() const {
    if (!one_scale_ || form_.bytes > 2) return SampleKind::kFloat32;
    return form_.is_signed ? SampleKind::kInt16 : SampleKind::kUint16;
  }
  ValueScale values() const { return one_scale_ ? upright(scale_) : ValueScale{}; }
  /// The samples of a slice whose stored numbers begin there.
  std::vector<std::byte> samplesOf(const DicomSlice& slice, const std::byte* stored) const {
    switch (kind()) {
      case SampleKind::kInt16:
        return converted<std::int16_t>(stored, {});
      case SampleKind::kUint16:
        return converted<std::uint16_t>(stored, {});
      case SampleKind::kFloat32:
        break;
    }
    return converted<float>(stored, one_scale_ ? ValueScale{} : upright(slice.values));
  }

 private:
  // Where low numbers are bright, they are counted from the other end.
  ValueScale upright(const ValueScale& scale) const {
    if (!form_.low_is_bright) return scale;
    const double ends = form_.is_signed ? -1 : std::ldexp(1, static_cast<int>(form_.bits)) - 1;
    return {-scale.scale, scale.offset + scale.scale * ends};
  }
  // What is stored above the bits that are used is no part of the number.
  std::int64_t numberAt(const std::byte* at) const {
    std::uint32_t number = 0;
    if (form_.bytes == 1) number = static_cast<std::uint8_t>(*at);
    if (form_.bytes == 2) number = read<std::uint16_t>(at);
    if (form_.bytes == 4) number = read<std::uint32_t>(at);
    const unsigned unused = 32 - form_.bits;
    number <<= unused;
    return form_.is_signed ? std::int64_t{static_cast<std::int32_t>(number) >> unused} : std::int64_t{number >> unused};
  }
  template <typename Number>
  static Number read(const std::byte* at) {
    Number number;
    std::memcpy(&number, at, sizeof number);
    return number;
  }
  template <typename Kept>
  std::vector<std::byte> converted(const std::byte* stored, const ValueScale& scale) const {
    const std::size_t count = std::size_t{form_.columns} * form_.rows;
    std::vector<std::byte> out(count * sizeof(Kept));
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t number = numberAt(stored + i * form_.bytes);
      Kept kept = static_cast<Kept>(number);
      if constexpr (std::is_same_v<Kept, float>)
        kept = static_cast<float>(scale.offset + scale.scale * static_cast<double>(number));
      std::memcpy(&out[i * sizeof kept], &kept, sizeof kept);
    }
    return out;
  }

  DicomFile form_;
  ValueScale scale_;
  bool one_scale_ = true;
};

}  // namespace

bool isDicomFolder(const std::string& path) {
  std::error_code failed;
  if (!fs::is_directory(path, failed)) return false;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, failed)) {
    if (entry.is_regular_file(failed) && looksLikeDicom(entry.path().string())) return true;
  }
  return false;
}

void readDicom(const ModelFile& file, VolumeSink& sink) {
  const Series series = seriesOf(file, sink);
  checkSameForm(series);
  std::vector<DicomSlice> slices;
  std::map<std::string, const DicomFile*> files;
  for (const DicomFile& one : series) {
    slices.insert(slices.end(), one.slices.begin(), one.slices.end());
    files[one.path] = &one;
  }
  const Mat3 ras = Vec3(-1e-3, -1e-3, 1e-3).asDiagonal() * stackSlices(slices);
  const DicomFile& form = series.front();
  const auto side = volumeSides(
      {static_cast<double>(form.columns), static_cast<double>(form.rows), static_cast<double>(slices.size())});
  const DicomNumbers numbers(form, slices);
  if (form.low_is_bright) sink.warn("has low numbers for what is bright (MONOCHROME1): its values are turned round");
  sink.header({side, numbers.kind(), {}, numbers.values(), centredFrame(side, fromPatient(ras))});
  const DicomFile* last = nullptr;
  std::vector<std::byte> stored;
  for (const DicomSlice& slice : slices) {
    const DicomFile* const in = files.at(slice.path);
    if (in != last) stored = samplesOf(*in, series.size() > 1);
    last = in;
    const std::size_t bytes = std::size_t{form.columns} * form.rows * form.bytes;
    const std::vector<std::byte> samples = numbers.samplesOf(slice, &stored[slice.frame * bytes]);
    sink.samples(samples.data(), samples.size());
  }
}

}  // namespace hl
