#include "io/dicom_file.h"

#include <fmt/core.h>
#include <gdcmAttribute.h>
#include <gdcmImageHelper.h>
#include <gdcmImageReader.h>
#include <gdcmReader.h>
#include <gdcmSequenceOfItems.h>
#include <gdcmTrace.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "io/file_ending.h"

namespace hl {

namespace {

using gdcm::DataSet;
using gdcm::Tag;

constexpr const char* kNoDicom = "is not sound DICOM: it is broken, or cut off";

/// A file that says whether it ended within what was asked of it. GDCM makes up what is missing of the samples. After
/// the last element it asks for the next tag.
class WatchedFile : public std::filebuf {
 public:
  explicit WatchedFile(const std::string& path) { open(path, std::ios::in | std::ios::binary); }
  bool endedEarly() const { return ended_early_; }

 protected:
  std::streamsize xsgetn(char* to, std::streamsize count) override {
    constexpr std::streamsize kTag = 4;
    const std::streamsize got = std::filebuf::xsgetn(to, count);
    ended_early_ = ended_early_ || (got < count && (got > 0 || count > kTag));
    return got;
  }

 private:
  bool ended_early_ = false;
};

// What is deflated is read ahead, and zlib sees where it ends.
bool isDeflated(const gdcm::File& file) {
  return file.GetHeader().GetDataSetTransferSyntax() == gdcm::TransferSyntax::DeflatedExplicitVRLittleEndian;
}

void silenceGdcm() {
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
  gdcm::Trace::DebugOff();
}

// Texts are filled up to an even length, by blanks or a zero.
std::string dicomText(const DataSet& set, const Tag& tag) {
  const gdcm::ByteValue* const bytes = set.FindDataElement(tag) ? set.GetDataElement(tag).GetByteValue() : nullptr;
  if (bytes == nullptr) return {};
  const std::string_view text(bytes->GetPointer(), bytes->GetLength());
  return std::string(trimmed(text.substr(0, text.find('\0'))));
}

// "1\-2.5\3"; what is no number ends it.
std::vector<double> numbersIn(const std::string& text) {
  std::vector<double> numbers;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\\'), rest.size());
    std::string_view word = trimmed(rest.substr(0, end));
    if (word.starts_with('+')) word.remove_prefix(1);
    double number = 0;
    const auto [last, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || last != word.data() + word.size()) break;
    numbers.push_back(number);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return numbers;
}

std::vector<double> dicomNumbers(const DataSet& set, const Tag& tag) { return numbersIn(dicomText(set, tag)); }

// Not a number: what is there cannot be read.
double numberIn(const std::string& text, double otherwise) {
  const std::vector<double> numbers = numbersIn(text);
  if (!numbers.empty()) return numbers[0];
  return text.empty() ? otherwise : std::numeric_limits<double>::quiet_NaN();
}

double dicomNumber(const DataSet& set, const Tag& tag, double otherwise) {
  const std::vector<double> numbers = dicomNumbers(set, tag);
  return numbers.empty() ? otherwise : numbers[0];
}

using Items = gdcm::SmartPointer<gdcm::SequenceOfItems>;

Items itemsOf(const DataSet& set, const Tag& tag) {
  return set.FindDataElement(tag) ? set.GetDataElement(tag).GetValueAsSQ() : Items();
}

/// The attributes of frames: each may be in a group of the frame, in one of all frames, or in the file (PS3.3
/// C.7.6.16).
class FrameAttributes {
 public:
  explicit FrameAttributes(const DataSet& file)
      : file_(file), shared_(itemsOf(file, {0x5200, 0x9229})), own_(itemsOf(file, {0x5200, 0x9230})) {}

  bool grouped() const { return own_ != nullptr; }
  std::vector<double> numbers(std::size_t frame, const Tag& group, const Tag& attribute) const {
    return numbersIn(text(frame, group, attribute));
  }

  std::string text(std::size_t frame, const Tag& group, const Tag& attribute) const {
    for (const auto& [items, item] : {std::pair(&own_, frame + 1), std::pair(&shared_, std::size_t{1})}) {
      if (*items == nullptr || (*items)->GetNumberOfItems() < item) continue;
      const Items groups = itemsOf((*items)->GetItem(item).GetNestedDataSet(), group);
      if (groups == nullptr || groups->GetNumberOfItems() < 1) continue;
      std::string found = dicomText(groups->GetItem(1).GetNestedDataSet(), attribute);
      if (!found.empty()) return found;
    }
    return dicomText(file_, attribute);
  }

