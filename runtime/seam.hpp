// The few words in which actors are written, in place of CAF's: a move to another version of CAF touches this folder
// only.
//
//   using handle = runtime::mailbox<runtime::tells<moved>, runtime::asks<get_total, total>>;
//
// `tells<T>`: accepts a T, answers nothing. `asks<Q, R>`: accepts a Q and answers an R. A handle is a typed reference;
// one with more words converts to one with fewer, so hand out narrow handles as capabilities. That the receiver accepts
// a message, and that a handler fits it, is checked at compile time. Inside an actor use the members tell, ask and
// tell_after of cell; from other threads use a gateway. Thread: handles are values and may be copied to any thread.
#pragma once

#include <caf/all.hpp>

#include "runtime/mail.hpp"

namespace godwit::runtime {

template <io::has_fields T>
struct tells {
  using signature = caf::reacts_to<mail<T>>;
};

template <io::has_fields Q, io::has_fields R>
struct asks {
  using signature = typename caf::replies_to<mail<Q>>::template with<mail<R>>;
};

template <class... Words>
using mailbox = caf::typed_actor<typename Words::signature...>;

// What the scheduler hands to the constructor of an incarnation; passed on to cell and not looked at.
using actor_config = caf::actor_config;

namespace detail {

template <class Handle, class T>
struct answer_of {
  using list = typename caf::response_type_unbox<caf::signatures_of_t<Handle>, caf::detail::type_list<mail<T>>>;
  static constexpr bool accepted = list::valid;
};

template <class List>
struct unwrap_answer;
template <class R>
struct unwrap_answer<caf::detail::type_list<mail<R>>> {
  using type = R;
};

} // namespace detail

// The receiver behind HANDLE accepts a T, as a tell or as an ask.
template <class Handle, class T>
concept accepts = io::has_fields<T> && detail::answer_of<Handle, T>::accepted;

// What an ask of Q at HANDLE answers.
template <class Handle, class Q>
using answer_t = typename detail::unwrap_answer<caf::response_type_t<typename Handle::signatures, mail<Q>>>::type;

} // namespace godwit::runtime
