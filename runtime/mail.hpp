// What travels between actors: a header and the message itself, always together.
//
// The header says which message this is, which message caused it, who sent it and, where the message is a durable
// effect, which one, so that a receiver can tell a repetition. CAF's inspect is generated here from the field table of
// the message; the message types themselves know nothing of CAF. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>

#include <caf/all.hpp>

#include "io/fields/field_table.hpp"
#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"

namespace godwit::runtime {

struct header {
  std::uint64_t id = 0;          // below 2^53, so that JSON readers keep it exact; 0 = none
  std::uint64_t cause = 0;       // id of the message whose handler sent this one; 0 = from outside
  std::int64_t effect_event = 0; // event number of the durable effect; 0 = not a durable effect
  std::uint32_t effect_n = 0;    // which effect of that event
  std::uint32_t sender = 0;      // number of the sender's stable address; 0 = outside
};

template <io::has_fields T>
struct mail {
  header head;
  T body;
};

// CAF asks for this to render, copy to a network or compare messages. godwit never sends them over a network; the text
// form is the same JSON as everywhere else.
template <class Inspector, class T>
typename Inspector::result_type inspect(Inspector& f, mail<T>& m) {
  std::string text;
  if constexpr (Inspector::reads_state)
    text = io::to_json(m.body);
  if constexpr (Inspector::writes_state) {
    auto result = f(m.head.id, m.head.cause, m.head.effect_event, m.head.effect_n, m.head.sender, text);
    if (const auto document = nlohmann::json::parse(text, nullptr, false); !document.is_discarded())
      (void)io::read_json(document, m.body);
    return result;
  } else {
    return f(caf::meta::type_name(T::fields.type_name.data()), m.head.id, m.head.cause, m.head.effect_event,
             m.head.effect_n, m.head.sender, text);
  }
}

} // namespace godwit::runtime
