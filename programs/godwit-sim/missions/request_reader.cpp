#include "programs/godwit-sim/missions/request_reader.hpp"

#include <optional>
#include <string>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>

#include "actors/domain/mission/read.hpp"
#include "io/http/message.hpp"
#include "programs/godwit-sim/missions/problem_answer.hpp"
#include "programs/godwit-sim/missions/route.hpp"

namespace godwit::sim::missions {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
using parser = http::request_parser<http::string_body>;

constexpr std::size_t read_piece_bytes = 64 * 1024;
constexpr std::size_t buffer_bytes = max_request_head_bytes + 2 * read_piece_bytes;

// "0", two line ends. Behind the head of a chunk that is incomplete there always come as many bytes as this; and with
// fewer the parser of Boost 1.81 ends the process by an assertion, when the last chunk comes byte by byte.
constexpr std::size_t shortest_last_chunk = 5;

std::string text_of(beast::string_view view) { return {view.data(), view.size()}; }

} // namespace

struct request_reader::state {
  state() : buffer(buffer_bytes) { begin(); }

  void begin() {
    reading.emplace();
    reading->header_limit(max_request_head_bytes);
    reading->body_limit(mission::max_mission_bytes);
    head_judged = false;
    needs_more = false;
    wants_continue = false;
  }

  progress refuse(unsigned status, const std::string& sentence) {
    refused = problem_answer(status, sentence);
    return progress::refused;
  }
  progress too_large() { return refuse(413, "Up to " + std::to_string(max_body) + " bytes."); }

  progress judge_head() {
    head_judged = true;
    const auto& head = reading->get();
    if (head.target().size() > max_target_bytes)
      return refuse(400, "The target has up to " + std::to_string(max_target_bytes) + " bytes.");
    max_body = max_body_bytes(text_of(head.method_string()), text_of(head.target()));
    if (const auto length = reading->content_length(); length && *length > max_body)
      return too_large();
    wants_continue =
        !reading->is_done() && io::http::equals_ignoring_case(text_of(head[http::field::expect]), "100-continue");
    return progress::more;
  }

  progress refuse_as(const beast::error_code& code) {
    if (code == http::error::header_limit)
      return refuse(431, "The head of a request has up to " + std::to_string(max_request_head_bytes) + " bytes.");
    if (code == http::error::body_limit)
      return too_large();
    return refuse(400, "This is not HTTP: " + code.message() + ".");
  }

  // What lies in the buffer is the beginning of a head, or of the head of a chunk.
  progress wait_for_more() {
    needs_more = true;
    return buffer.size() > max_request_head_bytes ? refuse_as(http::error::header_limit) : progress::more;
  }

  progress parse() {
    if (needs_more && head_judged && buffer.size() < shortest_last_chunk)
      return progress::more;
    needs_more = false;
    while (buffer.size() != 0 && !reading->is_done()) {
      beast::error_code code;
      buffer.consume(reading->put(buffer.data(), code));
      if (code == http::error::need_more)
        return wait_for_more();
      if (code)
        return refuse_as(code);
      if (!head_judged && reading->is_header_done() && judge_head() == progress::refused)
        return progress::refused;
      if (head_judged && reading->get().body().size() > max_body)
        return too_large();
    }
    return reading->is_done() ? progress::complete : progress::more;
  }

  beast::flat_buffer buffer;
  std::optional<parser> reading;
  answer refused;
  std::size_t max_body = 0;
  bool head_judged = false;
  bool needs_more = false; // what is in the buffer was looked at and is incomplete
  bool wants_continue = false;
};

request_reader::request_reader() : state_(std::make_unique<state>()) {}
request_reader::~request_reader() = default;

progress request_reader::feed(std::span<const std::byte> bytes) {
  auto& s = *state_;
  const auto room = boost::asio::buffer(bytes.data(), bytes.size());
  s.buffer.commit(boost::asio::buffer_copy(s.buffer.prepare(bytes.size()), room));
  return s.parse();
}

progress request_reader::next() {
  state_->begin();
  return state_->parse();
}

request request_reader::take() {
  auto& message = state_->reading->get();
  return {text_of(message.method_string()), text_of(message.target()), text_of(message[http::field::authorization]),
          text_of(message[http::field::content_type]), std::move(message.body())};
}

answer request_reader::refusal() const { return state_->refused; }

bool request_reader::can_be_kept() const { return state_->reading->is_done() && state_->reading->keep_alive(); }

bool request_reader::has_begun() const { return state_->buffer.size() != 0 || state_->reading->got_some(); }

bool request_reader::take_continue() { return std::exchange(state_->wants_continue, false); }

} // namespace godwit::sim::missions