 private:
  const DataSet& file_;
  Items shared_, own_;
};

Vec3 vectorAt(const std::vector<double>& numbers, std::size_t first) {
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

// Distances between rows and between columns: of the patient, or of the detector where that is all there is.
std::vector<double> stepsOfSamples(const DataSet& file, const FrameAttributes& attributes, std::size_t frame) {
  std::vector<double> steps = attributes.numbers(frame, {0x0028, 0x9110}, {0x0028, 0x0030});
  if (steps.size() < 2) steps = dicomNumbers(file, {0x0018, 0x1164});
  steps.resize(2);
  return steps;
}

// Values of stored numbers: of a frame, of the file, or of a dose (which is a scale alone).
ValueScale scaleOfValues(const DataSet& file, const FrameAttributes& attributes, std::size_t frame) {
  constexpr std::pair<std::uint16_t, std::uint16_t> kGroup{0x0028, 0x9145};
  const Tag group(kGroup.first, kGroup.second);
  const std::string slope = attributes.text(frame, group, {0x0028, 0x1053});
  const double scale = numberIn(slope, dicomNumber(file, {0x3004, 0x000e}, 1));
  const double offset = numberIn(attributes.text(frame, group, {0x0028, 0x1052}), 0);
  return {scale == 0 ? std::numeric_limits<double>::quiet_NaN() : scale, offset};
}

std::vector<DicomSlice> slicesOf(const DicomFile& file, const DataSet& set) {
  const FrameAttributes attributes(set);
  const std::vector<double> offsets = dicomNumbers(set, {0x3004, 0x000c});  // of a dose, along the normal
  if (file.frames > 1 && !attributes.grouped() && offsets.size() != file.frames) return {};
  std::vector<DicomSlice> slices;
  for (std::size_t frame = 0; frame < file.frames; ++frame) {
    const auto position = attributes.numbers(frame, {0x0020, 0x9113}, {0x0020, 0x0032});
    const auto turn = attributes.numbers(frame, {0x0020, 0x9116}, {0x0020, 0x0037});
    if (position.size() != 3 || turn.size() != 6) return {};
    const auto steps = stepsOfSamples(set, attributes, frame);
    DicomSlice slice{file.path,
                     frame,
                     vectorAt(position, 0),
                     vectorAt(turn, 0),
                     vectorAt(turn, 3),
                     steps[1],
                     steps[0],
                     scaleOfValues(set, attributes, frame)};
    if (!attributes.grouped() && offsets.size() == file.frames)
      slice.position += (offsets[frame] - offsets[0]) * slice.along_row.cross(slice.along_column);
    slices.push_back(slice);
  }
  return slices;
}

template <std::uint16_t kGroup, std::uint16_t kElement>
std::uint32_t shortOf(const DataSet& set) {
  gdcm::Attribute<kGroup, kElement> attribute{};
  if (set.FindDataElement(attribute.GetTag())) attribute.SetFromDataSet(set);
  return attribute.GetValue();
}

DicomFile dicomFileOf(const std::string& path, const gdcm::File& in) {
  const DataSet& set = in.GetDataSet();
  DicomFile file;
  file.path = path;
  file.columns = shortOf<0x0028, 0x0011>(set);
  file.rows = shortOf<0x0028, 0x0010>(set);
  if (file.columns == 0 || file.rows == 0) return file;
  file.series = dicomText(set, {0x0020, 0x000e});
  if (file.series.empty()) file.series = "without a name";
  file.description = dicomText(set, {0x0008, 0x103e});
  constexpr double kMaxFrames = 1e6;
  const double frames = dicomNumber(set, {0x0028, 0x0008}, 1);
  if (!(frames >= 1 && frames <= kMaxFrames))
    throw Error(fmt::format("is not sound DICOM: it has {:g} frames", frames));
  file.frames = static_cast<std::size_t>(frames);
  file.bits = shortOf<0x0028, 0x0101>(set);
  file.bytes = shortOf<0x0028, 0x0100>(set) / 8;
  file.is_signed = shortOf<0x0028, 0x0103>(set) != 0;
  const std::string kind = dicomText(set, {0x0028, 0x0004});
  file.low_is_bright = kind == "MONOCHROME1";
  file.is_grey = shortOf<0x0028, 0x0002>(set) == 1 && (file.low_is_bright || kind == "MONOCHROME2");
  file.slices = slicesOf(file, set);
  return file;
}

// GDCM throws errors of its own, of several lines.
template <typename Work>
auto withGdcm(const Work& work) {
  silenceGdcm();
  try {
    return work();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    throw Error(kNoDicom);
  }
}

}  // namespace

bool looksLikeDicom(const std::string& path) {
  const std::string ending = endingOf(path);
  if (ending == ".dcm" || ending == ".dicom" || ending == ".ima") return true;
  constexpr std::streamoff kPreamble = 128;
  char magic[4] = {};
  std::ifstream in(path, std::ios::binary);
  in.seekg(kPreamble);
  return in.read(magic, sizeof magic) && std::string_view(magic, sizeof magic) == "DICM";
}

DicomFile readDicomHeader(const std::string& path) {
  return withGdcm([&] {
    gdcm::Reader reader;
    reader.SetFileName(path.c_str());
    constexpr std::uint16_t kPixels = 0x7fe0, kFirst = 0x0008;
    if (!reader.ReadUpToTag(Tag(kPixels, kFirst))) throw Error(kNoDicom);
    return dicomFileOf(path, reader.GetFile());
  });
}

std::vector<std::byte> readDicomSamples(const DicomFile& file) {
  return withGdcm([&] {
    WatchedFile in(file.path);
    std::istream stream(&in);
    gdcm::ImageReader reader;
    reader.SetStream(stream);
    if (!reader.Read() || (in.endedEarly() && !isDeflated(reader.GetFile()))) throw Error(kNoDicom);
    const gdcm::Image& image = reader.GetImage();
    const std::size_t samples = std::size_t{file.columns} * file.rows * file.frames;
    const gdcm::ByteValue* const plain = image.GetDataElement().GetByteValue();
    if (image.GetBufferLength() != samples * file.bytes ||
        (plain != nullptr && plain->GetLength() < samples * file.bytes))
      throw Error(kNoDicom);
    std::vector<std::byte> bytes(samples * file.bytes);
    if (!image.GetBuffer(reinterpret_cast<char*>(bytes.data()))) throw Error(kNoDicom);
    return bytes;
  });
}

}  // namespace hl
