#include "io/mqtt/connection.hpp"

#include <cerrno>
#include <condition_variable>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include <mosquitto.h>
#include <mqtt_protocol.h>

#include "io/http/secret_file.hpp"

namespace godwit::io::mqtt {
namespace {

constexpr int loop_ms = 500;
constexpr int first_refusal = 0x80; // of the reason codes
constexpr std::size_t max_password_bytes = 4'096;
constexpr const char* system_issuers = "/etc/ssl/certs";

void begin_library() {
  static const int begun = mosquitto_lib_init();
  (void)begun;
}

failure failure_of_refusal(int code) {
  switch (code) {
  case MQTT_RC_BAD_USERNAME_OR_PASSWORD:
  case MQTT_RC_NOT_AUTHORIZED:
  case MQTT_RC_BANNED:
  case MQTT_RC_BAD_AUTHENTICATION_METHOD:
    return failure::not_authorised;
  case MQTT_RC_SESSION_TAKEN_OVER:
    return failure::taken_over;
  default:
    return failure::refused;
  }
}

failure failure_of_library(int code, int system, bool was_open) {
  switch (code) {
  case MOSQ_ERR_EAI:
  case MOSQ_ERR_LOOKUP:
    return failure::not_resolved;
  case MOSQ_ERR_TLS:
  case MOSQ_ERR_TLS_HANDSHAKE:
    return failure::certificate;
  case MOSQ_ERR_INVAL:
    return failure::unusable;
  default:
    return was_open ? failure::lost : system == EPROTO ? failure::certificate : failure::unreachable;
  }
}

class property_list {
public:
  property_list() = default;
  property_list(const property_list&) = delete;
  property_list& operator=(const property_list&) = delete;
  ~property_list() { mosquitto_property_free_all(&list_); }

  void add_text(int which, const char* value) { mosquitto_property_add_string(&list_, which, value); }
  void add_number(int which, std::uint32_t value) { mosquitto_property_add_int32(&list_, which, value); }
  [[nodiscard]] mosquitto_property* get() const { return list_; }
  [[nodiscard]] mosquitto_property* release() { return std::exchange(list_, nullptr); }

private:
  mosquitto_property* list_ = nullptr;
};

} // namespace

class connection::inner {
public:
  inner(connection_settings wanted, message will, listener ears)
      : wanted_(std::move(wanted)), will_(std::move(will)), ears_(std::move(ears)) {
    begin_library();
    client_ = mosquitto_new(wanted_.client_id.c_str(), true, this);
  }
  inner(const inner&) = delete;
  inner& operator=(const inner&) = delete;
  ~inner() { mosquitto_destroy(client_); }

  void run();
  void publish(const message& what, std::uint64_t token);
  void end();
  [[nodiscard]] bool wait_for_end(std::chrono::milliseconds patience);

private:
  // Sentence: what is wrong.
  using checked = std::optional<std::string>;

  static inner& of(void* object) { return *static_cast<inner*>(object); }
  void set_callbacks();
  [[nodiscard]] checked prepare();
  [[nodiscard]] checked set_password();
  [[nodiscard]] checked set_tls();
  void set_will();
  void on_connected(int code);
  void on_published(int message, int code);
  void refuse(int code, const std::string& what);
  void ended(failure why, const std::string& sentence);
  void ended_by(int code);
  template <class F>
  void tell(const F& what);

  const connection_settings wanted_;
  const message will_;
  listener ears_;
  mosquitto* client_ = nullptr;

  std::mutex ears_mutex_; // held while the listener is called
  bool is_heard_ = true;

