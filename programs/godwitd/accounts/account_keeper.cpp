#include "programs/godwitd/accounts/account_keeper.hpp"

#include <algorithm>
#include <utility>

#include "io/http/server/client_share.hpp"
#include "programs/godwitd/accounts/password.hpp"

namespace godwit::accounts {

tl::expected<std::unique_ptr<account_keeper>, std::string> account_keeper::open(std::string file) {
  const auto stamp = stamp_of(file);
  auto all = load(file);
  if (!all)
    return tl::make_unexpected(std::move(all.error()));
  return std::unique_ptr<account_keeper>(new account_keeper(std::move(file), *std::move(all), stamp));
}

account_keeper::account_keeper(std::string file, account_list all, file_stamp stamp)
    : file_(std::move(file)), accounts_(std::move(all)), stamp_(stamp) {
  nobodys_.salt = random_hex(16);
  nobodys_.hash = random_hex(32);
}

account_keeper::~account_keeper() {
  {
    const std::lock_guard guard(mutex_);
    stops_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable())
    thread_.join();
}

void account_keeper::start(told tell, said say) {
  tell_ = std::move(tell);
  say_ = std::move(say);
  thread_ = std::thread([this] { run(); });
}

bool account_keeper::has_accounts() const {
  const std::lock_guard guard(mutex_);
  return !accounts_.empty();
}

bool account_keeper::check(attempt what, answered then) {
  what.from = io::http::share_of(what.from);
  const bool is_here = what.from == "127.0.0.1" || what.from == "::1";
  const auto most = is_here ? max_waiting : max_waiting - max_waiting_of_one;
  std::unique_lock lock(mutex_);
  if (count_of(what.from) >= max_waiting_of_one)
    return false;
  std::optional<waiting> displaced;
  if (waiting_.size() >= most) {
    displaced = displaced_by(what.from);
    if (!displaced)
      return false;
  }
  const auto now = now_ms();
  const auto due = clock::time_point(std::chrono::milliseconds(delay_.due_ms(what.name, what.from, now)));
  waiting_.push_back({std::move(what), std::move(then), due});
  changed_.notify_all();
  lock.unlock();
  if (displaced)
    displaced->then(tl::make_unexpected(refusal::gave_way));
  return true;
}

std::size_t account_keeper::count_of(const std::string& from) const {
  return static_cast<std::size_t>(
      std::ranges::count_if(waiting_, [&](const auto& each) { return each.what.from == from; }));
}

// The newest of the address with the most, if that has more than FROM will have.
std::optional<account_keeper::waiting> account_keeper::displaced_by(const std::string& from) {
  auto leaves = waiting_.end();
  auto most = count_of(from) + 1;
  for (auto each = waiting_.begin(); each != waiting_.end(); ++each)
    if (const auto its = count_of(each->what.from); its > most || (leaves != waiting_.end() && its == most)) {
      leaves = each;
      most = its;
    }
  if (leaves == waiting_.end())
    return std::nullopt;
  std::optional<waiting> result(std::move(*leaves));
  waiting_.erase(leaves);
  return result;
}

account_keeper::file_stamp account_keeper::stamp_of(const std::string& file) {
  struct stat found {};
  if (::lstat(file.c_str(), &found) != 0)
    return {};
  return {found.st_ino, found.st_mtim.tv_sec * 1'000'000'000LL + found.st_mtim.tv_nsec};
}

std::int64_t account_keeper::now_ms() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(clock::now().time_since_epoch()).count();
}

void account_keeper::run() {
  tell_(described(accounts_));
  std::unique_lock lock(mutex_);
  auto looks = clock::now() + look_each;
  while (!stops_) {
    const auto now = clock::now();
    const auto next = std::ranges::min_element(waiting_, {}, &waiting::due);
    if (next != waiting_.end() && next->due <= now) {
      auto one = std::move(*next);
      waiting_.erase(next);
      lock.unlock();
      look_at_file();
      judge(std::move(one));
      lock.lock();
      continue;
    }
    if (now >= looks) {
      lock.unlock();
      look_at_file();
      lock.lock();
      looks = now + look_each;
      continue;
    }
    changed_.wait_until(lock, next == waiting_.end() ? looks : std::min(looks, next->due));
  }
}

void account_keeper::look_at_file() {
  const auto stamp = stamp_of(file_);
  if (stamp == std::exchange(stamp_, stamp))
    return;
  auto all = load(file_);
  if (!all)
    return say_(all.error() + "; the accounts stay as they were");
  {
    const std::lock_guard guard(mutex_);
    accounts_ = *all;
  }
  tell_(described(*all));
}

void account_keeper::judge(waiting one) {
  std::optional<stored_account> account;
  {
    const std::lock_guard guard(mutex_);
    if (const auto found = std::ranges::find(accounts_, one.what.name, &stored_account::name); found != accounts_.end())
      account = *found;
  }
  const bool is_right = is_password(one.what.password.revealed(), account ? account->password : nobodys_) && account;
  {
    const std::lock_guard guard(mutex_);
    if (is_right)
      delay_.succeeded(one.what.name, one.what.from);
    else
      delay_.failed(one.what.name, one.what.from, now_ms());
    // What waits has to wait as long as this failure says.
    for (auto& each : waiting_)
      each.due = std::max(each.due, clock::time_point(std::chrono::milliseconds(
                                        delay_.due_ms(each.what.name, each.what.from, now_ms()))));
  }
  one.then(is_right ? verdict(described(*account)) : tl::make_unexpected(refusal::wrong));
}

namespace {

constexpr int most_doublings = 5;

std::int64_t wait_ms(int failures) {
  return std::min(login_delay::first_ms << std::min(failures - 1, most_doublings), login_delay::longest_ms);
}

} // namespace

std::int64_t login_delay::due_of(const key& which, std::int64_t now_ms) const {
  const auto found = entries_.find(which);
  if (found == entries_.end() || now_ms - found->second.last_ms >= forgotten_after_ms)
    return now_ms;
  return std::max(now_ms, found->second.last_ms + wait_ms(found->second.failures));
}

std::int64_t login_delay::due_ms(const std::string& name, const std::string& from, std::int64_t now_ms) const {
  return std::max(due_of({from, name}, now_ms), due_of({from, {}}, now_ms));
}

void login_delay::count(const key& which, std::int64_t now_ms) {
  if (!entries_.contains(which) && entries_.size() >= max_entries)
    entries_.erase(std::ranges::min_element(entries_, {}, [](const auto& each) { return each.second.last_ms; }));
  auto& its = entries_[which];
  its.failures = now_ms - its.last_ms >= forgotten_after_ms ? 1 : its.failures + 1;
  its.last_ms = now_ms;
}

void login_delay::failed(const std::string& name, const std::string& from, std::int64_t now_ms) {
  count({from, name}, now_ms);
  count({from, {}}, now_ms);
}

void login_delay::succeeded(const std::string& name, const std::string& from) {
  entries_.erase({from, name});
  entries_.erase({from, {}});
}

} // namespace godwit::accounts
