#include "io/http/response_reader.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>

#include "io/http/head_rules.hpp"
#include "io/http/sink_body.hpp"

namespace godwit::io::http {
namespace {

namespace beast = boost::beast;
using parser = beast::http::response_parser<sink_body>;

// A head or the head of a chunk that is not complete yet, and what one read brings.
constexpr std::size_t buffer_bytes = max_head_bytes + read_piece_bytes;

// "0", two line ends. Behind the head of a chunk that is incomplete there always come as many bytes as this; and with
// fewer the parser of Boost 1.81 ends the process by an assertion, when the last chunk comes byte by byte.
constexpr std::size_t shortest_last_chunk = 5;

bool is_success(unsigned status) { return status >= 200 && status <= 299; }

std::string bytes_text(std::size_t bytes) { return std::to_string(bytes) + " bytes"; }

error header_too_large() {
  return {errc::header_too_large, "the head of the answer is longer than " + bytes_text(max_head_bytes), {}};
}

error parse_error(const beast::error_code& code) {
  if (code == beast::http::error::header_limit)
    return header_too_large();
  if (code == beast::http::error::partial_message)
    return {errc::truncated, "the answer ends in the middle", {}};
  return {errc::malformed, "the answer is not HTTP: " + code.message() + "; is this the port of the service?", {}};
}

} // namespace

struct response_reader::state {
  explicit state(reader_rules given) : rules(std::move(given)), buffer(buffer_bytes) { begin(); }

  void begin();
  void take_body(std::span<const std::byte> bytes, beast::error_code& stop);
  void take_success(std::span<const std::byte> bytes);
  void take_error_page(std::span<const std::byte> bytes);
  void keep(std::span<const std::byte> bytes);
  [[nodiscard]] bool is_complete() const { return answer.is_cut || (head_judged && reading->is_done()); }
  [[nodiscard]] result<void> parse();
  [[nodiscard]] result<void> head_is_done();
  [[nodiscard]] result<void> waiting_for_more() const;
  [[nodiscard]] result<void> too_large();

