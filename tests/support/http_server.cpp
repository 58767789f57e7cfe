#include "tests/support/http_server.hpp"

#include <array>
#include <atomic>
#include <list>
#include <mutex>
#include <thread>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <poll.h>
#include <sys/socket.h>

namespace godwit::test {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using tcp = asio::ip::tcp;
using boost::system::error_code;
using plain_stream = tcp::socket;
using tls_stream = asio::ssl::stream<tcp::socket>;

constexpr std::uint64_t max_request_bytes = 64 * 1024 * 1024;

// What both kinds of connection share: the socket below.
class any_peer : public http_peer {
public:
  virtual tcp::socket& socket() = 0;
  virtual bool begin() = 0; // TLS
  virtual std::optional<http_request> read(beast::flat_buffer&) = 0;

  // From another thread: every blocking call on it returns.
  void cut() { ::shutdown(socket().native_handle(), SHUT_RDWR); }
  void hang_up() override {
    error_code ignored;
    socket().shutdown(tcp::socket::shutdown_both, ignored);
    socket().close(ignored);
  }
  void reset() override {
    error_code ignored;
    socket().set_option(asio::socket_base::linger(true, 0), ignored);
    socket().close(ignored);
  }
  void wait_until_gone() override {
    std::array<char, 4096> ignored{};
    while (::recv(socket().native_handle(), ignored.data(), ignored.size(), 0) > 0) {
    }
  }
  void tunnel_to(std::uint16_t port) override {
    tcp::socket far(socket().get_executor());
    error_code failed;
    far.connect({asio::ip::address_v4::loopback(), port}, failed);
    while (!failed && pass_on(far)) {
    }
  }

private:
  // Waits for bytes on either side and hands them to the other. False: one of them is gone.
  bool pass_on(tcp::socket& far) {
    std::array<pollfd, 2> both{{{socket().native_handle(), POLLIN, 0}, {far.native_handle(), POLLIN, 0}}};
    if (::poll(both.data(), both.size(), -1) < 0)
      return false;
    std::array<char, 16 * 1024> bytes{};
    for (std::size_t from = 0; from < both.size(); ++from) {
      if (both[from].revents == 0)
        continue;
      const auto got = ::recv(both[from].fd, bytes.data(), bytes.size(), 0);
      if (got <= 0 || ::send(both[1 - from].fd, bytes.data(), static_cast<std::size_t>(got), MSG_NOSIGNAL) != got)
        return false;
    }
    return true;
  }
};

template <class Stream>
class peer_on final : public any_peer {
public:
  template <class... Arguments>
  explicit peer_on(Arguments&&... arguments) : stream_(std::forward<Arguments>(arguments)...) {}

  tcp::socket& socket() override {
    if constexpr (std::is_same_v<Stream, tls_stream>)
      return stream_.next_layer();
    else
      return stream_;
  }
  bool begin() override {
    error_code failed;
    if constexpr (std::is_same_v<Stream, tls_stream>)
      stream_.handshake(asio::ssl::stream_base::server, failed);
    return !failed;
  }
  std::optional<http_request> read(beast::flat_buffer& buffer) override {
    beast::http::request_parser<beast::http::string_body> parser;
    parser.body_limit(max_request_bytes);
    if (!socket().is_open())
      return std::nullopt;
    error_code failed;
    beast::http::read(stream_, buffer, parser, failed);
    return failed ? std::nullopt : std::optional(parser.release());
  }
  bool write(std::string_view bytes) override {
    error_code failed;
    asio::write(stream_, asio::buffer(bytes), failed);
    return !failed;
  }
  void close() override {
    error_code ignored;
    if constexpr (std::is_same_v<Stream, tls_stream>)
      stream_.shutdown(ignored); // says it, and waits until the other side has closed
    hang_up();
  }

private:
  Stream stream_;
};

asio::ssl::context make_context(const http_server_options& options) {
  asio::ssl::context made(asio::ssl::context::tls_server);
  const auto& identity = *options.tls;
  made.use_certificate_chain(asio::buffer(identity.certificate));
  made.use_private_key(asio::buffer(identity.key), asio::ssl::context::pem);
  if (options.max_tls_version != 0) {
    ::SSL_CTX_set_security_level(made.native_handle(), 0); // else OpenSSL does not even offer the old ones
    ::SSL_CTX_set_min_proto_version(made.native_handle(), TLS1_VERSION);
    ::SSL_CTX_set_max_proto_version(made.native_handle(), options.max_tls_version);
  }
  if (!options.client_issuer.empty()) {
    made.add_certificate_authority(asio::buffer(options.client_issuer));
    made.set_verify_mode(asio::ssl::verify_peer | asio::ssl::verify_fail_if_no_peer_cert);
  }
  return made;
}

} // namespace

