// What the trace and the dead-letter table know of a message type: its name, and how to turn it into bytes and JSON.
// One constant object for each type, made from the field table. Thread: constant.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "io/fields/binary.hpp"
#include "io/fields/field_table.hpp"
#include "io/fields/json_schema.hpp"
#include "io/fields/json_text.hpp"

namespace godwit::runtime {

struct message_type {
  std::string_view name;
  void (*encode)(io::byte_sink& sink, const void* body);             // compact bytes, secrets left out
  void (*append_decoded)(std::string& out, io::byte_source& source); // these bytes as JSON
  nlohmann::json (*schema)();                                        // JSON Schema of that JSON
};

template <io::has_fields T>
inline constexpr message_type type_of{
    T::fields.type_name,
    [](io::byte_sink& sink, const void* body) { io::encode_value(sink, *static_cast<const T*>(body)); },
    [](std::string& out, io::byte_source& source) { io::append_decoded_json<T>(out, source); },
    []() { return io::json_schema<T>(); },
};

} // namespace godwit::runtime
