// What the runtime knows of a message type: its name, and how to turn a value into bytes and JSON and back.
//
// There is one constant object for each type, and its address is the type's identity: a mailbox looks its handlers up
// by it. The functions behind it are instantiated from the field table in one source file, the types.cpp beside the
// message's types.hpp (define_message.hpp); everybody else only names type_of<T>(), so that touching or sending a
// message compiles no JSON. Of a type that has the same name in another shared object the address differs: its
// messages are refused as unknown, because nothing says that the layout is the same. Thread: constant.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "io/fields/field_table.hpp"

namespace godwit::io {
class byte_sink;
class byte_source;
} // namespace godwit::io

namespace godwit::runtime {

class message_body;

struct message_type {
  std::string_view name;
  void (*encode)(io::byte_sink& sink, const void* body);             // compact bytes, secrets left out
  void (*append_decoded)(std::string& out, io::byte_source& source); // these bytes as JSON
  nlohmann::json (*schema)();                                        // JSON Schema of that JSON
  void (*append_json)(std::string& out, const void* body);           // secrets left out
  // Reads BODY strictly; returns what is wrong and where, empty when nothing is.
  std::string (*read_json)(const nlohmann::json& document, void* body);
  // The same into a body of its own.
  std::string (*read_body)(const nlohmann::json& document, message_body& body);
};

template <io::has_fields T>
[[nodiscard]] const message_type& type_of() noexcept;

} // namespace godwit::runtime
