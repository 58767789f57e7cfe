#include "io/eyes/helper.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/eventfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/eyes/channel.hpp"

namespace godwit::io::eyes {
namespace {

constexpr int socket_number = 3; // in the helper
constexpr int slot_number = 4;
constexpr int above_all = 16;   // so that none of ours is one of these
constexpr int reap_looks = 200; // 2 s: a process in a driver's call may not die before that returns
constexpr auto reap_period = std::chrono::milliseconds(10);

struct running {
  std::uint32_t run = 0;
  pid_t process = 0;
};

tl::expected<pid_t, std::string> spawn(const std::vector<std::string>& command, int socket, int slot) {
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawnattr_init(&attributes);
  ::posix_spawn_file_actions_adddup2(&actions, socket, socket_number);
  ::posix_spawn_file_actions_adddup2(&actions, slot, slot_number);
  sigset_t none;
  sigset_t all;
  ::sigemptyset(&none);
  ::sigfillset(&all);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setsigdefault(&attributes, &all);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  std::vector<std::string> texts = command;
  std::vector<char*> arguments;
  for (auto& each : texts)
    arguments.push_back(each.data());
  arguments.push_back(nullptr);
  pid_t process = 0;
  const int failed = ::posix_spawn(&process, texts.front().c_str(), &actions, &attributes, arguments.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failed != 0)
    return tl::make_unexpected(command.front() + " can not be started: " + std::strerror(failed));
  return process;
}

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status))
    return "it was ended by signal " + std::to_string(WTERMSIG(status));
  return "it ended with code " + std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : -1);
}

} // namespace

struct helper::parts {
  parts(std::vector<std::string> what, picture_slot memory, link::descriptor event)
      : command(std::move(what)), slot(std::move(memory)), woken(std::move(event)) {}

  void wake() const {
    const std::uint64_t one = 1;
    static_cast<void>(!::write(woken.number(), &one, sizeof one));
  }
  void run();
  bool obey(); // false: all is over
  void launch(std::uint32_t number, const begin& wanted);
  void read_all();
  void stop(const std::string& why); // empty: it was told to, and nobody hears of it
  std::optional<int> reap(pid_t process) const;

  const std::vector<std::string> command;
  picture_slot slot;
  link::descriptor woken;
  helper_listener listener;

  std::mutex mutex;
  std::optional<std::pair<std::uint32_t, begin>> to_start;
  std::uint32_t end_upto = 0; // 0: nothing is to end
  bool is_over = false;
  std::shared_ptr<channel> way; // to what runs

  // Of the thread.
  std::optional<running> now;
  std::thread thread;
};

void helper::parts::run() {
  for (;;) {
    std::array<pollfd, 2> watched{pollfd{woken.number(), POLLIN, 0}, pollfd{-1, POLLIN, 0}};
    if (now)
      watched[1].fd = way->number(); // only this thread replaces it
    static_cast<void>(::poll(watched.data(), watched.size(), -1));
    if (watched[0].revents != 0) {
      std::uint64_t count = 0;
      static_cast<void>(!::read(woken.number(), &count, sizeof count));
      if (!obey())
        return;
    } else if (now && watched[1].revents != 0) {
      read_all();
    }
  }
}

bool helper::parts::obey() {
  std::optional<std::pair<std::uint32_t, begin>> next;
  bool goes_on = true;
  bool ends = false;
  {
    const std::lock_guard guard(mutex);
    next = std::exchange(to_start, std::nullopt);
    const auto upto = std::exchange(end_upto, 0);
    goes_on = !is_over;
    ends = next || is_over || (now && now->run <= upto);
  }
  if (ends)
    stop({});
  if (next && goes_on)
    launch(next->first, next->second);
  return goes_on;
}

