// How long the next try to log in has to wait, after tries that failed.
//
//   failures in a row:  1      2      3     4    5    6 and more
//   wait:               0.25   0.5    1     2    4    8 s
//
// They are counted for each address, and for each name at an address: who guesses from elsewhere delays nobody, and
// nobody is ever locked out. Forgotten after a success, and after ten minutes without a failure. Pure: time comes in,
// as monotonic milliseconds. Thread: one owner.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace godwit::accounts {

class login_delay {
public:
  static constexpr std::int64_t first_ms = 250;
  static constexpr std::int64_t longest_ms = 8'000;
  static constexpr std::int64_t forgotten_after_ms = 600'000;
  static constexpr std::size_t max_entries = 512; // the oldest is forgotten

  // When a try may be judged: NOW_MS or later.
  [[nodiscard]] std::int64_t due_ms(const std::string& name, const std::string& from, std::int64_t now_ms) const;
  void failed(const std::string& name, const std::string& from, std::int64_t now_ms);
  void succeeded(const std::string& name, const std::string& from);

private:
  struct entry {
    int failures = 0;
    std::int64_t last_ms = 0;
  };
  using key = std::pair<std::string, std::string>; // address, name; without one: of all names

  [[nodiscard]] std::int64_t due_of(const key& which, std::int64_t now_ms) const;
  void count(const key& which, std::int64_t now_ms);

  std::map<key, entry> entries_;
};

} // namespace godwit::accounts
