// Makes the message_type of a type. For the one source file in which the type is defined, its types.cpp:
//
//   #include "messages/odometer/types.hpp"
//   #include "runtime/define_message.hpp"
//
//   GODWIT_DEFINE_MESSAGE(godwit::odometer::moved);
//   GODWIT_DEFINE_MESSAGES(godwit::odometer, reset, reset_done);
//
// Tests whose message types are their own include this file and need no macro.
#pragma once

#include <utility>

#include <nlohmann/json.hpp>

#include "io/fields/binary.hpp"
#include "io/fields/each_name.hpp"
#include "io/fields/json_schema.hpp"
#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"
#include "runtime/envelope.hpp"

namespace godwit::runtime {

template <io::has_fields T>
const message_type& type_of() noexcept {
  static constexpr message_type made{
      T::fields.type_name,
      [](io::byte_sink& sink, const void* body) { io::encode_value(sink, *static_cast<const T*>(body)); },
      [](std::string& out, io::byte_source& source) { io::append_decoded_json<T>(out, source); },
      []() { return io::json_schema<T>(); },
      [](std::string& out, const void* body) { io::append_json(out, *static_cast<const T*>(body)); },
      [](const nlohmann::json& document, void* body) {
        io::json_reading reading;
        (void)io::read_fields(reading, document, *static_cast<T*>(body));
        return reading.message();
      },
      [](const nlohmann::json& document, message_body& body) {
        T value{};
        io::json_reading reading;
        (void)io::read_fields(reading, document, value);
        body = message_body::of(std::move(value));
        return reading.message();
      },
  };
  return made;
}

// Instantiated for what it names: to use type_of is to instantiate it.
template <class... T>
struct defined_messages {
  static const message_type& (*const all[])() noexcept;
};

template <class... T>
const message_type& (*const defined_messages<T...>::all[])() noexcept = {&type_of<T>...};

} // namespace godwit::runtime

#define GODWIT_DEFINE_MESSAGE(T)                                                                                       \
  template const ::godwit::runtime::message_type& ::godwit::runtime::type_of<T>() noexcept
#define GODWIT_MESSAGE_IN(space, name) space::name
#define GODWIT_DEFINE_MESSAGES(space, ...)                                                                             \
  template struct ::godwit::runtime::defined_messages<GODWIT_EACH_NAME(GODWIT_MESSAGE_IN, space, __VA_ARGS__)>
