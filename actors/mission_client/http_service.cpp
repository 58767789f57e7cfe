#include "actors/mission_client/http_service.hpp"

#include <algorithm>
#include <utility>

#include "actors/mission_client/picture_body.hpp"
#include "io/http/outcome.hpp"
#include "runtime/clock.hpp"

namespace godwit::mission_client {

namespace {

namespace http = io::http;

constexpr const char* json = "application/json";
constexpr const char* next_page = "Next-Page"; // header of the contract: the `next` of the page that it begins
constexpr std::size_t max_next_bytes = 1024;   // as the contract has it

// A proxy is the network on the way here; nothing that can be read as an answer of the service came from it. A
// certificate that can not be verified may be good once the clock of a vehicle that has just started is set, which
// nobody has to do by hand.
ending ending_of(http::errc code) {
  switch (code) {
  case http::errc::wrong_content_type:
  case http::errc::body_too_large:
  case http::errc::encoded:
  case http::errc::malformed:
  case http::errc::header_too_large:
    return ending::bad_answer;
  default:
    return http::is_transient(code) || code == http::errc::closing || code == http::errc::too_many ||
                   code == http::errc::cancelled || code == http::errc::tls_not_verified
               ? ending::not_reached
               : ending::misconfigured;
  }
}

service_answer failed(std::uint64_t number, const http::error& why) {
  return {.number = number, .how = ending_of(why.code), .error = why.message()};
}

service_answer answered(std::uint64_t number, http::response got) {
  service_answer result{.number = number, .status = got.status};
  const http::wall_time now{std::chrono::duration_cast<http::wall_time::duration>(
      std::chrono::nanoseconds(runtime::system_time().wall_ns()))};
  if (const auto wait = http::retry_after(got, now))
    result.retry_after_ns = std::chrono::nanoseconds(*wait).count();
  result.body = std::move(got.body);
  return result;
}

http::request request_of(service_call call) {
  http::request result;
  result.method = call.is_post ? http::method::post : http::method::get;
  result.target = std::move(call.target);
  result.body = std::move(call.body);
  result.content_type = call.is_post ? json : "";
  result.idempotency_key = std::move(call.key);
  result.expected_content_type = json;
  result.max_body_bytes = call.max_answer_bytes;
  result.accepts_compressed = call.is_page;
  result.read_timeout = call.read_timeout;
  result.total_timeout = call.total_timeout;
  return result;
}

} // namespace

tl::expected<std::shared_ptr<http_service>, std::string> http_service::open(http::settings wanted,
                                                                            std::filesystem::path pictures) {
  wanted.max_under_way = std::max(wanted.max_under_way, min_connections);
  wanted.max_kept = std::max(wanted.max_kept, min_connections);
  auto opened = http::client::open(std::move(wanted));
  if (!opened)
    return tl::unexpected(opened.error().message());
  std::shared_ptr<http_service> result(new http_service(std::move(pictures)));
  result->client_ = std::move(*opened);
  return result;
}

http_service::~http_service() { close(); }

void http_service::attach(runtime::gateway gateway, wake_handle actor) {
  const std::lock_guard guard(waker_mutex_);
  gateway_.emplace(std::move(gateway));
  actor_ = std::move(actor);
}

void http_service::close() {
  std::unique_ptr<http::client> ending;
  {
    const std::lock_guard guard(mutex_);
    ending = std::move(client_);
  }
  ending.reset(); // its callbacks come meanwhile, so no lock is held
  const std::lock_guard guard(waker_mutex_);
  gateway_.reset();
  actor_.reset();
}

std::uint64_t http_service::send(service_call call) {
  std::optional<service_answer> failure;
  if (!call.picture.empty() && !put_picture(call, pictures_))
    failure = {.how = ending::no_picture, .error = "the picture " + call.picture + " is not on the disk any more"};
  std::uint64_t number = 0;
  {
    const std::lock_guard guard(mutex_);
    number = next_number_++;
    if (client_ == nullptr)
      return number;
    if (!failure)
      failure = send_numbered(number, std::move(call));
  }
  if (failure) {
    failure->number = number;
    put(*std::move(failure));
  }
  return number;
}

std::optional<service_answer> http_service::send_numbered(std::uint64_t number, service_call call) {
  const bool is_page = call.is_page;
  auto asked = request_of(std::move(call));
  if (is_page)
    asked.on_head = [this, number](const http::response& head) { take_head(number, head); };
  const auto sent = client_->send(std::move(asked),
                                  [this, number](http::result<http::response> got) { take(number, std::move(got)); });
  if (!sent)
    return failed(number, sent.error());
  under_way_.emplace(number, *sent);
  return std::nullopt;
}

void http_service::cancel(std::uint64_t number) {
  const std::lock_guard guard(mutex_);
  if (const auto found = under_way_.find(number); found != under_way_.end() && client_ != nullptr)
    client_->cancel(found->second);
}

void http_service::cancel_all() {
  const std::lock_guard guard(mutex_);
  if (client_ != nullptr)
    for (const auto& [number, request] : under_way_)
      client_->cancel(request);
}

http::client_counters http_service::counters() const {
  const std::lock_guard guard(mutex_);
  return client_ == nullptr ? http::client_counters{} : client_->counters();
}

// In the client's thread. It may come before send() has noted the request; the lock there makes it wait. A call that
// our own end cuts off says nothing about the service: as a failed try it would count against what is delivered.
void http_service::take(std::uint64_t number, http::result<http::response> got) {
  bool ends = false;
  {
    const std::lock_guard guard(mutex_);
    under_way_.erase(number);
    ends = client_ == nullptr;
  }
  if (!got && ends)
    return;
  put(got ? answered(number, std::move(*got)) : failed(number, got.error()));
}

void http_service::take_head(std::uint64_t number, const http::response& head) {
  const auto next = head.find(next_page);
  if (!next.empty() && next.size() <= max_next_bytes)
    put({.number = number, .how = ending::page_begun, .status = head.status, .body = std::string(next)});
}

void http_service::put(service_answer answer) {
  const bool sleeps = answers().put(std::move(answer));
  const std::lock_guard guard(waker_mutex_);
  if (sleeps && gateway_ && actor_)
    gateway_->tell(*actor_, wake{});
}

} // namespace godwit::mission_client
