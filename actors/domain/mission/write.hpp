// A value as the text of its document, in the form of config/schemas: a field that is absent is left out, which is
// where this differs from io::to_json (that writes null, for the trace and the journal).
//
// What breaks no rule (rules.hpp) reads back as itself, digit for digit. Thread: pure.
#pragma once

#include <string>

#include "io/fields/json_text.hpp"
#include "messages/mission/item_fields.hpp"

namespace godwit::mission {

template <class V>
void append_text(std::string& out, const V& value) {
  if constexpr (io::has_fields<V>) {
    out += '{';
    io::for_each_field<V>([&]<class Value>(const io::field_entry<V, Value>& entry) {
      if constexpr (io::is_optional<Value>::value)
        if (!(value.*entry.member))
          return;
      out.append(out.back() == '{' ? "\"" : ",\"").append(entry.name).append("\":");
      append_text(out, value.*entry.member);
    });
    out += '}';
  } else if constexpr (io::is_vector<V>::value) {
    out += '[';
    for (const auto& each : value) {
      if (out.back() != '[')
        out += ',';
      append_text(out, each);
    }
    out += ']';
  } else if constexpr (io::is_optional<V>::value) {
    append_text(out, *value);
  } else if constexpr (std::is_same_v<V, item>) {
    append_json_value(out, value);
  } else {
    io::append_json_value(out, value);
  }
}

template <io::has_fields T>
[[nodiscard]] std::string to_text(const T& value) {
  std::string out;
  append_text(out, value);
  return out;
}

} // namespace godwit::mission
