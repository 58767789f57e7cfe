// Reading an actor's snapshot: the version it was written with, migration up to today's, refusal of what is newer. And
// the form in which the trace has what an incarnation was restored from.
// Thread: pure.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include <nlohmann/json_fwd.hpp>
#include <tl/expected.hpp>

#include "runtime/envelope.hpp"
#include "runtime/journal/records.hpp"

namespace godwit::runtime {

// Brings a state of an older version to today's, or says why not.
using state_migration = tl::expected<nlohmann::json, std::string> (*)(nlohmann::json old, int from_version);

// Reads SNAPSHOT into STATE, a value of TYPE whose version is VERSION. Throws state_unreadable. MIGRATE may be null
// when there has been one version only.
void read_snapshot(const std::string& actor, const snapshot_record& snapshot, int version, state_migration migrate,
                   const message_type& type, void* state);

// What an incarnation begins with, as one JSON text for the trace: STATE is the snapshot of FROM with the later events
// applied; bodies that are JSON stand in it as such.
[[nodiscard]] std::string restored_json(const recovered& from, const snapshot_record& state);
// Read back: nothing when it is no such text. What was seen of others is not in it.
[[nodiscard]] std::optional<recovered> read_restored(const nlohmann::json& document);

template <class Core>
[[nodiscard]] typename Core::state read_state(const std::string& actor, const snapshot_record& snapshot) {
  using state = typename Core::state;
  state_migration migrate = nullptr;
  if constexpr (state::version > 1)
    migrate = &Core::migrate;
  state result{};
  read_snapshot(actor, snapshot, state::version, migrate, type_of<state>(), &result);
  return result;
}

// The ways in which durable memory ends an incarnation. All are for the supervisor, not for actor code.

// What the journal keeps of this actor can not be read by this version of it. Restarting does not help: the supervisor
// gives up at once.
struct state_unreadable : std::runtime_error {
  state_unreadable(const std::string& actor, const std::string& why)
      : std::runtime_error(
            "the journal's state of " + actor + " can not be read: " + why +
            ". It was written by another version of godwit; start that version, or move the journal away") {}
};

// An event can not be committed now, through no fault of the message: it is put back however often that happens, and
// the supervisor's back-off makes it wait.
struct commit_refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A newer incarnation has taken over: the journal takes no write of this one.
struct journal_refused : commit_refused {
  explicit journal_refused(const journal_error& why) : commit_refused(why.message()) {}
};

// Events and effects are variants of message structs; in the journal each is the name of its type and the JSON of its
// fields. Reading back a name that the variant does not have, or JSON that does not fit, throws state_unreadable: the
// journal is from another version of the actor, and starting empty over it is not allowed. Thread: pure.
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
