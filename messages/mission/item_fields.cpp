#include "messages/mission/item_fields.hpp"

#include <type_traits>
#include <utility>

#include <nlohmann/json.hpp>

#include "io/fields/binary.hpp"
#include "io/fields/json_schema.hpp"
#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"

namespace godwit::mission {

void append_json_value(std::string& out, const item& value) {
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

namespace {

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

} // namespace

io::json_read_result read_json_value(const nlohmann::json& document, item& out, const std::string& path) {
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
