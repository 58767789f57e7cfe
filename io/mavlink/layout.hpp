// How a message lies on the wire, worked out at compile time from its field table.
//
// Fields are sorted by the size of their elements, largest first, and keep the order of the table where sizes are
// equal; extensions follow unsorted, as they were added over the years. CRC_EXTRA is a checksum of names and types in
// that order without the extensions, so it proves that a table names its fields as the published message does. Source:
// the MAVLink guide, "Packet Serialization" and "CRC_EXTRA". Thread: all constexpr.
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "io/fields/field_table.hpp"
#include "io/mavlink/crc.hpp"
#include "io/mavlink/wire_format.hpp"

namespace godwit::io::mavlink {

// A struct with a field table and the published number of its message. The member is called `message_id`, because
// some messages have a field `id`.
template <class M>
concept message = has_fields<M> && requires {
  { M::message_id } -> std::convertible_to<std::uint32_t>;
  { M::crc_extra } -> std::convertible_to<std::uint8_t>;
};

// How many of the last entries of the table are extensions; a message without any need not say so.
template <message M>
constexpr std::size_t extension_count() {
  if constexpr (requires { M::extensions; })
    return M::extensions;
  else
    return 0;
}

template <class V>
struct wire_value { // a single number
  using element = V;
  static constexpr std::size_t count = 1;
  static constexpr bool is_array = false;
};

template <class V, std::size_t N>
struct wire_value<std::array<V, N>> {
  using element = V;
  static constexpr std::size_t count = N;
  static constexpr bool is_array = true;
};

// The name of a type in the message definitions.
template <class V>
constexpr std::string_view wire_type_name() {
  if constexpr (std::is_same_v<V, char>)
    return "char";
  else if constexpr (std::is_same_v<V, float>)
    return "float";
  else if constexpr (std::is_same_v<V, double>)
    return "double";
  else {
    static_assert(std::is_integral_v<V> && !std::is_same_v<V, bool>, "not a type of the message definitions");
    constexpr std::array<std::string_view, 4> unsigned_names{"uint8_t", "uint16_t", "uint32_t", "uint64_t"};
    constexpr std::array<std::string_view, 4> signed_names{"int8_t", "int16_t", "int32_t", "int64_t"};
    constexpr auto index = static_cast<std::size_t>(std::bit_width(sizeof(V)) - 1);
    return std::is_signed_v<V> ? signed_names[index] : unsigned_names[index];
  }
}

struct wire_field {
  std::string_view name;
  std::string_view type;
  std::size_t element_size = 0;
  std::size_t count = 1;
  bool is_array = false;
  std::size_t table_index = 0; // its place in the field table

  [[nodiscard]] constexpr std::size_t size() const { return element_size * count; }
};

template <class Owner, class V>
constexpr wire_field describe(const field_entry<Owner, V>& entry) {
  using value = wire_value<V>;
  using element = typename value::element;
  return {entry.name, wire_type_name<element>(), sizeof(element), value::count, value::is_array, 0};
}

template <message M>
inline constexpr std::size_t field_count = decltype(M::fields)::count;

// The fields in the order of the wire.
template <message M>
constexpr auto wire_order() {
  auto fields = M::fields.entries.apply([](const auto&... entry) { return std::array{describe(entry)...}; });
  for (std::size_t i = 0; i < fields.size(); ++i)
    fields[i].table_index = i;
  // An insertion sort: std::stable_sort is not constexpr, and there are at most some twenty fields.
  const auto base_count = fields.size() - extension_count<M>();
  for (std::size_t i = 1; i < base_count; ++i)
    for (std::size_t j = i; j > 0 && fields[j - 1].element_size < fields[j].element_size; --j)
      std::swap(fields[j - 1], fields[j]);
  return fields;
}

template <message M>
struct layout {
  static constexpr auto fields = wire_order<M>();

  // The length of the first COUNT fields on the wire.
  static constexpr std::size_t length_of(std::size_t count) {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < count; ++i)
      sum += fields[i].size();
    return sum;
  }

  static constexpr std::size_t base_length = length_of(field_count<M> - extension_count<M>());
  static constexpr std::size_t full_length = length_of(field_count<M>);
  static_assert(full_length <= max_payload_size);

  // Where each field stands in the payload, by its place in the table.
  static constexpr auto offsets = [] {
    std::array<std::size_t, field_count<M>> result{};
    for (std::size_t i = 0; i < fields.size(); ++i)
      result[fields[i].table_index] = length_of(i);
    return result;
  }();

  static constexpr std::uint8_t crc_extra = [] {
    std::uint16_t crc = crc_of_text(crc_of_text(crc_init, M::fields.type_name), " ");
    for (std::size_t i = 0; i < fields.size() - extension_count<M>(); ++i) {
      const wire_field& each = fields[i];
      crc = crc_of_text(crc_of_text(crc_of_text(crc_of_text(crc, each.type), " "), each.name), " ");
      if (each.is_array)
        crc = crc_of_byte(crc, static_cast<std::uint8_t>(each.count));
    }
    return static_cast<std::uint8_t>((crc & 0xFFU) ^ (crc >> 8U));
  }();
};

// True if the table of M gives the published CRC_EXTRA and lengths (without and with the extensions).
template <message M>
consteval bool as_published(std::size_t base_length, std::size_t full_length) {
  return layout<M>::crc_extra == M::crc_extra && layout<M>::base_length == base_length &&
         layout<M>::full_length == full_length;
}

// Calls VISIT(entry, offset) for each field of the table.
template <message M, class Visitor>
constexpr void for_each_placed_field(Visitor&& visit) {
  M::fields.entries.apply([&](const auto&... entry) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (visit(entry, std::integral_constant<std::size_t, layout<M>::offsets[I]>{}), ...);
    }
    (std::make_index_sequence<field_count<M>>{});
  });
}

// Reads M from PAYLOAD, which has all layout<M>::full_length bytes.
template <message M>
[[nodiscard]] inline M read_fields(const std::byte* payload) {
  M result;
  for_each_placed_field<M>([&](const auto& entry, auto offset) {
    auto& value = result.*entry.member;
    std::memcpy(&value, payload + offset, sizeof value);
  });
  return result;
}

// Writes all layout<M>::full_length bytes of MESSAGE to PAYLOAD.
template <message M>
inline void write_fields(const M& message, std::byte* payload) {
  for_each_placed_field<M>([&](const auto& entry, auto offset) {
    const auto& value = message.*entry.member;
    std::memcpy(payload + offset, &value, sizeof value);
  });
}

} // namespace godwit::io::mavlink
