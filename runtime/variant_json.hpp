// Events and effects are variants of message structs; in the journal each is the name of its type and the JSON of its
// fields. Reading back a name that the variant does not have, or JSON that does not fit, throws state_unreadable: the
// journal is from another version of the actor, and starting empty over it is not allowed. Thread: pure.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "runtime/journal_exceptions.hpp"
#include "runtime/message_type.hpp"

namespace godwit::runtime {

template <io::has_fields T>
[[nodiscard]] std::string json_of(const T& value) {
  std::string result;
  type_of<T>().append_json(result, &value);
  return result;
}

// Reads BODY into VALUE; throws state_unreadable. TYPE is for the sentence.
void read_stored_json(const std::string& actor, const message_type& type, std::string_view body, void* value);

template <class Variant>
[[nodiscard]] std::string alternative_name(const Variant& value) {
  return std::visit([]<class T>(const T&) { return std::string(T::fields.type_name); }, value);
}

template <class Variant>
[[nodiscard]] std::string alternative_json(const Variant& value) {
  return std::visit([](const auto& each) { return json_of(each); }, value);
}

namespace detail {

template <class T, class Variant>
struct index_in;
template <class T, class... Rest>
struct index_in<T, std::variant<T, Rest...>> : std::integral_constant<std::size_t, 0> {};
template <class T, class First, class... Rest>
struct index_in<T, std::variant<First, Rest...>>
    : std::integral_constant<std::size_t, 1 + index_in<T, std::variant<Rest...>>::value> {};

} // namespace detail

template <class Variant, class T>
inline constexpr std::size_t alternative_index = detail::index_in<T, Variant>::value;

template <class Variant>
[[nodiscard]] Variant read_alternative(const std::string& actor, std::string_view type, const std::string& body) {
  return [&]<std::size_t... I>(std::index_sequence<I...>)->Variant {
    Variant result;
    bool found = false;
    const auto try_one = [&]<class T>(std::in_place_type_t<T>) {
      if (found || T::fields.type_name != type)
        return;
      found = true;
      T value{};
      read_stored_json(actor, type_of<T>(), body, &value);
      result = std::move(value);
    };
    (try_one(std::in_place_type<std::variant_alternative_t<I, Variant>>), ...);
    if (!found)
      throw state_unreadable(actor, "it does not know " + std::string(type));
    return result;
  }
  (std::make_index_sequence<std::variant_size_v<Variant>>());
}

} // namespace godwit::runtime
