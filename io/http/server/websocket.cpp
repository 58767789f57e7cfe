#include "io/http/server/websocket.hpp"

#include <optional>
#include <utility>

#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <boost/beast/websocket/stream.hpp>

#include "io/http/server/websocket_wire.hpp"

namespace godwit::io::http {

namespace asio = boost::asio;
namespace beast = boost::beast;
using boost::system::error_code;

namespace {

using head = beast::http::request<beast::http::empty_body>;

beast::string_view view_of(std::string_view text) { return {text.data(), text.size()}; }

head head_of(const server_request& asked) {
  head result;
  result.method_string(view_of(asked.method));
  result.target(view_of(asked.target));
  result.version(11);
  for (const auto& each : asked.headers)
    result.insert(view_of(each.name), view_of(each.value));
  return result;
}

} // namespace

struct websocket::engine {
  engine(asio::io_context& context, const websocket_settings& wanted, websocket_hooks called)
      : io(context), set(wanted), hooks(std::move(called)), watchdog(context) {}

  asio::io_context& io;
  websocket_settings set;
  websocket_hooks hooks;
  asio::steady_timer watchdog;
  std::uint64_t watch = 0; // number of what is watched: an older one that comes late is nobody's business
  std::optional<beast::websocket::stream<websocket_wire, false>> stream;
  beast::flat_buffer heard;
  std::shared_ptr<const std::string> writing;
  std::optional<beast::websocket::close_reason> closing; // waits for what is being written
  bool is_open = false;
  bool is_closing = false;
  bool has_ended = false;
};

bool is_websocket_request(const server_request& asked) { return beast::websocket::is_upgrade(head_of(asked)); }

websocket::websocket(asio::io_context& io, const websocket_settings& set, websocket_hooks hooks)
    : engine_(std::make_unique<engine>(io, set, std::move(hooks))) {}

websocket::~websocket() = default;

bool websocket::is_open() const { return engine_->is_open && !engine_->is_closing && !engine_->has_ended; }

void websocket::accept(const server_request& asked, std::unique_ptr<connection> taken, const std::string& early) {
  auto& e = *engine_;
  error_code ignored; // then the system decides
  taken->socket().set_option(asio::socket_base::send_buffer_size(static_cast<int>(e.set.send_buffer_bytes)), ignored);
  e.stream.emplace(e.io, std::move(taken));
  if (!early.empty())
    return end("it spoke before it was answered");
  using options = beast::websocket::stream_base;
  e.stream->set_option(options::timeout{e.set.handshake_timeout, e.set.idle_timeout, true});
  e.stream->set_option(options::decorator(
      [](beast::websocket::response_type& answer) { answer.set(beast::http::field::server, "godwitd"); }));
  e.stream->read_message_max(e.set.max_message_bytes);
  e.stream->auto_fragment(false);
  e.stream->text(true);
  e.stream->async_accept(head_of(asked), [self = shared_from_this()](const error_code& failed) {
    auto& mine = *self->engine_;
    if (mine.has_ended)
      return;
    if (failed)
      return self->end("no handshake: " + failed.message());
    mine.is_open = true;
    self->read();
    if (mine.hooks.on_open)
      mine.hooks.on_open();
  });
}

void websocket::read() {
  auto& e = *engine_;
  e.heard.clear();
  e.stream->async_read(e.heard, [self = shared_from_this()](const error_code& failed, std::size_t) {
    self->have_read(failed ? failed.message() : std::string());
  });
}

void websocket::have_read(const std::string& failed) {
  auto& e = *engine_;
  if (e.has_ended)
    return;
  if (!failed.empty())
    return end(failed);
  if (!e.hooks.on_text || !e.stream->got_text())
    close(close_code::policy, "this stream takes no messages");
  else if (!e.is_closing)
    e.hooks.on_text({static_cast<const char*>(e.heard.data().data()), e.heard.size()});
  if (!e.has_ended && !e.is_closing) // the closing handshake reads by itself, and leaves a frame of which half is read
    read();
}

void websocket::watch(std::chrono::seconds time, const char* why) {
  auto& e = *engine_;
  e.watchdog.expires_after(time);
  e.watchdog.async_wait([self = shared_from_this(), number = ++e.watch, why](const error_code& cancelled) {
    if (!cancelled && number == self->engine_->watch)
      self->end(why);
  });
}

void websocket::write(std::shared_ptr<const std::string> text, done then) {
  auto& e = *engine_;
  if (!is_open())
    return;
  e.writing = std::move(text);
  watch(e.set.write_timeout, "it takes nothing");
  e.stream->async_write(asio::buffer(*e.writing),
                        [self = shared_from_this(), then = std::move(then)](const error_code& failed, std::size_t) {
                          auto& mine = *self->engine_;
                          if (mine.has_ended)
                            return;
                          if (failed)
                            return self->end(failed.message());
                          ++mine.watch;
                          mine.watchdog.cancel();
                          mine.writing.reset();
                          if (mine.closing)
                            return self->begin_close();
                          then();
                        });
}

void websocket::close(close_code code, std::string why) {
  auto& e = *engine_;
  if (e.has_ended || std::exchange(e.is_closing, true))
    return;
  if (!e.is_open)
    return end(why);
  why.resize(std::min(why.size(), std::size_t{123})); // as long as a reason may be
  e.closing.emplace(static_cast<beast::websocket::close_code>(code), view_of(why));
  if (!e.writing)
    begin_close();
}

void websocket::begin_close() {
  auto& e = *engine_;
  watch(e.set.close_timeout, "it was closed");
  e.stream->async_close(*e.closing, [self = shared_from_this()](const error_code&) { self->end("it was closed"); });
}

void websocket::end(const std::string& why) {
  auto& e = *engine_;
  if (std::exchange(e.has_ended, true))
    return;
  ++e.watch;
  e.watchdog.cancel();
  if (e.stream)
    e.stream->next_layer().over().close();
  const auto self = shared_from_this();
  const auto hooks = std::exchange(e.hooks, {});
  if (hooks.on_end)
    hooks.on_end(why);
}

} // namespace godwit::io::http
