#include "actors/domain/confirmation/confirmation_table.hpp"

#include <algorithm>

namespace godwit::domain {

confirmation_table::sender& confirmation_table::find(std::uint64_t who) {
  const auto known = std::ranges::find(senders_, who, &sender::who);
  if (known != senders_.end())
    return *known;
  if (senders_.size() == max_senders)
    senders_.erase(std::ranges::min_element(senders_, {}, [](const sender& each) { return each.heard_ns.back(); }));
  return senders_.emplace_back(sender{who, {}});
}

bool confirmation_table::note(std::uint64_t who, int needed, std::int64_t now_ns) {
  auto& heard = find(who).heard_ns;
  heard.push_back(now_ns);
  while (now_ns - heard.front() > window_ns)
    heard.pop_front();
  while (heard.size() > static_cast<std::size_t>(needed))
    heard.pop_front();
  return heard.size() >= static_cast<std::size_t>(needed);
}

} // namespace godwit::domain
