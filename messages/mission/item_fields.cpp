#include "messages/mission/item_fields.hpp"

#include <optional>
#include <type_traits>
#include <utility>

#include <nlohmann/json.hpp>

#include "io/fields/binary.hpp"
#include "io/fields/json_schema.hpp"
#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"

namespace godwit::mission {

namespace {

template <class V>
void append_field(std::string& out, const V& value);

// Each after a comma, but for the first of an object that was just begun.
template <class T>
void append_fields(std::string& out, const T& value) {
  io::for_each_field<T>([&]<class Value>(const io::field_entry<T, Value>& entry) {
    if constexpr (io::is_optional<Value>::value)
      if (!(value.*entry.member))
        return;
    out.append(out.back() == '{' ? "\"" : ",\"").append(entry.name).append("\":");
    append_field(out, value.*entry.member);
  });
}

template <class V>
void append_field(std::string& out, const V& value) {
  if constexpr (io::is_optional<V>::value) {
    append_field(out, *value);
  } else if constexpr (io::has_fields<V>) {
    out += '{';
    append_fields(out, value);
    out += '}';
  } else {
    io::append_json_value(out, value);
  }
}

} // namespace

void append_json_value(std::string& out, const item& value) {
  std::visit(
      [&]<class T>(const T& each) {
        out += "{\"kind\":";
        io::append_json_string(out, T::kind);
        append_fields(out, each);
        out += '}';
      },
      value);
}

namespace {

// OUT becomes the alternative T if FOUND is its kind; nothing: it is not.
template <class T>
[[nodiscard]] std::optional<bool> read_as(io::json_reading& reading, const nlohmann::json& found,
                                          const nlohmann::json& document, item& out) {
  if (found != T::kind)
    return {};
  auto rest = document;
  rest.erase("kind");
  T value;
  const bool is_read = io::read_fields(reading, rest, value);
  out = std::move(value);
  return is_read;
}

} // namespace

bool read_value(io::json_reading& reading, const nlohmann::json& document, item& out) {
  if (!reading.expect_object(document))
    return false;
  const auto kind = document.value("kind", nlohmann::json());
  std::optional<bool> result;
  const bool known = [&]<class... T>(std::type_identity<std::variant<T...>>) {
    return ((result = read_as<T>(reading, kind, document, out)) || ...);
  }(std::type_identity<item>{});
  return known ? *result : reading.fail_at("kind", "a kind of item", kind);
}

// In the trace an item is its JSON text: its fields differ from kind to kind.
void encode_value(io::byte_sink& sink, const item& value) {
  std::string text;
  append_json_value(text, value);
  io::encode_value(sink, text);
}

} // namespace godwit::mission

template <>
void godwit::io::append_decoded_json<godwit::mission::item>(std::string& out, byte_source& source) {
  std::uint32_t size = 0;
  source.get(&size, sizeof size);
  const auto text = source.text(size);
  out += text.empty() ? "null" : text; // cut off by the end of the ring
}

template <>
nlohmann::json godwit::io::json_schema<godwit::mission::item>() {
  return {{"type", "object"}, {"required", {"id", "kind"}}};
}
