// The compact binary form in which the trace keeps a message between the actor's thread and the writer's: values in the
// order of the table, numbers as in memory, lists and texts with a 32-bit length in front. Never leaves the process, so
// no versions.
//
// Secrets are skipped when encoding: they do not even reach the ring. The decoder writes JSON text and is bounded by
// the bytes that it was given. Thread: pure.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

#include "io/fields/field_table.hpp"
#include "io/fields/json_text.hpp"

namespace godwit::io {

// Where encoding goes: a fixed piece of memory. Running over its end is remembered and writes nothing.
class byte_sink {
public:
  explicit byte_sink(std::span<std::byte> memory) : memory_(memory) {}

  void put(const void* data, std::size_t size) {
    if (size > memory_.size() - used_) {
      overflow_ = true;
      return;
    }
    std::copy_n(static_cast<const std::byte*>(data), size, memory_.data() + used_); // unlike memcpy: null for none
    used_ += size;
  }

  [[nodiscard]] std::size_t used() const { return used_; }
  [[nodiscard]] bool overflow() const { return overflow_; }

private:
  std::span<std::byte> memory_;
  std::size_t used_ = 0;
  bool overflow_ = false;
};

// Where decoding comes from. Reading past the end gives zeros and is remembered.
class byte_source {
public:
  explicit byte_source(std::span<const std::byte> bytes) : bytes_(bytes) {}

  void get(void* out, std::size_t size) {
    if (size > bytes_.size()) {
      std::memset(out, 0, size);
      bytes_ = {};
      exhausted_ = true;
      return;
    }
    std::memcpy(out, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
  }

  [[nodiscard]] std::string_view text(std::size_t size) {
    if (size > bytes_.size()) {
      exhausted_ = true;
      size = 0;
    }
    const std::string_view result(reinterpret_cast<const char*>(bytes_.data()), size);
    bytes_ = bytes_.subspan(size);
    return result;
  }

  [[nodiscard]] bool exhausted() const { return exhausted_; }

private:
  std::span<const std::byte> bytes_;
  bool exhausted_ = false;
};

// Appends VALUE; what does not fit is left out and the sink says so.
template <class V>
void encode_value(byte_sink& sink, const V& value) {
  if constexpr (has_fields<V>) {
    for_each_field<V>([&](const auto& entry) {
      if (!entry.is_secret)
        encode_value(sink, value.*entry.member);
    });
  } else if constexpr (std::is_same_v<V, std::string>) {
    const auto size = static_cast<std::uint32_t>(value.size());
    sink.put(&size, sizeof size);
    sink.put(value.data(), size);
  } else if constexpr (is_optional<V>::value) {
    const bool present = value.has_value();
    sink.put(&present, sizeof present);
    if (present)
      encode_value(sink, *value);
  } else if constexpr (is_vector<V>::value) {
    const auto size = static_cast<std::uint32_t>(value.size());
    sink.put(&size, sizeof size);
    for (std::size_t i = 0; i < value.size() && !sink.overflow(); ++i)
      encode_value(sink, static_cast<const typename V::value_type&>(value[i]));
  } else if constexpr (is_std_array<V>::value) {
    for (const auto& each : value)
      encode_value(sink, each);
  } else {
    static_assert(std::is_trivially_copyable_v<V>, "this kind of value has no binary form");
    sink.put(&value, sizeof value);
  }
}

template <class V>
void append_decoded_json(std::string& out, byte_source& source);

template <has_fields T>
void append_decoded_object(std::string& out, byte_source& source) {
  append_json_object<T>(out,
                        [&]<class Value>(const field_entry<T, Value>&) { append_decoded_json<Value>(out, source); });
}

template <class V>
void append_decoded_list(std::string& out, byte_source& source, std::size_t size) {
  out += '[';
  for (std::size_t i = 0; i < size && !source.exhausted(); ++i) {
    if (i != 0)
      out += ',';
    append_decoded_json<V>(out, source);
  }
  out += ']';
}

// The JSON text of a V that was encoded with encode_value.
template <class V>
void append_decoded_json(std::string& out, byte_source& source) {
  if constexpr (has_fields<V>) {
    append_decoded_object<V>(out, source);
  } else if constexpr (std::is_same_v<V, std::string>) {
    std::uint32_t size = 0;
    source.get(&size, sizeof size);
    append_json_string(out, source.text(size));
  } else if constexpr (is_optional<V>::value) {
    bool present = false;
    source.get(&present, sizeof present);
    if (present)
      append_decoded_json<typename V::value_type>(out, source);
    else
      out += "null";
  } else if constexpr (is_vector<V>::value) {
    std::uint32_t size = 0;
    source.get(&size, sizeof size);
    append_decoded_list<typename V::value_type>(out, source, size);
  } else if constexpr (is_char_array<V>::value) {
    V room{};
    source.get(room.data(), room.size());
    append_json_value(out, room);
  } else if constexpr (is_std_array<V>::value) {
    append_decoded_list<typename V::value_type>(out, source, std::tuple_size_v<V>);
  } else {
    V value{};
    source.get(&value, sizeof value);
    append_json_value(out, value);
  }
}

} // namespace godwit::io
