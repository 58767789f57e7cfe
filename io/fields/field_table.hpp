// The one list of a struct's fields, from which everything else is generated: equality, JSON both ways, JSON Schema,
// the compact binary form of the trace and (in runtime) CAF's inspect.
//
// A struct takes part by naming its table:
//
//   struct moved {
//     double distance_m = 0;
//     std::uint32_t count = 0;
//     GODWIT_FIELDS(moved, "odometer.moved", distance_m, count);
//   };
//   enum class unit { metre, mile };
//   GODWIT_ENUM_NAMES(unit, metre, mile);
//
// The macros name each field and each value as the code does. A table with a field that is secret, or that has another
// name outside of the code, is written out:
//
//   static constexpr auto fields = io::table("login", io::field("user", &login::user_name),
//                                            io::secret("operator_token", &login::operator_token));
//
// Kinds of value: bool, integers, floating point, enums (text where `enum_names(E)` is found by argument-dependent
// lookup, else the number), std::string, std::chrono durations and time points (a count), std::optional, std::vector,
// std::array, and structs with a table of their own. An std::array of char is a text of fixed room: it fills the room
// or ends at its first NUL. A field marked secret exists in memory and in the mailbox, and is never rendered anywhere.
// Thread: all constexpr or pure.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/fields/each_name.hpp"

namespace godwit::io {

template <class Owner, class Value>
struct field_entry {
  std::string_view name;
  Value Owner::*member;
  bool is_secret;
};

namespace detail {

// What std::tuple would be, at a tenth of the time that it takes to compile: there are some 350 tables, and most source
// files see half of them.
template <std::size_t I, class Entry>
struct entry_at {
  Entry value;
};

template <class Indices, class... Entries>
struct entry_list;
template <std::size_t... I, class... Entries>
struct entry_list<std::index_sequence<I...>, Entries...> : entry_at<I, Entries>... {
  template <class F>
  constexpr decltype(auto) apply(F&& f) const {
    return f(static_cast<const entry_at<I, Entries>&>(*this).value...);
  }
};

} // namespace detail

template <class... Entries>
struct field_table {
  static constexpr std::size_t count = sizeof...(Entries);

  std::string_view type_name; // unique among all messages of the project
  detail::entry_list<std::index_sequence_for<Entries...>, Entries...> entries;
};

template <class Owner, class Value>
constexpr field_entry<Owner, Value> field(std::string_view name, Value Owner::*member) {
  return {name, member, false};
}

template <class Owner, class Value>
constexpr field_entry<Owner, Value> secret(std::string_view name, Value Owner::*member) {
  return {name, member, true};
}

template <class... Entries>
constexpr field_table<Entries...> table(std::string_view type_name, Entries... entries) {
  return {type_name, {{entries}...}};
}

template <class T>
concept has_fields = requires {
  { T::fields.type_name } -> std::convertible_to<std::string_view>;
  T::fields.entries;
};

template <has_fields T>
constexpr std::string_view type_name() {
  return T::fields.type_name;
}

// Calls VISIT(entry) for each field in the order of the table.
template <has_fields T, class Visitor>
constexpr void for_each_field(Visitor&& visit) {
  T::fields.entries.apply([&](const auto&... entry) { (visit(entry), ...); });
}

template <class E>
constexpr std::pair<E, std::string_view> name(E value, std::string_view text) {
  return {value, text};
}

// The text of an enum's values where it is not their name in the code: `constexpr auto enum_names(colour) { return
// io::names<colour>({{colour::red, "RED"}, ...}); }`
template <class E, std::size_t N>
constexpr std::array<std::pair<E, std::string_view>, N> names(const std::pair<E, std::string_view> (&list)[N]) {
  return std::to_array(list);
}

template <class E>
concept named_enum = std::is_enum_v<E> && requires(E value) {
  enum_names(value);
};

// One for the program, and not one on the stack of each use.
template <named_enum E>
inline constexpr auto enum_table = enum_names(E{});

template <named_enum E>
constexpr std::string_view name_of(E value) {
  for (const auto& [each, text] : enum_table<E>)
    if (each == value)
      return text;
  return {};
}

template <named_enum E>
constexpr std::optional<E> value_of(std::string_view text) {
  for (const auto& [each, name] : enum_table<E>)
    if (name == text)
      return each;
  return std::nullopt;
}

template <class T>
struct is_optional : std::false_type {};
template <class T>
struct is_optional<std::optional<T>> : std::true_type {};

template <class T>
struct is_vector : std::false_type {};
template <class T, class A>
struct is_vector<std::vector<T, A>> : std::true_type {};

template <class T>
struct is_std_array : std::false_type {};
template <class T, std::size_t N>
struct is_std_array<std::array<T, N>> : std::true_type {};

template <class T>
struct is_char_array : std::false_type {};
template <std::size_t N>
struct is_char_array<std::array<char, N>> : std::true_type {};

// The text in ROOM: up to its first NUL, or all of it.
template <std::size_t N>
constexpr std::string_view text_in(const std::array<char, N>& room) {
  const std::string_view all(room.data(), N);
  return all.substr(0, all.find('\0'));
}

template <class T>
struct is_duration : std::false_type {};
template <class R, class P>
struct is_duration<std::chrono::duration<R, P>> : std::true_type {};

template <class T>
struct is_time_point : std::false_type {};
template <class C, class D>
struct is_time_point<std::chrono::time_point<C, D>> : std::true_type {};

template <class>
inline constexpr bool unsupported_field = false;

// Member-wise equality by the table; usable in tests and for `operator==` of message structs.
template <has_fields T>
constexpr bool equal(const T& a, const T& b);

template <class V>
constexpr bool equal_value(const V& a, const V& b) {
  if constexpr (has_fields<V>) {
    return equal(a, b);
  } else if constexpr (is_optional<V>::value) {
    return a.has_value() == b.has_value() && (!a || equal_value(*a, *b));
  } else if constexpr (is_vector<V>::value || is_std_array<V>::value) {
    if (a.size() != b.size())
      return false;
    for (std::size_t i = 0; i < a.size(); ++i)
      if (!equal_value(a[i], b[i]))
        return false;
    return true;
  } else {
    return a == b;
  }
}

template <has_fields T>
constexpr bool equal(const T& a, const T& b) {
  return T::fields.entries.apply(
      [&](const auto&... entry) { return (equal_value(a.*entry.member, b.*entry.member) && ...); });
}

} // namespace godwit::io

#define GODWIT_FIELD(type, member) ::godwit::io::field(#member, &type::member)
#define GODWIT_FIELDS(type, type_name, ...)                                                                            \
  static constexpr auto fields = ::godwit::io::table(type_name, GODWIT_EACH_NAME(GODWIT_FIELD, type, __VA_ARGS__))

#define GODWIT_ENUM_NAME(type, value) ::godwit::io::name(type::value, #value)
#define GODWIT_ENUM_NAMES(type, ...)                                                                                   \
  constexpr auto enum_names(type) {                                                                                    \
    return ::godwit::io::names<type>({GODWIT_EACH_NAME(GODWIT_ENUM_NAME, type, __VA_ARGS__)});                         \
  }                                                                                                                    \
  static_assert(::godwit::io::named_enum<type>)
