// What io/fields needs to know of an item, so that a struct with items in it is a message like any other: JSON in both
// directions, the binary form of the trace, the JSON Schema.
//
// The templates of io/fields find these functions by the argument's namespace. A field that is absent is left out, and
// not written as null: the schema of an item does not know null. Thread: pure.
#pragma once

#include <string>
#include <type_traits>
#include <utility>

#include <nlohmann/json.hpp>

#include "io/fields/binary.hpp"
#include "io/fields/json_schema.hpp"
#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"
#include "messages/mission/item.hpp"

namespace godwit::mission {

inline void append_json_value(std::string& out, const item& value) {
  std::visit(
      [&]<class T>(const T& each) {
        out += "{\"kind\":";
        io::append_json_string(out, T::kind);
        io::for_each_field<T>([&]<class Value>(const io::field_entry<T, Value>& entry) {
          if constexpr (io::is_optional<Value>::value)
            if (!(each.*entry.member))
              return;
          out.append(",\"").append(entry.name).append("\":");
          io::append_json_value(out, each.*entry.member);
        });
        out += '}';
      },
      value);
}

// OUT becomes the alternative T if FOUND is its kind. Returns whether it was.
template <class T>
[[nodiscard]] bool read_as(const nlohmann::json& found, const nlohmann::json& document, item& out,
                           const std::string& path, io::json_read_result& result) {
  if (found != T::kind)
    return false;
  auto rest = document;
  rest.erase("kind");
  T value;
  result = io::read_json(rest, value, path);
  out = std::move(value);
  return true;
}

[[nodiscard]] inline io::json_read_result read_json_value(const nlohmann::json& document, item& out,
                                                          const std::string& path) {
  if (!document.is_object())
    return io::mismatch(path, "an object", document);
  const auto kind = document.value("kind", nlohmann::json());
  io::json_read_result result;
  const bool known = [&]<class... T>(std::type_identity<std::variant<T...>>) {
    return (read_as<T>(kind, document, out, path, result) || ...);
  }(std::type_identity<item>{});
  return known ? result : io::mismatch(path + ".kind", "a kind of item", kind);
}

// In the trace an item is its JSON text: its fields differ from kind to kind.
inline void encode_value(io::byte_sink& sink, const item& value) {
  std::string text;
  append_json_value(text, value);
  io::encode_value(sink, text);
}

} // namespace godwit::mission

template <>
inline void godwit::io::append_decoded_json<godwit::mission::item>(std::string& out, byte_source& source) {
  std::uint32_t size = 0;
  source.get(&size, sizeof size);
  const auto text = source.text(size);
  out += text.empty() ? "null" : text; // cut off by the end of the ring
}

template <>
inline nlohmann::json godwit::io::json_schema<godwit::mission::item>() {
  return {{"type", "object"}, {"required", {"id", "kind"}}};
}
