// What io/fields needs to know of an item, so that a struct with items in it is a message like any other: JSON in both
// directions, the binary form of the trace, the JSON Schema.
//
// The templates of io/fields find these functions by the argument's namespace. A field that is absent is left out, and
// not written as null: the schema of an item does not know null. Thread: pure.
#pragma once

#include <string>

#include "io/fields/forms_fwd.hpp"
#include "messages/mission/item.hpp"

namespace godwit::mission {

void append_json_value(std::string& out, const item& value);
[[nodiscard]] bool read_value(io::json_reading& reading, const nlohmann::json& document, item& out);

// In the trace an item is its JSON text: its fields differ from kind to kind.
void encode_value(io::byte_sink& sink, const item& value);

} // namespace godwit::mission

template <>
void godwit::io::append_decoded_json<godwit::mission::item>(std::string& out, byte_source& source);

template <>
nlohmann::json godwit::io::json_schema<godwit::mission::item>();
