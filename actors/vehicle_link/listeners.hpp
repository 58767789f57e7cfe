// Who hears what the vehicle says.
//
//   auto ears = std::make_shared<listeners>();
//   ears->add(executor_handle);   // for every message of `told_messages`, and every announcement, that it accepts
//
// Filled in while the process is composed, when the addresses of all actors exist, and not changed after the actors
// were started. A listener names what it wants by the signatures of its mailbox:
// runtime::tells<mavlink::mission_current>, runtime::tells<connection_changed>, ... Thread: composed by one thread,
// then read only.
#pragma once

#include <tuple>
#include <vector>

#include "actors/vehicle_link/effects.hpp"
#include "runtime/seam.hpp"

namespace godwit::vehicle_link {

class listeners {
public:
  // Handle is any mailbox; what it does not accept it does not hear.
  template <class Handle>
  void add(const Handle& who) {
    std::apply([&](auto&... each) { (add_to(each, who), ...); }, lists_);
  }

  // Calls TELL(handle) for each that accepts M.
  template <class M, class Tell>
  void for_each(Tell tell) const {
    for (const auto& each : std::get<list<M>>(lists_).handles)
      tell(each);
  }

private:
  template <class M>
  struct list {
    using handle_type = runtime::mailbox<runtime::tells<M>>;
    std::vector<handle_type> handles;
  };

  template <class M, class Handle>
  static void add_to(list<M>& to, const Handle& who) {
    if constexpr (runtime::accepts<Handle, M>)
      to.handles.push_back(typename list<M>::handle_type(who));
  }

  template <class Variant>
  struct lists_of;
  template <class... Ms>
  struct lists_of<std::variant<Ms...>> {
    using type = std::tuple<list<Ms>...>;
  };
  using all_lists = decltype(std::tuple_cat(std::declval<lists_of<observation>::type>(),
                                            std::declval<lists_of<announcement>::type>()));
  all_lists lists_;
};

} // namespace godwit::vehicle_link
