// The one concrete message that travels between actors: header, type and body.
//
// A body that is small and trivially copyable lies inside the envelope; any other is shared and constant, so that
// putting a message back, tracing it and telling it to several receivers copy no content. Thread: plain values; a
// shared body is never written again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <nlohmann/json_fwd.hpp>

#include "io/fields/field_table.hpp"
#include "runtime/assert.hpp"

namespace godwit::runtime {

// What travels in front of every message: which one it is, what caused it, who sent it and, where the message is a
// durable effect, which one, so that a receiver can tell a repetition. Thread: plain values.
struct header {
  std::uint64_t id = 0;          // below 2^53, so that JSON readers keep it exact; 0 = none
  std::uint64_t cause = 0;       // id of the message whose handler sent this one; 0 = from outside
  std::int64_t effect_event = 0; // event number of the durable effect; 0 = not a durable effect
  std::uint32_t effect_n = 0;    // which effect of that event
  std::uint32_t sender = 0;      // number of the sender's stable address; 0 = outside
};

} // namespace godwit::runtime

namespace godwit::io {

// What the runtime knows of a message type: its name, and how to turn a value into bytes and JSON and back.
//
// There is one constant object for each type, and its address is the type's identity: a mailbox looks its handlers up
// by it. The functions after it are instantiated from the field table in one source file, the types.cpp beside the
// message's types.hpp (define_message.hpp); everybody else only names type_of<T>(), so that touching or sending a
// message compiles no JSON. Of a type that has the same name in another shared object the address differs: its
// messages are refused as unknown, because nothing says that the layout is the same. Thread: constant.
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

class message_body {
public:
  static constexpr std::size_t inline_bytes = 64; // most of what a vehicle says many times a second

  template <class T>
  static constexpr bool is_inline = std::is_trivially_copyable_v<T> && sizeof(T) <= inline_bytes &&
                                    alignof(T) <= alignof(std::int64_t);

  message_body() = default;

  template <class T>
  [[nodiscard]] static message_body of(T value) {
    message_body result;
    if constexpr (is_inline<T>)
      ::new (static_cast<void*>(result.small_)) T(std::move(value));
    else
      result.large_ = std::make_shared<const T>(std::move(value));
    return result;
  }

  [[nodiscard]] const void* data() const noexcept { return large_ ? large_.get() : static_cast<const void*>(small_); }

private:
  std::shared_ptr<const void> large_;
  alignas(std::int64_t) std::byte small_[inline_bytes] = {};
};

struct envelope {
  header head;
  const message_type* type = nullptr;
  message_body body;

  template <class T>
  [[nodiscard]] static envelope of(const header& head, T value) {
    return {head, &type_of<T>(), message_body::of(std::move(value))};
  }

  template <class T>
  [[nodiscard]] bool is() const {
    return type == &type_of<T>();
  }

  template <class T>
  [[nodiscard]] const T& as() const {
    GODWIT_ASSERT(is<T>(), "an envelope is opened as the type that it was closed with");
    return *static_cast<const T*>(body.data());
  }
};

} // namespace godwit::runtime
