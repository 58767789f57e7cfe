#include "tests/support/mosquitto.hpp"

#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <utility>

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace godwit::tests {
namespace {

constexpr const char* program = "/usr/sbin/mosquitto";
constexpr const char* subscriber = "/usr/bin/mosquitto_sub";
constexpr auto look_period = std::chrono::milliseconds(20);
constexpr int patience_looks = 500;

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in result{};
  result.sin_family = AF_INET;
  result.sin_port = htons(port);
  result.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return result;
}

std::uint16_t free_port() {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  auto address = loopback(0);
  socklen_t size = sizeof address;
  if (::bind(socket, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
      ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) != 0)
    throw std::runtime_error("no port is free");
  ::close(socket);
  return ntohs(address.sin_port);
}

bool answers(std::uint16_t port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const auto address = loopback(port);
  const bool result = ::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  ::close(socket);
  return result;
}

std::filesystem::path fresh_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "godwit_broker_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw std::runtime_error("no folder can be made");
  return name;
}

} // namespace

bool broker::is_installed() { return std::filesystem::exists(program) && std::filesystem::exists(subscriber); }

broker::broker(std::string extra) : extra_(std::move(extra)), folder_(fresh_folder()), port_(free_port()) { start(); }

broker::~broker() {
  stop();
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void broker::start() {
  const auto settings = folder_ / "mosquitto.conf";
  std::ofstream(settings) << "listener " << port_ << " 127.0.0.1\nuser root\nmax_queued_messages 0\npersistence true\n"
                          << "persistence_location " << folder_.string() << "/\n"
                          << extra_ << "\n";
  process_ = ::fork();
  if (process_ == 0) {
    const int log = ::open((folder_ / "log").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    ::dup2(log, STDOUT_FILENO);
    ::dup2(log, STDERR_FILENO);
    ::execl(program, program, "-v", "-c", settings.c_str(), nullptr);
    ::_exit(127);
  }
  for (int looks = 0; looks < patience_looks && !answers(port_); ++looks)
    std::this_thread::sleep_for(look_period);
}

void broker::stop() {
  if (process_ < 0)
    return;
  ::kill(process_, SIGTERM);
  ::waitpid(std::exchange(process_, -1), nullptr, 0);
}

// The session stays while it is away, and nothing is missed: -c with -x, and QoS 1.
watcher::watcher(std::uint16_t port, const std::string& name) {
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe can be made");
  process_ = ::fork();
  if (process_ == 0) {
    ::dup2(pipe[1], STDOUT_FILENO);
    const auto place = std::to_string(port);
    ::execl(subscriber, subscriber, "-V", "5", "-p", place.c_str(), "-i", name.c_str(), "-c", "-x", "4294967295", "-q",
            "1", "-k", "10", "-t", "#", "--retain-as-published", "-F", "%r %t %p", nullptr);
    ::_exit(127);
  }
  ::close(pipe[1]);
  output_ = pipe[0];
  reader_ = std::thread([this] { collect(); });
}

watcher::~watcher() {
  ::kill(process_, SIGTERM);
  ::waitpid(process_, nullptr, 0);
  reader_.join();
  ::close(output_);
}

// Payloads are JSON of one line.
void watcher::collect() {
  std::string text;
  std::array<char, 4096> piece{};
  for (ssize_t got = 0; (got = ::read(output_, piece.data(), piece.size())) > 0;) {
    text.append(piece.data(), static_cast<std::size_t>(got));
    const std::lock_guard guard(mutex_);
    for (std::size_t end = 0; (end = text.find('\n')) != std::string::npos; text.erase(0, end + 1)) {
      const auto topic_end = text.find(' ', 2);
      heard_.push_back(
          {text.substr(2, topic_end - 2), text.substr(topic_end + 1, end - topic_end - 1), text[0] == '1'});
    }
    more_.notify_all();
  }
}

std::vector<heard_message> watcher::heard() {
  const std::lock_guard guard(mutex_);
  return heard_;
}

bool watcher::wait_for(const std::function<bool(const std::vector<heard_message>&)>& satisfied,
                       std::chrono::seconds patience) {
  std::unique_lock lock(mutex_);
  return more_.wait_for(lock, patience, [&] { return satisfied(heard_); });
}

} // namespace godwit::tests
