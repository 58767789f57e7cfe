// Writes values with a field table as JSON text, straight into a string and without a document in between: the trace
// renders hundreds of thousands of messages a second with it.
//
// Numbers that JSON does not know (NaN, infinities) become null. Text is taken as UTF-8; control characters are
// escaped, bytes that are not UTF-8 become U+FFFD, so that the result always parses. Secrets are left out. Thread:
// pure.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/fields/field_table.hpp"

namespace godwit::io {

void append_json_string(std::string& out, std::string_view text);

template <class V>
void append_json_value(std::string& out, const V& value);

inline void append_json_value(std::string& out, bool value) { out += value ? "true" : "false"; }

void append_json_double(std::string& out, double value); // as few digits as bring it back
void append_json_float(std::string& out, float value);
void append_json_signed(std::string& out, std::int64_t value);
void append_json_unsigned(std::string& out, std::uint64_t value);

template <class N>
requires std::is_arithmetic_v<N>
void append_json_number(std::string& out, N value) {
  if constexpr (std::is_same_v<N, float>)
    append_json_float(out, value);
  else if constexpr (std::is_floating_point_v<N>)
    append_json_double(out, value);
  else if constexpr (std::is_signed_v<N>)
    append_json_signed(out, value);
  else
    append_json_unsigned(out, value);
}

// ,"NAME": after the value before it, or without the comma after the brace that begins the object.
void append_json_name(std::string& out, std::string_view name);

// {"name":VALUE,...} for the open fields of T, in the order of the table; APPEND(entry) writes each VALUE.
template <has_fields T, class Append>
void append_json_object(std::string& out, Append append) {
  out += '{';
  for_each_field<T>([&](const auto& entry) {
    if (entry.is_secret)
      return;
    append_json_name(out, entry.name);
    append(entry);
  });
  out += '}';
}

template <has_fields T>
void append_json(std::string& out, const T& value) {
  append_json_object<T>(out, [&](const auto& entry) { append_json_value(out, value.*entry.member); });
}

template <class Range>
void append_json_array(std::string& out, const Range& values) {
  out += '[';
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i != 0)
      out += ',';
    append_json_value(out, static_cast<const typename Range::value_type&>(values[i]));
  }
  out += ']';
}

template <class V>
void append_json_value(std::string& out, const V& value) {
  if constexpr (has_fields<V>) {
    append_json(out, value);
  } else if constexpr (std::is_same_v<V, std::string> || std::is_same_v<V, std::string_view>) {
    append_json_string(out, value);
  } else if constexpr (is_char_array<V>::value) {
    append_json_string(out, text_in(value));
  } else if constexpr (named_enum<V>) {
    if (const auto text = name_of(value); !text.empty())
      append_json_string(out, text);
    else
      append_json_number(out, static_cast<std::int64_t>(value));
  } else if constexpr (std::is_enum_v<V>) {
    append_json_number(out, static_cast<std::int64_t>(value));
  } else if constexpr (std::is_same_v<V, char>) {
    append_json_string(out, std::string_view(&value, 1));
  } else if constexpr (std::is_arithmetic_v<V>) {
    append_json_number(out, value);
  } else if constexpr (is_duration<V>::value) {
    append_json_number(out, value.count());
  } else if constexpr (is_time_point<V>::value) {
    append_json_number(out, value.time_since_epoch().count());
  } else if constexpr (is_optional<V>::value) {
    if (value)
      append_json_value(out, *value);
    else
      out += "null";
  } else if constexpr (is_vector<V>::value || is_std_array<V>::value) {
    append_json_array(out, value);
  } else {
    static_assert(unsupported_field<V>, "this kind of value has no JSON form; see io/fields/field_table.hpp");
  }
}

template <has_fields T>
[[nodiscard]] std::string to_json(const T& value) {
  std::string out;
  append_json(out, value);
  return out;
}

} // namespace godwit::io
