#include "programs/godwitd/service/service_manager.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <utility>

#include <sys/socket.h>
#include <unistd.h>

#include "io/fields/utf8.hpp"
#include "runtime/supervision/messages.hpp"

namespace godwit::daemon {

namespace {

std::optional<std::int64_t> number_in(const char* variable) {
  const char* const text = std::getenv(variable);
  if (text == nullptr)
    return std::nullopt;
  std::int64_t result = 0;
  const auto* const end = text + std::strlen(text);
  const auto read = std::from_chars(text, end, result);
  return read.ec == std::errc{} && read.ptr == end ? std::optional(result) : std::nullopt;
}

std::optional<std::chrono::microseconds> watchdog_in_environment() {
  const auto period = number_in("WATCHDOG_USEC");
  if (!period || *period <= 0)
    return std::nullopt;
  if (std::getenv("WATCHDOG_PID") != nullptr && number_in("WATCHDOG_PID") != ::getpid())
    return std::nullopt; // another process is meant
  return std::chrono::microseconds(*period);
}

} // namespace

tl::expected<service_manager, std::string> service_manager::at(const std::string& socket,
                                                               std::optional<std::chrono::microseconds> watchdog) {
  service_manager result;
  const bool is_abstract = socket.starts_with('@');
  if ((!is_abstract && !socket.starts_with('/')) || socket.size() < 2 || socket.size() >= sizeof(sockaddr_un::sun_path))
    return tl::make_unexpected("NOTIFY_SOCKET is \"" + socket + "\", which is no path and no name with @ of up to " +
                               std::to_string(sizeof(sockaddr_un::sun_path) - 1) +
                               " bytes; the service manager is not notified");
  result.address_.sun_family = AF_UNIX;
  std::memcpy(&result.address_.sun_path[0], socket.data(), socket.size());
  if (is_abstract)
    result.address_.sun_path[0] = '\0';
  result.address_size_ =
      static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + socket.size() + (is_abstract ? 0 : 1));
  result.socket_ = io::link::descriptor(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!result.socket_.is_open())
    return tl::make_unexpected(std::string("no socket for the service manager: ") + std::strerror(errno));
  result.watchdog_ = watchdog;
  return result;
}

tl::expected<service_manager, std::string> service_manager::from_environment() {
  const char* const socket = std::getenv("NOTIFY_SOCKET");
  return socket == nullptr ? service_manager() : at(socket, watchdog_in_environment());
}

void service_manager::tell_status(std::string_view sentence) const {
  // Half a character of UTF-8 would cost the whole line.
  std::string line = "STATUS=" + std::string(sentence.substr(0, io::whole_characters(sentence, max_status)));
  for (char& each : line)
    if (each == '\n')
      each = ' ';
  send(line);
}

void service_manager::tell_reloading() const {
  const auto now = std::chrono::steady_clock::now().time_since_epoch(); // CLOCK_MONOTONIC, as it is asked for
  send("RELOADING=1\nMONOTONIC_USEC=" +
       std::to_string(std::chrono::duration_cast<std::chrono::microseconds>(now).count()));
}

void service_manager::send(std::string_view lines) const {
  if (socket_.is_open())
    (void)::sendto(socket_.number(), lines.data(), lines.size(), MSG_NOSIGNAL,
                   reinterpret_cast<const sockaddr*>(&address_), address_size_);
}

watchdog_notifier::watchdog_notifier(const service_manager& manager, pulse_view view, std::string about)
    : manager_(manager), view_(std::move(view)), about_(std::move(about)) {}

void watchdog_notifier::end() {
  {
    const std::lock_guard guard(mutex_);
    is_over_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable())
    thread_.join();
}

void watchdog_notifier::start() {
  thread_ = std::thread([this] { run(); });
}

std::chrono::microseconds watchdog_notifier::period() const {
  const std::chrono::microseconds longest = max_period;
  return manager_.watchdog() ? std::min(longest, *manager_.watchdog() / 2) : longest;
}

void watchdog_notifier::run() {
  std::unique_lock guard(mutex_);
  while (!is_over_) {
    guard.unlock();
    beat();
    guard.lock();
    changed_.wait_for(guard, is_ready_ ? period() : std::min<std::chrono::microseconds>(period(), until_ready),
                      [this] { return is_over_; });
  }
}

void watchdog_notifier::beat() {
  const std::lock_guard guard(mutex_);
  if (!is_ready_ && view_.has_begun()) {
    is_ready_ = true;
    manager_.tell_ready();
  }
  tell_health();
  if (view_.is_responsive())
    manager_.tell_alive();
}

void watchdog_notifier::tell_health() {
  auto now = view_.health();
  for (const auto& each : health_changes(last_, now))
    view_.tell(each);
  auto status = about_ + health_in_a_line(now);
  if (is_ready_ && status != last_status_) {
    manager_.tell_status(status);
    last_status_ = std::move(status);
  }
  last_ = std::move(now);
}

void watchdog_notifier::around_reload(const std::function<void()>& reload) {
  const std::lock_guard guard(mutex_);
  const bool is_told = is_ready_ && !is_over_;
  if (is_told)
    manager_.tell_reloading();
  reload();
  if (is_told)
    manager_.tell_ready();
}

namespace {

using runtime::health_colour;
using runtime::health_entry;

std::string because(const std::string& reason) { return reason.empty() ? "" : ": " + reason; }

// A reason with another number in it is no news.
std::string without_numbers(std::string reason) {
  std::erase_if(reason, [](char each) { return each >= '0' && each <= '9'; });
  return reason;
}

} // namespace

std::string health_in_a_line(const std::vector<health_entry>& now) {
  const auto ill = std::ranges::count_if(now, [](const auto& each) { return each.colour != health_colour::green; });
  if (ill == 0)
    return "all is well";
  const auto& worst = *std::ranges::max_element(now, {}, &health_entry::colour);
  return std::string(io::name_of(worst.colour)) + ": " + worst.component + because(worst.reason) +
         (ill > 1 ? "; and " + std::to_string(ill - 1) + " more" : "");
}

std::vector<health_change> health_changes(const std::vector<health_entry>& before,
                                          const std::vector<health_entry>& now) {
  std::vector<health_change> result;
  for (const auto& each : now) {
    const auto known = std::ranges::find(before, each.component, &health_entry::component);
    const auto was = known == before.end() ? health_colour::green : known->colour;
    const bool has_other_reason =
        known != before.end() && without_numbers(known->reason) != without_numbers(each.reason);
    if (each.colour == was && (each.colour == health_colour::green || !has_other_reason))
      continue;
    result.push_back({each.component, each.colour,
                      each.colour == health_colour::green
                          ? each.component + " is well again"
                          : each.component + " is " + std::string(io::name_of(each.colour)) + because(each.reason)});
  }
  return result;
}

} // namespace godwit::daemon
