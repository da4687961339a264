// GltfItem: an element of a glTF document and where it is, so that an error can name it: "accessors/3".
#pragma once

#include <boost/json.hpp>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hl {

class GltfItem {
 public:
  /// `value` outlives it. Throws hl::Error for one that is no object.
  GltfItem(const boost::json::value& value, std::string place);

  const boost::json::object& object() const { return object_; }
  const std::string& place() const { return place_; }
  [[noreturn]] void refuse(const std::string& why) const;

  bool has(std::string_view name) const { return object_.if_contains(name) != nullptr; }
  /// A member that is a number from 0 on, without a fraction; nothing where it lacks. Throws hl::Error for another.
  std::optional<std::uint64_t> whole(std::string_view name) const;
  /// The same of one that must be there.
  std::uint64_t needed(std::string_view name) const;
  /// The same of one that says which of the `count` elements of `list`.
  std::optional<std::size_t> reference(std::string_view name, std::string_view list, std::size_t count) const;
  /// A member that is a list of references.
  std::vector<std::size_t> references(std::string_view name, std::string_view list, std::size_t count) const;
  /// A member that is a number; nothing where it lacks. Throws hl::Error for another.
  std::optional<double> number(std::string_view name) const;
  /// A member that is a list of `count` numbers; empty where it lacks. Throws hl::Error for another.
  std::vector<double> numbers(std::string_view name, std::size_t count) const;
  /// A member that is an object; nothing where it lacks. Throws hl::Error for another.
  std::optional<GltfItem> child(std::string_view name) const;
  /// The elements of a member that is a list; none where it lacks.
  std::vector<GltfItem> list(std::string_view name) const;

 private:
  std::optional<std::uint64_t> wholeOf(const boost::json::value& value) const;
  std::size_t checked(const boost::json::value& value, std::string_view name, std::string_view list,
                      std::size_t count) const;
  std::string below(std::string_view name) const;

  const boost::json::object& object_;
  const std::string place_;  // empty: the document
};

}  // namespace hl
