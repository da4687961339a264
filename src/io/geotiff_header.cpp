#include "io/geotiff_header.h"

#include <fmt/core.h>

#include <boost/property_tree/xml_parser.hpp>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>
#include <sstream>
#include <string_view>

#include "base/error.h"
#include "base/text.h"
#include "io/read_heights.h"
#include "io/text_words.h"

namespace hl {

namespace {

constexpr ttag_t kPixelScaleTag = 33550, kTransformTag = 34264, kTiePointTag = 33922, kKeysTag = 34735,
                 kMetadataTag = 42112, kMissingTag = 42113;

std::string_view textOf(const TiffFile& file, ttag_t tag) {
  const std::span<const char> text = file.list<char>(tag);
  return trimmed({text.data(), text.empty() ? 0 : strnlen(text.data(), text.size())}, " \t\r\n");
}

std::optional<double> numberOf(std::string_view word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return {};
  return value;
}

std::optional<double> missingOf(const TiffFile& file, HeightSink& sink) {
  const std::string_view word = textOf(file, kMissingTag);
  const std::optional<double> value = numberOf(word);
  if (!word.empty() && !value)
    sink.warn(fmt::format("its value for missing samples, '{}', is no number: none counts as missing", shown(word)));
  return value;
}

// Of the key directory, four numbers a key; those whose value lies elsewhere are none.
std::optional<std::uint16_t> keyOf(const TiffFile& file, std::uint16_t key) {
  const std::span<const std::uint16_t> keys = file.list<std::uint16_t>(kKeysTag);
  for (std::size_t i = 4; i + 3 < keys.size(); i += 4) {
    if (keys[i] == key && keys[i + 1] == 0) return keys[i + 3];
  }
  return {};
}

bool inDegrees(const TiffFile& file) {
  constexpr std::uint16_t kModelKey = 1024, kGeographic = 2;
  return keyOf(file, kModelKey) == kGeographic;
}

// Metres of a unit of length, by its number in the EPSG's list; nothing where the key is not there.
std::optional<double> lengthUnitOf(const TiffFile& file, std::uint16_t key, const char* what, HeightSink& sink) {
  constexpr std::uint16_t kMetre = 9001, kFoot = 9002, kSurveyFoot = 9003;
  const std::optional<std::uint16_t> unit = keyOf(file, key);
  if (!unit) return {};
  if (unit == kFoot) return 0.3048;
  if (unit == kSurveyFoot) return 1200.0 / 3937;
  if (unit != kMetre)
    sink.warn(
        fmt::format("its {} are in the unit {} of the EPSG's list, which is neither the metre nor a foot: they "
                    "are taken for metres",
                    what, *unit));
  return 1;
}

// Units of the file for a step to the next column and row, backward below 0; and the latitude of the first row if it
// is in degrees.
struct Steps {
  double east = 1, south = 1, first_row = 0, unit_m = 1;
  bool given = false;
};

Steps stepsOf(const TiffFile& file, HeightSink& sink) {
  const std::span<const double> scale = file.list<double>(kPixelScaleTag), tie = file.list<double>(kTiePointTag),
                                map = file.list<double>(kTransformTag);
  Steps steps;
  if (scale.size() >= 2) {
    steps = {scale[0], scale[1], 0, 1, true};
    if (tie.size() >= 6) steps.first_row = tie[4] + tie[1] * scale[1];
    if (scale[1] < 0)
      sink.warn("its rows lead north, as its tag 33550 says by a negative distance; GDAL takes them to lead south");
  } else if (map.size() >= 16) {
    if (map[1] != 0 || map[4] != 0) throw Error("lies turned in its map: a height field must not be");
    steps = {map[0], -map[5], map[7], 1, true};
  }
  const auto sound = [](double step) { return std::isfinite(step) && step != 0; };
  if (!sound(steps.east) || !sound(steps.south)) throw Error("says no distance between its samples that could be");
  return steps;
}

// Metres between samples, backward below 0.
Steps metresOf(const TiffFile& file, const GridSize& size, HeightSink& sink) {
  constexpr std::uint16_t kLinearUnitsKey = 3076;
  Steps steps = stepsOf(file, sink);
  if (!steps.given) sink.warn("says nothing of the distance between its samples: 1 m");
  if (inDegrees(file)) {
    const double middle = steps.first_row - 0.5 * steps.south * (size.rows - 1.0);
    const DegreeLength spacing = spacingOfDegrees(std::abs(steps.east), std::abs(steps.south), middle, sink);
    steps.east = std::copysign(spacing.east_m, steps.east);
    steps.south = std::copysign(spacing.north_m, steps.south);
  } else if (steps.given) {
    steps.unit_m = lengthUnitOf(file, kLinearUnitsKey, "distances", sink).value_or(1);
    steps.east *= steps.unit_m;
    steps.south *= steps.unit_m;
  }
  return steps;
}

/// Height = scale * sample + offset, in units of the file.
struct Measure {
  double scale = 1, offset = 0;
};

// GDAL's list of what it knows of a file, as XML: of the first band the items with these roles.
Measure measureOf(const TiffFile& file, HeightSink& sink) {
  Measure measure;
  const std::string_view text = textOf(file, kMetadataTag);
  if (text.empty()) return measure;
  boost::property_tree::ptree tree;
  try {
    std::istringstream in{std::string(text)};
    read_xml(in, tree);
  } catch (const boost::property_tree::ptree_error&) {
    sink.warn("its tag 42112 is no XML: a scale or an offset of its heights in it is left out");
    return measure;
  }
  const boost::property_tree::ptree none;
  for (const auto& [name, item] : tree.get_child("GDALMetadata", none)) {
    const auto role = item.get("<xmlattr>.role", std::string());
    if (name != "Item" || item.get("<xmlattr>.sample", std::string("0")) != "0") continue;
    if (role != "scale" && role != "offset") continue;
    const auto word = item.get_value<std::string>();
    const std::optional<double> value = numberOf(trimmed(word, " \t\r\n"));
    if (!value || !std::isfinite(*value) || (role == "scale" && !(*value > 0)))
      throw Error(fmt::format("has '{}' for the {} of its heights: a scale is a number above 0, an offset any number",
                              shown(word), role));
    (role == "scale" ? measure.scale : measure.offset) = *value;
  }
  return measure;
}

GridFrame frameOf(const TiffFile& file, const GridSize& size, HeightSink& sink) {
  constexpr std::uint16_t kVerticalUnitsKey = 4099;
  const Steps steps = metresOf(file, size, sink);
  const Measure measure = measureOf(file, sink);
  const std::optional<double> given_m = lengthUnitOf(file, kVerticalUnitsKey, "heights", sink);
  if (!given_m && steps.unit_m != 1)
    sink.warn("its distances are in feet, and it says no unit of its heights: they are taken for metres");
  const double unit_m = given_m.value_or(1);
  GridFrame frame = uprightFrame(size, steps.east, steps.south, unit_m * measure.scale);
  frame.origin.y() = unit_m * measure.offset;
  return frame;
}

}  // namespace

HeightHeader geotiffHeader(const TiffFile& file, const GridSize& size, HeightSink& sink) {
  return {size, missingOf(file, sink), frameOf(file, size, sink)};
}

}  // namespace hl
