#include "tests/support/mosquitto.hpp"

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <utility>

#include <arpa/inet.h>
#include <fcntl.h>
#include <mosquitto.h>
#include <mqtt_protocol.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace godwit::tests {
namespace {

constexpr const char* program = "/usr/sbin/mosquitto";
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

bool broker::is_installed() { return std::filesystem::exists(program); }

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

watcher::watcher(std::uint16_t port, const std::string& name) {
  mosquitto_lib_init();
  client_ = mosquitto_new(name.c_str(), false, this);
  mosquitto_int_option(client_, MOSQ_OPT_PROTOCOL_VERSION, MQTT_PROTOCOL_V5);
  mosquitto_reconnect_delay_set(client_, 1, 1, false);
  mosquitto_connect_callback_set(client_, [](mosquitto* client, void*, int) {
    mosquitto_subscribe_v5(client, nullptr, "#", 1, MQTT_SUB_OPT_RETAIN_AS_PUBLISHED, nullptr);
  });
  mosquitto_message_callback_set(client_, [](mosquitto*, void* self, const mosquitto_message* what) {
    auto& me = *static_cast<watcher*>(self);
    const std::lock_guard guard(me.mutex_);
    me.heard_.push_back({what->topic,
                         {static_cast<const char*>(what->payload), static_cast<std::size_t>(what->payloadlen)},
                         what->retain});
    me.more_.notify_all();
  });
  mosquitto_property* keep = nullptr;
  mosquitto_property_add_int32(&keep, MQTT_PROP_SESSION_EXPIRY_INTERVAL, ~std::uint32_t{0});
  mosquitto_connect_bind_v5(client_, "127.0.0.1", port, 10, nullptr, keep);
  mosquitto_property_free_all(&keep);
  mosquitto_loop_start(client_);
}

watcher::~watcher() {
  mosquitto_disconnect(client_);
  mosquitto_loop_stop(client_, false);
  mosquitto_destroy(client_);
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
