#include "io/gltf_item.h"

#include <fmt/core.h>

#include <utility>

#include "base/error.h"
#include "io/text_words.h"

namespace hl {

namespace json = boost::json;

namespace {

const json::object& objectOf(const json::value& value, const std::string& place) {
  const json::object* const object = value.if_object();
  if (object == nullptr) throw Error(fmt::format("{}: is no object", place.empty() ? "its JSON" : place));
  return *object;
}

}  // namespace

GltfItem::GltfItem(const json::value& value, std::string place)
    : object_(objectOf(value, place)), place_(std::move(place)) {}

void GltfItem::refuse(const std::string& why) const {
  throw Error(fmt::format("{}: {}", place_.empty() ? "its JSON" : place_, why));
}

std::string GltfItem::below(std::string_view name) const {
  return place_.empty() ? std::string(name) : fmt::format("{}/{}", place_, name);
}

std::optional<std::uint64_t> GltfItem::wholeOf(const json::value& value) const {
  if (const std::int64_t* number = value.if_int64(); number != nullptr && *number >= 0)
    return static_cast<std::uint64_t>(*number);
  if (const std::uint64_t* number = value.if_uint64()) return *number;
  return {};
}

std::optional<std::uint64_t> GltfItem::whole(std::string_view name) const {
  const json::value* const value = object_.if_contains(name);
  if (value == nullptr) return {};
  const std::optional<std::uint64_t> number = wholeOf(*value);
  if (!number) refuse(fmt::format("its {} is {}, and no whole number from 0 on", name, shown(json::serialize(*value))));
  return number;
}

std::uint64_t GltfItem::needed(std::string_view name) const {
  const std::optional<std::uint64_t> number = whole(name);
  if (!number) refuse(fmt::format("has no {}", name));
  return *number;
}

std::size_t GltfItem::checked(const json::value& value, std::string_view name, std::string_view list,
                              std::size_t count) const {
  const std::optional<std::uint64_t> number = wholeOf(value);
  if (!number || *number >= count)
    refuse(fmt::format("its {} is {}, and there are {} {}, from 0", name, shown(json::serialize(value)), count, list));
  return *number;
}

std::optional<std::size_t> GltfItem::reference(std::string_view name, std::string_view list, std::size_t count) const {
  const json::value* const value = object_.if_contains(name);
  if (value == nullptr) return {};
  return checked(*value, name, list, count);
}

std::vector<std::size_t> GltfItem::references(std::string_view name, std::string_view list, std::size_t count) const {
  const json::value* const value = object_.if_contains(name);
  const json::array* const array = value == nullptr ? nullptr : value->if_array();
  if (value != nullptr && array == nullptr) refuse(fmt::format("its {} is no list", name));
  std::vector<std::size_t> references;
  for (std::size_t i = 0; array != nullptr && i < array->size(); ++i)
    references.push_back(checked((*array)[i], fmt::format("{}/{}", name, i), list, count));
  return references;
}

std::optional<double> GltfItem::number(std::string_view name) const {
  const json::value* const value = object_.if_contains(name);
  if (value == nullptr) return {};
  if (!value->is_number()) refuse(fmt::format("its {} is no number", name));
  return value->to_number<double>();
}

std::vector<double> GltfItem::numbers(std::string_view name, std::size_t count) const {
  const json::value* const value = object_.if_contains(name);
  if (value == nullptr) return {};
  std::vector<double> numbers;
  const json::array* const array = value->if_array();
  for (std::size_t i = 0; array != nullptr && i < array->size() && (*array)[i].is_number(); ++i)
    numbers.push_back((*array)[i].to_number<double>());
  if (array == nullptr || array->size() != count || numbers.size() != count)
    refuse(fmt::format("its {} is no list of {} numbers", name, count));
  return numbers;
}

std::optional<GltfItem> GltfItem::child(std::string_view name) const {
  const json::value* const value = object_.if_contains(name);
  if (value == nullptr) return {};
  return std::optional<GltfItem>(std::in_place, *value, below(name));
}

std::vector<GltfItem> GltfItem::list(std::string_view name) const {
  const json::value* const value = object_.if_contains(name);
  if (value == nullptr) return {};
  const json::array* const array = value->if_array();
  if (array == nullptr) refuse(fmt::format("its {} is no list", name));
  std::vector<GltfItem> items;
  items.reserve(array->size());
  for (std::size_t i = 0; i < array->size(); ++i) items.emplace_back((*array)[i], fmt::format("{}/{}", below(name), i));
  return items;
}

}  // namespace hl
