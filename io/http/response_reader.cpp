#include "io/http/response_reader.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "io/http/content_coding.hpp"
#include "io/http/incremental_parser.hpp"
#include "io/http/message.hpp"

namespace godwit::io::http {

namespace {

namespace beast = boost::beast;

// A head or the head of a chunk that is not complete yet, and what one read brings.
constexpr std::size_t buffer_bytes = max_head_bytes + read_piece_bytes;

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
  explicit state(reader_rules given) : rules(std::move(given)) { begin(); }

  void begin();
  void take_body(std::span<const std::byte> bytes, beast::error_code& stop);
  void take_plain(std::span<const std::byte> bytes);
  void unpack(std::span<const std::byte> bytes);
  [[nodiscard]] result<void> check_end() const;
  void take_success(std::span<const std::byte> bytes);
  void take_error_page(std::span<const std::byte> bytes);
  void keep(std::span<const std::byte> bytes);
  [[nodiscard]] bool is_complete() const { return answer.is_cut || (head_judged && reading.current().is_done()); }
  [[nodiscard]] result<void> parse();
  [[nodiscard]] result<void> head_is_done();
  [[nodiscard]] result<void> waiting_for_more() const;
  [[nodiscard]] result<void> too_large();

  reader_rules rules;
  incremental_parser<false> reading{buffer_bytes};
  response answer;
  std::optional<error> stopped; // why take_body has ended the parsing
  std::optional<content_decoder> decoder;
  std::size_t packed_bytes = 0; // of the body, as they came
  unsigned interim = 0;
  bool head_judged = false;
  bool has_begun = false;
  bool wants_pause = false;
};

void response_reader::state::begin() {
  reading
      .begin(max_head_bytes,
             [this](std::span<const std::byte> bytes, beast::error_code& stop) { take_body(bytes, stop); })
      .skip(rules.is_connect);
}

result<void> response_reader::state::too_large() {
  return failure(errc::body_too_large, "the body of the answer is longer than " + bytes_text(rules.max_body_bytes) +
                                           ", which is all that this request expects");
}

void response_reader::state::take_body(std::span<const std::byte> bytes, beast::error_code& stop) {
  if (decoder)
    unpack(bytes);
  else
    take_plain(bytes);
  if (stopped || answer.is_cut)
    stop = beast::http::error::body_limit;
}

void response_reader::state::take_plain(std::span<const std::byte> bytes) {
  if (is_success(answer.status))
    take_success(bytes);
  else
    take_error_page(bytes);
}

// Bytes that unpack to nothing could come for ever, so they are bounded as well.
void response_reader::state::unpack(std::span<const std::byte> bytes) {
  packed_bytes += bytes.size();
  if (packed_bytes > std::max(rules.max_body_bytes, max_error_body_bytes)) {
    stopped = too_large().error();
    return;
  }
  const auto unpacked = decoder->feed(bytes, [this](std::span<const std::byte> piece) {
    take_plain(piece);
    return !stopped && !answer.is_cut;
  });
  if (!unpacked && !stopped)
    stopped = unpacked.error();
}

result<void> response_reader::state::check_end() const {
  if (decoder && !decoder->is_complete() && !answer.is_cut && is_complete())
    return failure(errc::truncated, "the compressed answer ends in the middle");
  return {};
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
  auto& parser = reading.current();
  const auto status = parser.get().result_int();
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
  for (const auto& each : parser.get())
    answer.headers.push_back({std::string(each.name_string()), std::string(each.value())});
  if (rules.is_connect)
    return {};
  const auto length = parser.content_length_remaining();
  if (auto judged = judge_head(answer, rules.expected_content_type, rules.accepts_compressed); !judged)
    return judged;
  if (const auto coding = parse_coding(answer.find("Content-Encoding")))
    decoder.emplace(*coding);
  if (is_success(status) && !parser.is_done() && length && *length > rules.max_body_bytes)
    return too_large();
  if (is_success(status) && rules.on_head)
    rules.on_head(answer);
  return {};
}

// What lies in the buffer is the beginning of a head, or of the head of a chunk.
result<void> response_reader::state::waiting_for_more() const {
  if (reading.unread_bytes() <= max_head_bytes)
    return {};
  if (!head_judged)
    return tl::make_unexpected(header_too_large());
  return failure(errc::malformed, "the head or the end of a chunk is longer than " + bytes_text(max_head_bytes));
}

result<void> response_reader::state::parse() {
  while (reading.unread_bytes() != 0 && !is_complete()) {
    const auto code = reading.step();
    if (stopped)
      return tl::make_unexpected(*stopped);
    if (answer.is_cut)
      return {};
    if (code == beast::http::error::need_more)
      return waiting_for_more();
    if (code)
      return tl::make_unexpected(parse_error(code));
    if (!head_judged && reading.current().is_header_done())
      if (auto judged = head_is_done(); !judged)
        return judged;
  }
  return check_end();
}

response_reader::response_reader(reader_rules rules) : state_(std::make_unique<state>(std::move(rules))) {}
response_reader::~response_reader() = default;

result<void> response_reader::feed(std::span<const std::byte> bytes) {
  auto& s = *state_;
  s.has_begun = s.has_begun || !bytes.empty();
  s.reading.feed(bytes);
  return s.parse();
}

result<void> response_reader::end_of_stream(bool is_proper) {
  auto& s = *state_;
  if (s.is_complete())
    return {};
  if (!s.has_begun)
    return failure(errc::connection_lost, "the service has closed the connection without an answer");
  const bool ends_by_closing = s.head_judged && s.reading.current().need_eof();
  if (!s.reading.current().got_some() || !ends_by_closing)
    return tl::make_unexpected(parse_error(beast::http::error::partial_message));
  if (!is_proper)
    return failure(errc::truncated, "the connection broke off, and nobody can tell whether the answer is complete");
  beast::error_code code;
  s.reading.current().put_eof(code);
  return code ? result<void>(tl::make_unexpected(parse_error(code))) : s.check_end();
}

bool response_reader::is_complete() const { return state_->is_complete(); }
bool response_reader::has_begun() const { return state_->has_begun; }
bool response_reader::take_pause() { return std::exchange(state_->wants_pause, false); }

bool response_reader::can_be_kept() const {
  const auto& parser = state_->reading.current();
  return is_complete() && !state_->answer.is_cut && !has_leftover() && !parser.need_eof() && parser.keep_alive();
}

bool response_reader::has_leftover() const { return state_->reading.unread_bytes() != 0; }

response response_reader::take() { return std::move(state_->answer); }

namespace {

constexpr std::size_t longest_quote = 200;
constexpr unsigned not_modified = 304;

bool is_redirect(unsigned status) { return status >= 300 && status <= 399 && status != not_modified; }

result<void> judge_coding(const response& head, bool accepts_compressed) {
  for (const auto& each : head.headers) {
    const bool is_content = equals_ignoring_case(each.name, "Content-Encoding");
    const bool is_plain = each.value.empty() || equals_ignoring_case(each.value, "identity");
    if (is_content && !is_plain && !(accepts_compressed && parse_coding(each.value)))
      return failure(errc::encoded, "the answer is compressed (" + quotable(each.value) + ") though " +
                                        (accepts_compressed ? std::string(accepted_codings) + " alone were"
                                                            : std::string("only plain bytes were")) +
                                        " asked for; switch compression off there");
    if (equals_ignoring_case(each.name, "Transfer-Encoding") && !equals_ignoring_case(each.value, "chunked"))
      return failure(errc::encoded, "the answer has a transfer coding that was not asked for: " + quotable(each.value));
  }
  return {};
}

} // namespace

std::string quotable(std::string_view foreign) {
  std::string text;
  for (const char c : foreign.substr(0, foreign.find_first_of("?#"))) {
    if (text.size() == longest_quote)
      return text + "...";
    text += c >= ' ' && c < '\x7f' ? c : '?';
  }
  return text;
}

result<void> judge_head(const response& head, std::string_view expected_content_type, bool accepts_compressed) {
  if (is_redirect(head.status)) {
    const auto target = quotable(head.find("Location"));
    return failure(errc::redirect, "answered " + std::to_string(head.status) + ": it is to be found at " +
                                       (target.empty() ? "a place that is not named" : target) +
                                       "; redirects are not followed: set the URL to the right place");
  }
  if (auto coding = judge_coding(head, accepts_compressed); !coding)
    return coding;
  const auto type = head.find("Content-Type");
  const bool has_body = head.status >= 200 && head.status <= 299 && head.status != 204;
  if (has_body && !expected_content_type.empty() && !has_content_type(type, expected_content_type))
    return failure(errc::wrong_content_type, "answered with " + (type.empty() ? "no content type" : quotable(type)) +
                                                 ", and not with " + std::string(expected_content_type) +
                                                 ": is this the URL of the service?");
  return {};
}

} // namespace godwit::io::http
