// The handlers of an actor, one for each message of its mailbox: looked up at run time by the address of the message's
// type, checked for completeness when they are compiled. Thread: the actor's.
#pragma once

#include <algorithm>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/envelope.hpp"
#include "runtime/seam.hpp"

namespace godwit::runtime {

struct handler_row {
  const message_type* type = nullptr;
  std::function<void(const envelope&)> call;
};

// A handler for WORD; made by actor_base::on and on_deferred.
template <class Signature>
struct handler {
  handler_row row;
};

class handler_table {
public:
  handler_table() = default;

  // Null: this actor does not take the type.
  [[nodiscard]] const handler_row* find(const message_type* type) const {
    const auto found = std::ranges::find(rows_, type, &handler_row::type);
    return found == rows_.end() ? nullptr : &*found;
  }

  // By the name of the type.
  [[nodiscard]] const message_type* type_named(std::string_view name) const {
    const auto found = std::ranges::find_if(rows_, [&](const auto& each) { return each.type->name == name; });
    return found == rows_.end() ? nullptr : found->type;
  }

protected:
  explicit handler_table(std::vector<handler_row> rows) : rows_(std::move(rows)) {}

private:
  std::vector<handler_row> rows_;
};

namespace detail {

template <class Signature, class... Signatures>
inline constexpr int count_of = (0 + ... + (std::same_as<Signature, Signatures> ? 1 : 0));

} // namespace detail

template <class Mailbox>
class handlers_of;

template <class... Signatures>
class handlers_of<mailbox<Signatures...>> : public handler_table {
public:
  template <class... Given>
  // NOLINTNEXTLINE(google-explicit-constructor): `return {on<a>(...), on<b>(...)};`
  handlers_of(handler<Given>... given) : handler_table(std::vector<handler_row>{std::move(given.row)...}) {
    static_assert(((detail::count_of<Signatures, Given...> == 1) && ...),
                  "each message of the mailbox has exactly one handler");
    static_assert(sizeof...(Signatures) == sizeof...(Given), "a handler answers to no message of the mailbox");
  }
};

} // namespace godwit::runtime
