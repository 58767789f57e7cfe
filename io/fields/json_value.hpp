// Reads values with a field table from a JSON document, strictly: an absent field keeps its default, an unknown
// property, a wrong type, a number out of range or an unknown enum text is an error that names the path.
//
// The templates only walk the tables; what they have in common is compiled once (json_value.cpp), because hundreds of
// types are read. Secrets can be read (a configuration may hold one) but are never written. Thread: pure.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "io/fields/field_table.hpp"
#include "io/fields/forms_fwd.hpp"

namespace godwit::io {

// Which place of a document is being read, and what is wrong: the first thing only. What returns a bool is false when
// something is wrong; then nothing more is read.
class json_reading {
public:
  explicit json_reading(std::string_view root = {}) : root_(root) {}

  // The property NAME, or the element INDEX, becomes the place that is read, until leave(). Null: there is no such
  // property.
  [[nodiscard]] const nlohmann::json* enter(const nlohmann::json& object, std::string_view name);
  [[nodiscard]] const nlohmann::json& enter(const nlohmann::json& list, std::size_t index);
  void leave() { place_.pop_back(); }

  bool fail(const std::string& expected, const nlohmann::json& found);
  bool fail_at(std::string_view name, const std::string& expected, const nlohmann::json& found); // of a property
  // The properties of OBJECT that are none of NAMES.
  bool refuse_unknown(const nlohmann::json& object, std::span<const std::string_view> names);

  [[nodiscard]] bool expect_object(const nlohmann::json& found);
  // Its length in SIZE; if that is already known, it must have it.
  [[nodiscard]] bool expect_list(const nlohmann::json& found, std::optional<std::size_t>& size);

  [[nodiscard]] bool read(const nlohmann::json& found, bool& out);
  [[nodiscard]] bool read(const nlohmann::json& found, double& out); // null: not a number
  [[nodiscard]] bool read(const nlohmann::json& found, std::string& out);
  [[nodiscard]] bool read(const nlohmann::json& found, std::span<char> out); // up to its first NUL, or all of it
  // Between the two; BITS are those of an integer of the sign that it has.
  [[nodiscard]] bool read(const nlohmann::json& found, std::int64_t least, std::uint64_t greatest, std::uint64_t& bits);
  // One of TEXTS: its index.
  [[nodiscard]] bool read(const nlohmann::json& found, std::span<const std::string_view> texts, std::size_t& index);

  [[nodiscard]] static bool is_null(const nlohmann::json& found);

  [[nodiscard]] json_read_result result() const;
  [[nodiscard]] std::string message() const; // empty: nothing is wrong

private:
  struct step {
    std::string_view name; // of a property; empty: of an element
    std::size_t index = 0;
  };
  [[nodiscard]] std::string path() const;

  std::string root_;
  std::vector<step> place_;
  std::optional<json_mismatch> wrong_;
};

// Reads any kind of value. A type that is written in a form of its own has its own read_value, found by the namespace
// of the type.
template <class V>
[[nodiscard]] bool read_value(json_reading& reading, const nlohmann::json& document, V& out);

// The texts of an enum's values, in the order of their table.
template <named_enum E>
inline constexpr auto enum_texts = [] {
  std::array<std::string_view, enum_table<E>.size()> result{};
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = enum_table<E>[i].second;
  return result;
}();

template <class V>
[[nodiscard]] bool read_integer(json_reading& reading, const nlohmann::json& document, V& out) {
  std::uint64_t bits = 0;
  if (!reading.read(document, static_cast<std::int64_t>(std::numeric_limits<V>::min()),
                    static_cast<std::uint64_t>(std::numeric_limits<V>::max()), bits))
    return false;
  out = static_cast<V>(bits);
  return true;
}

template <class V>
[[nodiscard]] bool read_list(json_reading& reading, const nlohmann::json& document, V& out) {
  std::optional<std::size_t> size;
  if constexpr (!is_vector<V>::value)
    size = out.size();
  if (!reading.expect_list(document, size))
    return false;
  if constexpr (is_vector<V>::value)
    out.resize(*size);
  for (std::size_t i = 0; i < *size; ++i) {
    typename V::value_type each{};
    if (!read_value(reading, reading.enter(document, i), each))
      return false;
    reading.leave();
    out[i] = std::move(each);
  }
  return true;
}

template <has_fields T>
[[nodiscard]] bool read_fields(json_reading& reading, const nlohmann::json& document, T& out);

template <class V>
bool read_value(json_reading& reading, const nlohmann::json& document, V& out) {
  if constexpr (has_fields<V>) {
    return read_fields(reading, document, out);
  } else if constexpr (std::is_same_v<V, bool> || std::is_same_v<V, std::string> || std::is_same_v<V, double>) {
    return reading.read(document, out);
  } else if constexpr (is_char_array<V>::value) {
    return reading.read(document, std::span<char>(out));
  } else if constexpr (named_enum<V>) {
    std::size_t index = 0;
    if (!reading.read(document, enum_texts<V>, index))
      return false;
    out = enum_table<V>[index].first;
    return true;
  } else if constexpr (std::is_enum_v<V>) {
    std::underlying_type_t<V> number{};
    if (!read_integer(reading, document, number))
      return false;
    out = static_cast<V>(number);
    return true;
  } else if constexpr (std::is_floating_point_v<V>) {
    double number = 0;
    if (!reading.read(document, number))
      return false;
    out = static_cast<V>(number);
    return true;
  } else if constexpr (std::is_integral_v<V>) {
    return read_integer(reading, document, out);
  } else if constexpr (is_duration<V>::value) {
    typename V::rep count{};
    if (!read_integer(reading, document, count))
      return false;
    out = V(count);
    return true;
  } else if constexpr (is_time_point<V>::value) {
    typename V::duration since_epoch{};
    if (!read_value(reading, document, since_epoch))
      return false;
    out = V(since_epoch);
    return true;
  } else if constexpr (is_optional<V>::value) {
    if (!json_reading::is_null(document))
      return read_value(reading, document, out.emplace());
    out.reset();
    return true;
  } else if constexpr (is_vector<V>::value || is_std_array<V>::value) {
    return read_list(reading, document, out);
  } else {
    static_assert(unsupported_field<V>, "this kind of value has no JSON form; see io/fields/field_table.hpp");
  }
}

template <has_fields T>
bool read_fields(json_reading& reading, const nlohmann::json& document, T& out) {
  if (!reading.expect_object(document))
    return false;
  static constexpr auto names = T::fields.entries.apply(
      [](const auto&... entry) { return std::array<std::string_view, sizeof...(entry)>{entry.name...}; });
  const auto read_one = [&](const auto& entry) {
    const auto* const found = reading.enter(document, entry.name);
    if (found == nullptr)
      return true;
    const bool is_read = read_value(reading, *found, out.*entry.member);
    reading.leave();
    return is_read;
  };
  return T::fields.entries.apply([&](const auto&... entry) { return (read_one(entry) && ...); }) &&
         reading.refuse_unknown(document, names);
}

template <has_fields T>
[[nodiscard]] json_read_result read_json(const nlohmann::json& document, T& out, std::string_view path = {}) {
  json_reading reading(path);
  (void)read_fields(reading, document, out);
  return reading.result();
}

} // namespace godwit::io
