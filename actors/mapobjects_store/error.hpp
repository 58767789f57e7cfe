// What can go wrong with the map, as a value for the caller and a sentence for people. Thread: plain value.
#pragma once

#include <string>

#include <tl/expected.hpp>

#include "io/sqlite/store_error.hpp"

namespace godwit::mapobjects_store {

enum class map_errc {
  refused,       // what was asked for makes no sense; asking again does not help
  load_given_up, // this load is not under way (any more)
  delivered,     // the batch of this key was delivered before
  full,          // a bound is reached; nothing was done
  closed,        // the store is shutting down
  locked,        // another process writes this map
  missing,       // asked to open an existing map, there is none
  foreign,       // the file is something else than a godwit map
  newer,         // written by a later version of godwit
  corrupt,       // the file is damaged
  disk,          // the disk refuses for now: full, read-only, an I/O error; trying again may help
  internal,      // a mistake of this program
};

struct map_error {
  map_errc code{};
  std::string what;   // what is wrong, with the file and the detail where there is one
  std::string remedy; // what a person can do about it; empty where it is obvious

  [[nodiscard]] std::string message() const;
};

// The map says no, and is as it was.
[[nodiscard]] bool is_refusal(map_errc code);

template <class T>
using map_result = tl::expected<T, map_error>;

[[nodiscard]] inline tl::unexpected<map_error> refused(std::string why) {
  return tl::unexpected(map_error{map_errc::refused, std::move(why), {}});
}

// Errors of the file in the map's words. Thread: any.

[[nodiscard]] map_error from_store(const io::sqlite::store_error& error);

// DOING completes the sentence "... while DOING".
[[nodiscard]] map_error from_sqlite(const io::sqlite::error& error, const std::string& doing);

} // namespace godwit::mapobjects_store