  reader_rules rules;
  beast::flat_buffer buffer;
  std::optional<parser> reading;
  response answer;
  std::optional<error> stopped; // why take_body has ended the parsing
  unsigned interim = 0;
  bool head_judged = false;
  bool needs_more = false; // what is in the buffer was looked at and is incomplete
  bool has_begun = false;
  bool wants_pause = false;
};

void response_reader::state::begin() {
  reading.emplace();
  reading->skip(rules.is_connect);
  reading->header_limit(max_head_bytes);
  reading->body_limit(boost::none); // ours counts what is taken, and says how much there may be
  reading->get().body() = [this](std::span<const std::byte> bytes, beast::error_code& stop) { take_body(bytes, stop); };
}

result<void> response_reader::state::too_large() {
  return failure(errc::body_too_large, "the body of the answer is longer than " + bytes_text(rules.max_body_bytes) +
                                           ", which is all that this request expects");
}

void response_reader::state::take_body(std::span<const std::byte> bytes, beast::error_code& stop) {
  if (is_success(answer.status))
    take_success(bytes);
  else
    take_error_page(bytes);
  if (stopped || answer.is_cut)
    stop = beast::http::error::body_limit;
}

void response_reader::state::take_success(std::span<const std::byte> bytes) {
  if (bytes.size() > rules.max_body_bytes - answer.body_bytes) {
    stopped = too_large().error();
    return;
  }
  answer.body_bytes += bytes.size();
  if (!rules.on_body)
    return keep(bytes);
  const auto flow = rules.on_body(bytes);
  wants_pause = wants_pause || flow == body_flow::pause;
  if (flow == body_flow::cancel)
    stopped = error{errc::cancelled, "whoever takes the body wants no more of it", {}};
}

void response_reader::state::take_error_page(std::span<const std::byte> bytes) {
  const auto fits = std::min<std::size_t>(bytes.size(), max_error_body_bytes - answer.body_bytes);
  answer.is_cut = fits < bytes.size();
  answer.body_bytes += fits;
  keep(bytes.first(fits));
}

void response_reader::state::keep(std::span<const std::byte> bytes) {
  answer.body.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

result<void> response_reader::state::head_is_done() {
  const auto status = reading->get().result_int();
  if (status == 101)
    return failure(errc::malformed, "the answer changes the protocol, which was not asked for");
  if (status < 200) {
    if (++interim > max_interim_answers)
      return failure(errc::malformed, "more than " + std::to_string(max_interim_answers) + " interim answers");
    begin();
    return {};
  }
  head_judged = true;
  answer.status = status;
  for (const auto& each : reading->get())
    answer.headers.push_back({std::string(each.name_string()), std::string(each.value())});
  if (rules.is_connect)
    return {};
  const auto length = reading->content_length_remaining();
  if (auto judged = judge_head(answer, rules.expected_content_type); !judged)
    return judged;
  const bool is_too_large = is_success(status) && !reading->is_done() && length && *length > rules.max_body_bytes;
  return is_too_large ? too_large() : result<void>{};
}

// What lies in the buffer is the beginning of a head, or of the head of a chunk.
result<void> response_reader::state::waiting_for_more() const {
  if (buffer.size() <= max_head_bytes)
    return {};
  if (!head_judged)
    return tl::make_unexpected(header_too_large());
  return failure(errc::malformed, "the head or the end of a chunk is longer than " + bytes_text(max_head_bytes));
}

result<void> response_reader::state::parse() {
  if (needs_more && head_judged && buffer.size() < shortest_last_chunk)
    return {};
  while (buffer.size() != 0 && !is_complete()) {
    beast::error_code code;
    buffer.consume(reading->put(buffer.data(), code));
    if (stopped)
      return tl::make_unexpected(*stopped);
    if (answer.is_cut)
      return {};
    needs_more = code == beast::http::error::need_more;
    if (needs_more)
      return waiting_for_more();
    if (code)
      return tl::make_unexpected(parse_error(code));
    if (!head_judged && reading->is_header_done())
      if (auto judged = head_is_done(); !judged)
        return judged;
  }
  return {};
}

response_reader::response_reader(reader_rules rules) : state_(std::make_unique<state>(std::move(rules))) {}
response_reader::~response_reader() = default;

result<void> response_reader::feed(std::span<const std::byte> bytes) {
  auto& s = *state_;
  s.has_begun = s.has_begun || !bytes.empty();
  const auto room = boost::asio::buffer(bytes.data(), bytes.size());
  s.buffer.commit(boost::asio::buffer_copy(s.buffer.prepare(bytes.size()), room));
  return s.parse();
}

result<void> response_reader::end_of_stream(bool is_proper) {
  auto& s = *state_;
  if (s.is_complete())
    return {};
  if (!s.has_begun)
    return failure(errc::connection_lost, "the service has closed the connection without an answer");
  const bool ends_by_closing = s.head_judged && s.reading->need_eof();
  if (!s.reading->got_some() || !ends_by_closing)
    return tl::make_unexpected(parse_error(beast::http::error::partial_message));
  if (!is_proper)
    return failure(errc::truncated, "the connection broke off, and nobody can tell whether the answer is complete");
  beast::error_code code;
  s.reading->put_eof(code);
  return code ? result<void>(tl::make_unexpected(parse_error(code))) : result<void>();
}

bool response_reader::is_complete() const { return state_->is_complete(); }
bool response_reader::has_begun() const { return state_->has_begun; }
bool response_reader::take_pause() { return std::exchange(state_->wants_pause, false); }

bool response_reader::can_be_kept() const {
  return is_complete() && !state_->answer.is_cut && state_->buffer.size() == 0 && !state_->reading->need_eof() &&
         state_->reading->keep_alive();
}

bool response_reader::has_leftover() const { return state_->buffer.size() != 0; }

response response_reader::take() { return std::move(state_->answer); }

} // namespace godwit::io::http
