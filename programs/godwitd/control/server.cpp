#include "programs/godwitd/control/server.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "programs/common/control_client.hpp"
#include "programs/godwitd/control/request_line.hpp"

namespace godwit::control {

using io::link::descriptor;

namespace {

constexpr int max_waiting_connections = 8;
constexpr std::chrono::seconds without_descriptors{1}; // until somebody is let in again

descriptor new_socket() { return descriptor(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)); }

const sockaddr* as_sockaddr(const sockaddr_un& address) { return reinterpret_cast<const sockaddr*>(&address); }

// A file is in the way: a socket on which nobody listens is what a killed process left. Only a refusal says that nobody
// does; one who is stopped or busy lets wait.
tl::expected<void, std::string> clear_the_way(const std::string& path, const sockaddr_un& address) {
  struct stat there {};
  if (::lstat(path.c_str(), &there) != 0)
    return {};
  if (!S_ISSOCK(there.st_mode))
    return tl::make_unexpected(path + " is there and is no socket: name another place with --control");
  const auto probe = new_socket();
  if (::connect(probe.number(), as_sockaddr(address), sizeof address) == 0 || errno == EAGAIN)
    return tl::make_unexpected(path + ": another godwitd listens there; end it, or name another place with --control");
  if (errno != ECONNREFUSED)
    return tl::make_unexpected(path + ": whether a godwitd listens there is not known: " + std::strerror(errno) +
                               "; name another place with --control");
  if (::unlink(path.c_str()) != 0)
    return tl::make_unexpected(path + ", which an earlier godwitd left, can not be removed: " + std::strerror(errno));
  return {};
}

tl::expected<descriptor, std::string> listen_at(const std::string& path) {
  const auto address = unix_address(path);
  if (!address)
    return tl::make_unexpected(address.error());
  if (auto clear = clear_the_way(path, *address); !clear)
    return tl::make_unexpected(std::move(clear.error()));
  auto result = new_socket();
  // The mode is there before the name is: nobody else can connect in between.
  if (!result.is_open() || ::fchmod(result.number(), S_IRUSR | S_IWUSR) != 0 ||
      ::bind(result.number(), as_sockaddr(*address), sizeof *address) != 0 ||
      ::chmod(path.c_str(), S_IRUSR | S_IWUSR) != 0 || ::listen(result.number(), max_waiting_connections) != 0)
    return tl::make_unexpected("the control socket " + path + " can not be opened: " + std::strerror(errno) +
                               "; name another place with --control");
  return result;
}

file_identity identity_of(const std::string& path) {
  struct stat there {};
  return ::lstat(path.c_str(), &there) == 0 ? file_identity{there.st_dev, there.st_ino} : file_identity{};
}

} // namespace

tl::expected<std::unique_ptr<server>, std::string>
server::open(const std::string& path, std::shared_ptr<response_queue> answers, asker ask, server_limits limits) {
  auto listening = listen_at(path);
  if (!listening)
    return tl::make_unexpected(std::move(listening.error()));
  descriptor stop(::eventfd(0, EFD_CLOEXEC));
  if (!stop.is_open())
    return tl::make_unexpected(std::string("no descriptor is left for the control socket: ") + std::strerror(errno));
  return std::unique_ptr<server>(
      new server(path, *std::move(listening), std::move(stop), std::move(answers), std::move(ask), limits));
}

server::server(std::string path, descriptor listening, descriptor stop, std::shared_ptr<response_queue> answers,
               asker ask, server_limits limits)
    : path_(std::move(path)), file_(identity_of(path_)), listening_(std::move(listening)), stop_(std::move(stop)),
      answers_(std::move(answers)), ask_(std::move(ask)), limits_(limits), thread_([this] { run(); }) {}

server::~server() {
  const std::uint64_t one = 1;
  (void)!::write(stop_.number(), &one, sizeof one);
  thread_.join();
  if (identity_of(path_) == file_) // another's socket may have come into its place
    ::unlink(path_.c_str());
}

