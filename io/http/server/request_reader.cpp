#include "io/http/server/request_reader.hpp"

#include <algorithm>
#include <utility>

#include "io/http/incremental_parser.hpp"

namespace godwit::io::http {
namespace {

namespace beast = boost::beast;

std::string text_of(beast::string_view view) { return {view.data(), view.size()}; }

// Where such a line stands twice, two readers may believe different ones: RFC 9112, 3.2, for Host.
constexpr std::string_view standing_once[] = {"Host", "Origin", "Authorization", "Content-Type"};

std::string_view doubled_line(const server_request& made) {
  for (const auto name : standing_once)
    if (std::ranges::count_if(made.headers, [&](const auto& each) { return equals_ignoring_case(each.name, name); }) >
        1)
      return name;
  return {};
}

} // namespace

struct request_reader::state {
  state(const server_settings& wanted, const body_limit& limits)
      : set(wanted), limit(limits), reading(wanted.max_head_bytes + 2 * read_bytes) {
    begin();
  }

  void begin();
  progress refuse(unsigned status, std::string sentence);
  progress too_large();
  progress judge_head();
  progress refuse_as(const beast::error_code& code);
  progress parse();

  const server_settings& set;
  const body_limit& limit;
  incremental_parser<true> reading;
  server_request made; // its head as it came before the body: what stands after a chunked body is not looked at
  request_refusal refused;
  std::size_t max_body = 0;
  std::size_t head_bytes = 0; // read of it so far
  bool head_judged = false;
  bool wants_continue = false;
};

void request_reader::state::begin() {
  made = {};
  head_bytes = 0;
  head_judged = false;
  wants_continue = false;
  reading.begin(set.max_head_bytes, [this](std::span<const std::byte> bytes, beast::error_code& stop) {
    if (bytes.size() > max_body - made.body.size())
      stop = beast::http::error::body_limit;
    else
      made.body.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  });
}

progress request_reader::state::refuse(unsigned status, std::string sentence) {
  refused = {status, std::move(sentence)};
  return progress::refused;
}

progress request_reader::state::too_large() { return refuse(413, "Up to " + std::to_string(max_body) + " bytes."); }

// The parser is lax about the length of a head that comes in one piece.
progress request_reader::state::judge_head() {
  head_judged = true;
  if (head_bytes > set.max_head_bytes)
    return refuse_as(beast::http::error::header_limit);
  auto& parser = reading.current();
  const auto& head = parser.get();
  made.method = text_of(head.method_string());
  made.target = text_of(head.target());
  for (const auto& each : head)
    made.headers.push_back({text_of(each.name_string()), text_of(each.value())});
  if (const auto twice = doubled_line(made); !twice.empty())
    return refuse(400, "There is more than one line " + std::string(twice) + ".");
  if (made.target.size() > set.max_target_bytes)
    return refuse(414, "The target has up to " + std::to_string(set.max_target_bytes) + " bytes.");
  max_body = limit ? std::min(set.max_body_bytes, limit(made.method, made.target)) : set.max_body_bytes;
  if (const auto length = parser.content_length(); length && *length > max_body)
    return too_large();
  wants_continue = !parser.is_done() && equals_ignoring_case(made.find("Expect"), "100-continue");
  return progress::more;
}

progress request_reader::state::refuse_as(const beast::error_code& code) {
  if (code == beast::http::error::header_limit)
    return refuse(431, "The head of a request has up to " + std::to_string(set.max_head_bytes) + " bytes.");
  if (code == beast::http::error::body_limit)
    return too_large();
  return refuse(400, "This is not HTTP: " + code.message() + ".");
}

progress request_reader::state::parse() {
  const auto& parser = reading.current();
  while (reading.unread_bytes() != 0 && !parser.is_done()) {
    const auto before = reading.unread_bytes();
    const auto code = reading.step();
    head_bytes += head_judged ? 0 : before - reading.unread_bytes();
    if (code == beast::http::error::need_more) // what is unread is the beginning of a head, or of that of a chunk
      return reading.unread_bytes() > set.max_head_bytes ? refuse_as(beast::http::error::header_limit) : progress::more;
    if (code)
      return refuse_as(code);
    if (!head_judged && parser.is_header_done() && judge_head() == progress::refused)
      return progress::refused;
  }
  return parser.is_done() ? progress::complete : progress::more;
}

request_reader::request_reader(const server_settings& set, const body_limit& limit)
    : state_(std::make_unique<state>(set, limit)) {}
request_reader::~request_reader() = default;

progress request_reader::feed(std::span<const std::byte> bytes) {
  state_->reading.feed(bytes);
  return state_->parse();
}

progress request_reader::next() {
  state_->begin();
  return state_->parse();
}

server_request request_reader::take() { return std::move(state_->made); }
const request_refusal& request_reader::refusal() const { return state_->refused; }

bool request_reader::can_be_kept() const {
  const auto& parser = state_->reading.current();
  return parser.is_done() && parser.keep_alive() && parser.get().version() >= 11;
}

bool request_reader::has_begun() const { return !unread().empty() || state_->reading.current().got_some(); }
bool request_reader::has_head() const { return state_->head_judged; }
std::size_t request_reader::body_bytes() const { return state_->made.body.size(); }
std::string_view request_reader::unread() const { return state_->reading.unread(); }
bool request_reader::take_continue() { return std::exchange(state_->wants_continue, false); }

} // namespace godwit::io::http
