// The few signatures in which actors are written: a move to another actor library touches runtime/ only.
//
//   using handle = runtime::mailbox<runtime::tells<moved>, runtime::asks<get_total, total>>;
//
// `tells<T>`: accepts a T, answers nothing. `asks<Q, R>`: accepts a Q and answers an R. A handle is a typed reference;
// one with more signatures converts to one with fewer, so hand out narrow handles as capabilities. That the receiver
// accepts a message, that there is one handler for each message and that it fits, is checked at compile time; what
// travels is an untyped envelope, so the check costs nothing and compiles fast. Inside an actor use the members tell,
// ask and tell_after of actor_base; from other threads use a gateway. Thread: handles are values and may be copied to
// any thread.
#pragma once

#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "io/fields/field_table.hpp"
#include "runtime/actor_ref.hpp"

namespace godwit::runtime {

template <class T>
struct message_tag {};

template <io::has_fields T>
struct tells {
  using message = T;
  using answer = void;
  static tells signature_for(message_tag<T>);
};

template <io::has_fields Q, io::has_fields R>
struct asks {
  using message = Q;
  using answer = R;
  static asks signature_for(message_tag<Q>);
};

namespace detail {

// A word that stands twice does not compile.
template <class... Signatures>
struct signature_set : Signatures... {
  using Signatures::signature_for...;
};

} // namespace detail

template <class... Signatures>
class mailbox {
public:
  using signatures = detail::signature_set<Signatures...>;

  mailbox() = default;
  mailbox(std::nullptr_t) {} // nobody NOLINT(google-explicit-constructor)
  // For runtime/, which knows that the actor behind REF has these signatures.
  explicit mailbox(actor_ref ref) : ref_(std::move(ref)) {}

  template <class... Wider>
  requires(!std::same_as<mailbox, mailbox<Wider...>> &&
           (std::is_base_of_v<Signatures, detail::signature_set<Wider...>> && ...))
      mailbox(const mailbox<Wider...>& wider)
      : ref_(wider.ref()) {}

  [[nodiscard]] const actor_ref& ref() const { return ref_; }
  explicit operator bool() const { return static_cast<bool>(ref_); }
  friend bool operator==(const mailbox&, const mailbox&) = default;

private:
  actor_ref ref_;
};

namespace detail {

template <class Mailbox, class... Signatures>
struct with_signatures {
  using type = Mailbox;
};
template <class... Known, class Signature, class... Rest>
struct with_signatures<mailbox<Known...>, Signature, Rest...> {
  using type = typename with_signatures<
      std::conditional_t<(std::same_as<Signature, Known> || ...), mailbox<Known...>, mailbox<Known..., Signature>>,
      Rest...>::type;
};

template <class Mailbox, class... More>
struct combined {
  using type = Mailbox;
};
template <class Mailbox, class... Signatures, class... More>
struct combined<Mailbox, mailbox<Signatures...>, More...> {
  using type = typename combined<typename with_signatures<Mailbox, Signatures...>::type, More...>::type;
};

} // namespace detail

// The mailbox with the signatures of all of MAILBOXES, each once.
template <class... Mailboxes>
using combine = typename detail::combined<mailbox<>, Mailboxes...>::type;

// The receiver behind HANDLE accepts a T, as a tell or as an ask.
template <class Handle, class T>
concept accepts = io::has_fields<T> && requires {
  Handle::signatures::signature_for(message_tag<T>{});
};

// What an ask of Q at HANDLE answers.
template <class Handle, class Q>
using answer_t = typename decltype(Handle::signatures::signature_for(message_tag<Q>{}))::answer;

} // namespace godwit::runtime