void server::run() {
  for (;;) {
    const bool lets_in = clock::now() >= lets_in_again_;
    std::vector<pollfd> watched{{stop_.number(), POLLIN, 0},
                                {answers_->descriptor(), POLLIN, 0},
                                {listening_.number(), static_cast<short>(lets_in ? POLLIN : 0), 0}};
    for (const auto& each : clients_)
      watched.push_back(
          {each.socket.number(),
           static_cast<short>((each.ticket == 0 && !each.is_leaving ? POLLIN : 0) | (each.out.empty() ? 0 : POLLOUT)),
           0});
    (void)::poll(watched.data(), watched.size(), wait_ms()); // interrupted: everything is looked at again
    if (watched[0].revents != 0)
      return;
    if (watched[1].revents != 0)
      hand_out_answers();
    auto seen = watched.begin() + 3;
    for (auto each = clients_.begin(); each != clients_.end(); ++seen) {
      const bool stays = ((seen->revents & (POLLIN | POLLHUP | POLLERR)) == 0 || read_from(*each)) &&
                         (each->out.empty() || write_to(*each)) && look_at_time(*each) && !has_to_go(*each);
      each = stays ? std::next(each) : clients_.erase(each);
    }
    if (watched[2].revents != 0)
      accept_one();
  }
}

int server::wait_ms() const {
  auto first = clock::now() < lets_in_again_ ? lets_in_again_ : clock::time_point::max();
  for (const auto& each : clients_)
    first = std::min(first, each.deadline);
  if (first == clock::time_point::max())
    return -1;
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(first - clock::now());
  return static_cast<int>(std::max<std::int64_t>(left.count(), 0));
}

void server::accept_one() {
  descriptor socket(::accept4(listening_.number(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!socket.is_open()) {
    // Who waits stays in the queue; to look at once again would never end.
    if (errno != EAGAIN && errno != EINTR && errno != ECONNABORTED)
      lets_in_again_ = clock::now() + without_descriptors;
    return;
  }
  clients_.push_back({std::move(socket), {}, {}, 0, clock::now() + limits_.idle_timeout, false});
  if (clients_.size() > limits_.max_clients)
    turn_away(clients_.back(), "too many talk to this godwitd already; try again later");
}

bool server::read_from(client& who) {
  std::array<char, 4096> piece{};
  const auto count = ::read(who.socket.number(), piece.data(), piece.size());
  if (count < 0)
    return errno == EINTR || errno == EAGAIN;
  if (count == 0)
    return false;
  if (who.is_leaving)
    return true;
  who.in.append(piece.data(), static_cast<std::size_t>(count));
  next_request(who);
  return true;
}

void server::next_request(client& who) {
  while (who.ticket == 0 && !who.is_leaving) {
    const auto end = who.in.find('\n');
    if (end == std::string::npos && who.in.size() <= limits_.max_line_bytes)
      return;
    if (end == std::string::npos || end > limits_.max_line_bytes) {
      turn_away(who, "a request is at most " + std::to_string(limits_.max_line_bytes) + " bytes long");
      return;
    }
    auto asked = read_request(std::string_view(who.in).substr(0, end));
    who.in.erase(0, end + 1);
    if (!asked) {
      say(who, refusal_line(asked.error()));
      continue;
    }
    who.ticket = asked->ticket = ++last_ticket_;
    who.deadline = clock::now() + limits_.answer_timeout;
    ask_(*std::move(asked));
  }
}

void server::hand_out_answers() {
  for (auto& each : answers_->take()) {
    const auto who = std::ranges::find(clients_, each.ticket, &client::ticket);
    if (who == clients_.end() || each.ticket == 0) // it has left, or its time was over
      continue;
    who->ticket = 0;
    say(*who, std::move(each.line));
    next_request(*who);
  }
}

void server::say(client& who, std::string line) {
  who.out += std::move(line) + '\n';
  who.deadline = clock::now() + limits_.idle_timeout;
}

void server::turn_away(client& who, const std::string& why) {
  say(who, refusal_line(why));
  who.is_leaving = true;
}

bool server::write_to(client& who) {
  const auto count = ::send(who.socket.number(), who.out.data(), who.out.size(), MSG_NOSIGNAL);
  if (count < 0)
    return errno == EINTR || errno == EAGAIN;
  who.out.erase(0, static_cast<std::size_t>(count));
  return true;
}

bool server::look_at_time(client& who) {
  if (clock::now() < who.deadline)
    return true;
  if (who.ticket == 0)
    return false;
  who.ticket = 0;
  say(who, refusal_line("there is no answer within " + std::to_string(limits_.answer_timeout.count()) +
                        " ms; ask again, or look into the trace"));
  next_request(who);
  return true;
}

bool server::has_to_go(const client& who) const {
  return who.out.size() > limits_.max_unread_bytes || (who.is_leaving && who.out.empty());
}

} // namespace godwit::control
