#include "io/sqlite/statement_cache.hpp"

#include <algorithm>

namespace godwit::io::sqlite {

result<statement*> statement_cache::get(std::string_view sql) {
  auto found = entries_.find(sql);
  if (found == entries_.end()) {
    auto prepared = db_->prepare(std::string(sql));
    if (!prepared)
      return tl::unexpected(std::move(prepared.error()));
    if (entries_.size() >= max_statements_)
      make_room();
    found = entries_.emplace(std::string(sql), entry{std::move(*prepared), 0}).first;
  }
  found->second.last_use = ++uses_;
  return &found->second.prepared;
}

void statement_cache::make_room() {
  const auto older = [](const auto& a, const auto& b) { return a.second.last_use < b.second.last_use; };
  entries_.erase(std::min_element(entries_.begin(), entries_.end(), older));
}

} // namespace godwit::io::sqlite