void helper::parts::launch(std::uint32_t number, const begin& wanted) {
  auto pair = make_channel_pair();
  if (!pair)
    return listener.on_end(number, std::move(pair.error()));
  const link::descriptor socket(::fcntl(pair->second.number(), F_DUPFD_CLOEXEC, above_all));
  const link::descriptor memory(::fcntl(slot.number(), F_DUPFD_CLOEXEC, above_all));
  if (!socket.is_open() || !memory.is_open())
    return listener.on_end(number, std::string("no descriptor is left: ") + std::strerror(errno));
  const auto process = spawn(command, socket.number(), memory.number());
  if (!process)
    return listener.on_end(number, process.error());
  now = running{number, *process};
  static_cast<void>(pair->first.send(wanted));
  const std::lock_guard guard(mutex);
  way = std::make_shared<channel>(std::move(pair->first));
}

void helper::parts::read_all() {
  for (;;) {
    auto read = way->receive();
    if (!read)
      return stop("what it sends can not be read: " + read.error().what);
    if (read->is_closed)
      return stop("it has gone");
    if (!read->said)
      return;
    listener.on_message(now->run, *std::move(read->said));
  }
}

// Who says nothing more is killed, too: the socket is all that it is good for.
void helper::parts::stop(const std::string& why) {
  if (!now)
    return;
  const auto ended = *std::exchange(now, std::nullopt);
  {
    const std::lock_guard guard(mutex);
    way.reset();
  }
  int code = 0;
  std::optional<int> status;
  if (::waitpid(ended.process, &code, WNOHANG) == ended.process) {
    status = code; // its number may be somebody else's now
  } else {
    ::kill(ended.process, SIGKILL);
    status = reap(ended.process);
  }
  if (why.empty())
    return;
  listener.on_end(ended.run, why + (status ? ": " + how_it_ended(*status) : ", and it does not die"));
}

std::optional<int> helper::parts::reap(pid_t process) const {
  for (int looks = 0; looks < reap_looks; ++looks) {
    int status = 0;
    if (::waitpid(process, &status, WNOHANG) == process)
      return status;
    std::this_thread::sleep_for(reap_period);
  }
  return std::nullopt;
}

helper::helper(std::unique_ptr<parts> made) : parts_(std::move(made)) {}

tl::expected<std::shared_ptr<helper>, std::string> helper::make(std::vector<std::string> command) {
  auto slot = picture_slot::make();
  if (!slot)
    return tl::make_unexpected(std::move(slot.error()));
  link::descriptor woken(::eventfd(0, EFD_CLOEXEC));
  if (!woken.is_open())
    return tl::make_unexpected(std::string("no descriptor is left: ") + std::strerror(errno));
  return std::shared_ptr<helper>(
      new helper(std::make_unique<parts>(std::move(command), *std::move(slot), std::move(woken))));
}

void helper::attach(helper_listener listener) {
  parts_->listener = std::move(listener);
  parts_->thread = std::thread([all = parts_.get()] { all->run(); });
}

helper::~helper() { close(); }

void helper::close() {
  {
    const std::lock_guard guard(parts_->mutex);
    parts_->is_over = true;
  }
  parts_->wake();
  if (parts_->thread.joinable())
    parts_->thread.join();
}

void helper::start(std::uint32_t run, begin wanted) {
  {
    const std::lock_guard guard(parts_->mutex);
    parts_->to_start.emplace(run, std::move(wanted));
  }
  parts_->wake();
}

void helper::end(std::uint32_t upto) {
  {
    const std::lock_guard guard(parts_->mutex);
    if (parts_->to_start && parts_->to_start->first <= upto)
      parts_->to_start.reset();
    parts_->end_upto = std::max(parts_->end_upto, upto);
  }
  parts_->wake();
}

bool helper::send(const message& said) {
  const auto to = [this] {
    const std::lock_guard guard(parts_->mutex);
    return parts_->way;
  }();
  return to && to->send(said) == send_result::sent;
}

const picture_slot& helper::slot() const { return parts_->slot; }

} // namespace godwit::io::eyes
