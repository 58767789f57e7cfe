// Reads values with a field table from a JSON document, strictly: an absent field keeps its default, an unknown
// property, a wrong type, a number out of range or an unknown enum text is an error that names the path.
//
// Secrets can be read (a configuration may hold one) but are never written. Thread: pure.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

#include "io/fields/field_table.hpp"
#include "io/fields/forms_fwd.hpp"

namespace godwit::io {

[[nodiscard]] tl::unexpected<json_mismatch> mismatch(const std::string& path, const std::string& expected,
                                                     const nlohmann::json& found);

template <has_fields T>
[[nodiscard]] json_read_result read_json(const nlohmann::json& document, T& out, const std::string& path = {});

template <class V>
[[nodiscard]] json_read_result read_integer(const nlohmann::json& document, V& out, const std::string& path) {
  if (!document.is_number_integer())
    return mismatch(path, "a whole number", document);
  const bool fits = document.is_number_unsigned() ? std::in_range<V>(document.get<std::uint64_t>())
                                                  : std::in_range<V>(document.get<std::int64_t>());
  if (!fits)
    return mismatch(path,
                    "a number from " + std::to_string(std::numeric_limits<V>::min()) + " to " +
                        std::to_string(std::numeric_limits<V>::max()),
                    document);
  out = document.get<V>();
  return {};
}

template <named_enum V>
[[nodiscard]] json_read_result read_enum(const nlohmann::json& document, V& out, const std::string& path) {
  if (document.is_string())
    if (const auto value = value_of<V>(document.get_ref<const std::string&>())) {
      out = *value;
      return {};
    }
  std::string allowed;
  for (const auto& [value, text] : enum_names(V{}))
    allowed += (allowed.empty() ? "one of \"" : ", \"") + std::string(text) + '"';
  return mismatch(path, allowed, document);
}

template <class V>
[[nodiscard]] json_read_result read_json_value(const nlohmann::json& document, V& out, const std::string& path);

template <class V>
[[nodiscard]] json_read_result read_list(const nlohmann::json& document, V& out, const std::string& path) {
  if (!document.is_array())
    return mismatch(path, "a list", document);
  if constexpr (is_vector<V>::value)
    out.resize(document.size());
  else if (document.size() != out.size())
    return mismatch(path, "a list of " + std::to_string(out.size()), document);
  for (std::size_t i = 0; i < document.size(); ++i) {
    typename V::value_type each{};
    if (auto read = read_json_value(document[i], each, path + '[' + std::to_string(i) + ']'); !read)
      return read;
    out[i] = std::move(each);
  }
  return {};
}

template <std::size_t N>
[[nodiscard]] json_read_result read_text(const nlohmann::json& document, std::array<char, N>& out,
                                         const std::string& path) {
  if (!document.is_string() || document.get_ref<const std::string&>().size() > N)
    return mismatch(path, "a text of at most " + std::to_string(N) + " bytes", document);
  out = {};
  std::ranges::copy(document.get_ref<const std::string&>(), out.begin());
  return {};
}

template <class V>
json_read_result read_json_value(const nlohmann::json& document, V& out, const std::string& path) {
  if constexpr (has_fields<V>) {
    return read_json(document, out, path);
  } else if constexpr (std::is_same_v<V, bool>) {
    if (!document.is_boolean())
      return mismatch(path, "true or false", document);
    out = document.get<bool>();
  } else if constexpr (std::is_same_v<V, std::string>) {
    if (!document.is_string())
      return mismatch(path, "a text", document);
    out = document.get<std::string>();
  } else if constexpr (is_char_array<V>::value) {
    return read_text(document, out, path);
  } else if constexpr (named_enum<V>) {
    return read_enum(document, out, path);
  } else if constexpr (std::is_enum_v<V>) {
    std::underlying_type_t<V> number{};
    if (auto read = read_integer(document, number, path); !read)
      return read;
    out = static_cast<V>(number);
  } else if constexpr (std::is_floating_point_v<V>) {
    if (document.is_null()) {
      out = std::numeric_limits<V>::quiet_NaN(); // what json_text writes for a number that JSON does not know
      return {};
    }
    if (!document.is_number())
      return mismatch(path, "a number", document);
    out = document.get<V>();
  } else if constexpr (std::is_integral_v<V>) {
    return read_integer(document, out, path);
  } else if constexpr (is_duration<V>::value) {
    typename V::rep count{};
    if (auto read = read_integer(document, count, path); !read)
      return read;
    out = V(count);
  } else if constexpr (is_time_point<V>::value) {
    typename V::rep count{};
    if (auto read = read_integer(document, count, path); !read)
      return read;
    out = V(typename V::duration(count));
  } else if constexpr (is_optional<V>::value) {
    if (document.is_null()) {
      out.reset();
      return {};
    }
    return read_json_value(document, out.emplace(), path);
  } else if constexpr (is_vector<V>::value || is_std_array<V>::value) {
    return read_list(document, out, path);
  } else {
    static_assert(unsupported_field<V>, "this kind of value has no JSON form; see io/fields/field_table.hpp");
  }
  return {};
}

template <has_fields T>
json_read_result read_json(const nlohmann::json& document, T& out, const std::string& path) {
  if (!document.is_object())
    return mismatch(path, "an object", document);
  json_read_result result;
  const auto prefix = path.empty() ? std::string() : path + '.';
  for_each_field<T>([&](const auto& entry) {
    if (const auto found = document.find(entry.name); result && found != document.end())
      result = read_json_value(*found, out.*entry.member, prefix + std::string(entry.name));
  });
  for (auto each = document.begin(); result && each != document.end(); ++each) {
    bool known = false;
    for_each_field<T>([&](const auto& entry) { known = known || entry.name == each.key(); });
    if (!known)
      result = tl::unexpected(json_mismatch{prefix + each.key(), "unknown property"});
  }
  return result;
}

} // namespace godwit::io
