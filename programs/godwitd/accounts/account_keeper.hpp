// Judges passwords against the file of accounts, one at a time, and says when the file has changed.
//
//   HTTP ──check()──> tries that wait (login_delay) ──> scrypt, one at a time ──> ANSWER
//   file ──each 0.5 s──> changed? ──> TOLD
//
// A name that is not there takes as long as one that is. Where the file can not be read any more, the accounts stay as
// they were, and SAID gets a sentence. Errors: open, as a sentence. Thread: one of its own, in which all callbacks
// come; check by any.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include <sys/stat.h>
#include <tl/expected.hpp>

#include "io/http/secret_file.hpp"
#include "programs/godwitd/accounts/account_file.hpp"

namespace godwit::accounts {

// How long the next try to log in has to wait, after tries that failed.
//
//   failures in a row:  1      2      3     4    5    6 and more
//   wait:               0.25   0.5    1     2    4    8 s
//
// They are counted for each address, and for each name at an address: who guesses from elsewhere delays nobody, and
// nobody is ever locked out. Forgotten after a success, and after ten minutes without a failure. Pure: time comes in,
// as monotonic milliseconds. Thread: one owner.
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

class account_keeper {
public:
  static constexpr std::chrono::milliseconds look_each{500};
  // The last four are for this computer. When the others are taken, the address with the most gives one to another.
  static constexpr std::size_t max_waiting = 32;
  static constexpr std::size_t max_waiting_of_one = 4; // from one address, or one IPv6 network of 64 bits

  struct attempt {
    std::string name;
    io::http::secret_text password;
    std::string from; // an address
  };
  enum class refusal {
    wrong,   // the name or the password
    gave_way // too many wait, and most of them come from its address
  };
  using verdict = tl::expected<operator_bridge::account, refusal>;
  using answered = std::function<void(verdict who)>;
  using told = std::function<void(const operator_bridge::accounts_read& all)>;
  using said = std::function<void(const std::string& sentence)>;

  // The file can be read now, or is not there.
  [[nodiscard]] static tl::expected<std::unique_ptr<account_keeper>, std::string> open(std::string file);
  ~account_keeper();
  account_keeper(const account_keeper&) = delete;
  account_keeper& operator=(const account_keeper&) = delete;

  // TELL is called at once, and at each change.
  void start(told tell, said say);
  // False: too many wait; nothing is called. Who gives way is told so by the caller.
  [[nodiscard]] bool check(attempt what, answered then);
  [[nodiscard]] bool has_accounts() const;

private:
  using clock = std::chrono::steady_clock;
  struct waiting {
    attempt what;
    answered then;
    clock::time_point due;
  };
  struct file_stamp {
    ino_t number = 0;
    std::int64_t changed_ns = 0;
    bool operator==(const file_stamp&) const = default;
  };

  account_keeper(std::string file, account_list all, file_stamp stamp);
  [[nodiscard]] static file_stamp stamp_of(const std::string& file);
  [[nodiscard]] static std::int64_t now_ms();

  [[nodiscard]] std::size_t count_of(const std::string& from) const; // that wait
  [[nodiscard]] std::optional<waiting> displaced_by(const std::string& from);
  void run();
  void look_at_file();
  void judge(waiting one);

  const std::string file_;
  password_hash nobodys_; // takes the time for who is not there
  told tell_;
  said say_;
  mutable std::mutex mutex_; // of what stands below, down to stops_
  std::condition_variable changed_;
  account_list accounts_;
  std::list<waiting> waiting_;
  login_delay delay_;
  bool stops_ = false;
  file_stamp stamp_; // of the thread
  std::thread thread_;
};

} // namespace godwit::accounts