  std::mutex mutex_; // over all that follows
  std::condition_variable has_ended_changed_;
  std::map<int, std::uint64_t> under_way_; // token by message id
  std::set<int> early_;                    // published before publish() had returned
  bool is_open_ = false;
  bool is_ending_ = false;
  bool has_ended_ = false;
  std::string last_error_; // as the library logs it
  std::optional<std::pair<failure, std::string>> refusal_;
};

template <class F>
void connection::inner::tell(const F& what) {
  const std::lock_guard guard(ears_mutex_);
  if (is_heard_)
    what();
}

void connection::inner::set_callbacks() {
  mosquitto_connect_v5_callback_set(
      client_, [](mosquitto*, void* self, int code, int, const mosquitto_property*) { of(self).on_connected(code); });
  mosquitto_publish_v5_callback_set(client_, [](mosquitto*, void* self, int id, int code, const mosquitto_property*) {
    of(self).on_published(id, code);
  });
  mosquitto_disconnect_v5_callback_set(client_, [](mosquitto*, void* self, int code, const mosquitto_property*) {
    if (code >= first_refusal)
      of(self).refuse(code, "has ended the connection");
  });
  mosquitto_log_callback_set(client_, [](mosquitto*, void* self, int level, const char* text) {
    if (level != MOSQ_LOG_ERR)
      return;
    const std::lock_guard guard(of(self).mutex_);
    of(self).last_error_ = text;
  });
}

connection::inner::checked connection::inner::prepare() {
  if (client_ == nullptr)
    return "there is no memory for a client";
  mosquitto_threaded_set(client_, true);
  mosquitto_int_option(client_, MOSQ_OPT_PROTOCOL_VERSION, MQTT_PROTOCOL_V5);
  mosquitto_int_option(client_, MOSQ_OPT_TCP_NODELAY, 1);
  set_callbacks();
  set_will();
  if (auto wrong = set_password())
    return wrong;
  return wanted_.broker.uses_tls ? set_tls() : std::nullopt;
}

connection::inner::checked connection::inner::set_password() {
  if (wanted_.username.empty())
    return {};
  if (wanted_.password_file.empty()) {
    mosquitto_username_pw_set(client_, wanted_.username.c_str(), nullptr);
    return {};
  }
  auto password = http::load_secret_file(wanted_.password_file, max_password_bytes, http::errc::token_file);
  if (!password)
    return password.error().message();
  const auto line = password->revealed().find_first_of("\r\n");
  const auto size = line == std::string_view::npos ? password->revealed().size() : line;
  http::secret_text ended(size + 1); // with its NUL
  std::memcpy(ended.data(), password->revealed().data(), size);
  mosquitto_username_pw_set(client_, wanted_.username.c_str(), ended.data());
  return {};
}

connection::inner::checked connection::inner::set_tls() {
  const auto path = [](const std::string& file) { return file.empty() ? nullptr : file.c_str(); };
  if (!wanted_.key_file.empty())
    if (const auto key = http::load_secret_file(wanted_.key_file, http::max_key_bytes, http::errc::invalid_settings);
        !key)
      return key.error().message();
  const auto done =
      mosquitto_tls_set(client_, path(wanted_.ca_file), wanted_.ca_file.empty() ? system_issuers : nullptr,
                        path(wanted_.certificate_file), path(wanted_.key_file), nullptr);
  if (done != MOSQ_ERR_SUCCESS)
    return "the files of TLS (telemetry.ca_file, certificate_file, key_file) can not be used: " +
           std::string(mosquitto_strerror(done));
  return {};
}

void connection::inner::set_will() {
  property_list about;
  about.add_text(MQTT_PROP_CONTENT_TYPE, "application/json");
  const auto set = mosquitto_will_set_v5(client_, will_.topic.c_str(), static_cast<int>(will_.payload->size()),
                                         will_.payload->data(), 1, will_.is_retained, about.get());
  if (set == MOSQ_ERR_SUCCESS)
    (void)about.release(); // the client has it
}

void connection::inner::run() {
  if (const auto wrong = prepare())
    return ended(failure::unusable, *wrong);
  errno = 0;
  auto done = mosquitto_connect_bind_v5(client_, wanted_.broker.host.c_str(), wanted_.broker.port, wanted_.keep_alive_s,
                                        nullptr, nullptr);
  while (done == MOSQ_ERR_SUCCESS) {
    {
      const std::lock_guard guard(mutex_);
      if (refusal_ || (is_ending_ && !is_open_))
        break;
    }
    errno = 0;
    done = mosquitto_loop(client_, loop_ms, 1);
  }
  ended_by(done);
}

void connection::inner::ended_by(int code) {
  const auto system = errno;
  std::unique_lock lock(mutex_);
  if (refusal_) {
    const auto why = *refusal_;
    lock.unlock();
    return ended(why.first, why.second);
  }
  auto why = failure_of_library(code, system, is_open_);
  if (!is_open_ && last_error_.find("OpenSSL") != std::string::npos)
    why = failure::certificate;
  std::string sentence = is_open_ ? "the connection was lost" : "there is no connection";
  if (code == MOSQ_ERR_ERRNO && system != 0)
    sentence += std::string(": ") + std::strerror(system);
  else if (code != MOSQ_ERR_CONN_LOST)
    sentence += std::string(": ") + mosquitto_strerror(code);
  if (!last_error_.empty())
    sentence += " (" + last_error_ + ")";
  lock.unlock();
  ended(why, sentence);
}

void connection::inner::ended(failure why, const std::string& sentence) {
  tell([&] { ears_.closed(why, sentence); });
  const std::lock_guard guard(mutex_);
  has_ended_ = true;
  has_ended_changed_.notify_all();
}

void connection::inner::on_connected(int code) {
  if (code >= first_refusal || code != MQTT_RC_SUCCESS)
    return refuse(code, "refuses the connection");
  {
    const std::lock_guard guard(mutex_);
    is_open_ = true;
  }
  tell([this] { ears_.opened(); });
}

// Below 0x80 stand the answers of older versions, which all mean no.
void connection::inner::refuse(int code, const std::string& what) {
  const std::string reason = code < first_refusal ? "it does not speak MQTT 5" : mosquitto_reason_string(code);
  const std::lock_guard guard(mutex_);
  if (!refusal_)
    refusal_ = {failure_of_refusal(code), "the broker " + what + ": " + reason};
}

void connection::inner::on_published(int id, int code) {
  if (code >= first_refusal)
    return refuse(code, "does not take a message");
  std::unique_lock lock(mutex_);
  const auto found = under_way_.find(id);
  if (found == under_way_.end()) {
    early_.insert(id);
    return;
  }
  const auto token = found->second;
  under_way_.erase(found);
  lock.unlock();
  tell([&] { ears_.published(token); });
}

void connection::inner::publish(const message& what, std::uint64_t token) {
  property_list about;
  about.add_text(MQTT_PROP_CONTENT_TYPE, "application/json");
  if (what.expires_s != 0)
    about.add_number(MQTT_PROP_MESSAGE_EXPIRY_INTERVAL, what.expires_s);
  int id = 0;
  if (mosquitto_publish_v5(client_, &id, what.topic.c_str(), static_cast<int>(what.payload->size()),
                           what.payload->data(), what.is_acknowledged ? 1 : 0, what.is_retained,
                           about.get()) != MOSQ_ERR_SUCCESS)
    return; // the connection is gone, and says so
  std::unique_lock lock(mutex_);
  if (early_.erase(id) == 0) {
    under_way_[id] = token;
    return;
  }
  lock.unlock();
  tell([&] { ears_.published(token); });
}

void connection::inner::end() {
  {
    const std::lock_guard guard(ears_mutex_);
    is_heard_ = false;
  }
  const std::lock_guard guard(mutex_);
  if (!std::exchange(is_ending_, true))
    mosquitto_disconnect_v5(client_, MQTT_RC_DISCONNECT_WITH_WILL_MSG, nullptr);
}

bool connection::inner::wait_for_end(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  return has_ended_changed_.wait_for(lock, patience, [this] { return has_ended_; });
}

// -- connection -----------------------------------------------------------------------------------

connection::connection(connection_settings wanted, message will, listener ears)
    : inner_(std::make_shared<inner>(std::move(wanted), std::move(will), std::move(ears))) {
  std::thread([shared = inner_] { shared->run(); }).detach();
}

void connection::publish(const message& what, std::uint64_t token) { inner_->publish(what, token); }

void connection::end() { inner_->end(); }

bool connection::wait_for_end(std::chrono::milliseconds patience) { return inner_->wait_for_end(patience); }

} // namespace godwit::io::mqtt