class http_server::running {
public:
  running(handler answer, const http_server_options& options)
      : answer_(std::move(answer)), acceptor_(io_, {asio::ip::address_v4::loopback(), 0}) {
    if (options.tls)
      tls_.emplace(make_context(options));
    acceptor_thread_ = std::thread([this] { accept_all(); });
  }
  ~running() {
    is_ending_ = true;
    ::shutdown(acceptor_.native_handle(), SHUT_RDWR);
    acceptor_thread_.join();
    {
      const std::lock_guard lock(mutex_);
      for (any_peer* const each : peers_)
        each->cut();
    }
    for (auto& each : threads_)
      each.join();
  }
  running(const running&) = delete;
  running& operator=(const running&) = delete;

  [[nodiscard]] std::uint16_t port() const { return acceptor_.local_endpoint().port(); }
  [[nodiscard]] bool is_tls() const { return tls_.has_value(); }
  std::atomic<int> connections{0};
  std::atomic<int> requests{0};

private:
  void accept_all() {
    while (!is_ending_) {
      error_code failed;
      tcp::socket accepted(io_);
      acceptor_.accept(accepted, failed);
      if (failed)
        return;
      const int number = ++connections;
      threads_.emplace_back(
          [this, number, socket = std::move(accepted)]() mutable { serve(std::move(socket), number); });
    }
  }

  void serve(tcp::socket socket, int number) {
    std::unique_ptr<any_peer> peer;
    if (tls_)
      peer = std::make_unique<peer_on<tls_stream>>(std::move(socket), *tls_);
    else
      peer = std::make_unique<peer_on<plain_stream>>(std::move(socket));
    peer->connection = number;
    {
      const std::lock_guard lock(mutex_);
      peers_.push_back(peer.get());
      if (is_ending_)
        peer->cut();
    }
    serve_requests(*peer);
    const std::lock_guard lock(mutex_);
    peers_.remove(peer.get());
  }

  void serve_requests(any_peer& peer) {
    if (!peer.begin())
      return;
    beast::flat_buffer buffer;
    while (auto asked = peer.read(buffer)) {
      ++requests;
      ++peer.request;
      answer_(peer, *asked);
    }
  }

  handler answer_;
  asio::io_context io_;
  std::optional<asio::ssl::context> tls_;
  tcp::acceptor acceptor_;
  std::atomic<bool> is_ending_{false};
  std::mutex mutex_;
  std::list<any_peer*> peers_;       // under the mutex
  std::vector<std::thread> threads_; // the acceptor's, and the destructor's when that has ended
  std::thread acceptor_thread_;
};

http_server::http_server(handler answer, const http_server_options& options)
    : running_(std::make_unique<running>(std::move(answer), options)) {}
http_server::~http_server() = default;

std::uint16_t http_server::port() const { return running_->port(); }
std::string http_server::url(const std::string& host) const {
  return (running_->is_tls() ? "https://" : "http://") + host + ":" + std::to_string(port());
}
int http_server::connections() const { return running_->connections; }
int http_server::requests() const { return running_->requests; }

std::string http_answer(std::string_view status, std::string_view body, std::string_view headers) {
  return "HTTP/1.1 " + std::string(status) + "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n" +
         std::string(headers) + "\r\n" + std::string(body);
}

} // namespace godwit::test
