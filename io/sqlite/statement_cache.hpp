// Prepared statements by their text, at most a bounded number of them; the one unused for longest makes room.
//
// A pointer from get is good until the next get. Thread: the one of its database.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>

#include "io/sqlite/database.hpp"

namespace godwit::io::sqlite {

class statement_cache {
public:
  // A component has a handful of statements; 128 leaves room for all of them and still bounds a caller that builds
  // texts.
  static constexpr std::size_t default_max_statements = 128;

  explicit statement_cache(database& db, std::size_t max_statements = default_max_statements)
      : db_(&db), max_statements_(max_statements) {}

  [[nodiscard]] result<statement*> get(std::string_view sql);

  void clear() { entries_.clear(); }

  [[nodiscard]] std::size_t size() const { return entries_.size(); }

private:
  struct entry {
    statement prepared;
    std::uint64_t last_use = 0;
  };
  struct text_hash {
    using is_transparent = void;
    std::size_t operator()(std::string_view text) const { return std::hash<std::string_view>{}(text); }
  };

  void make_room();

  database* db_;
  std::size_t max_statements_;
  std::uint64_t uses_ = 0;
  std::unordered_map<std::string, entry, text_hash, std::equal_to<>> entries_;
};

} // namespace godwit::io::sqlite
