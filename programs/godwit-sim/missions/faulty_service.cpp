#include "programs/godwit-sim/missions/faulty_service.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <boost/asio/steady_timer.hpp>

#include "programs/godwit-sim/missions/exchange.hpp"

namespace godwit::sim::missions {

taken_call faulty_service::take(request asked) {
  const auto where = endpoint_of(asked);
  return {std::move(asked), where, faults_->hit_by_call(where)};
}

std::variant<delivery, waiting> faulty_service::answer_to(const taken_call& call, std::int64_t now_ns,
                                                          patience how_long) {
  delivery made;
  if (std::ranges::none_of(call.hits, keeps_from_service)) {
    auto given = service_->handle(call.asked, now_ns, how_long);
    if (const auto* poll = std::get_if<waiting>(&given))
      return *poll;
    made.what = std::get<answer>(std::move(given));
  }
  for (const auto& each : call.hits)
    apply(each, made);
  if (made.is_lost)
    ++lost_;
  else
    ++answers_[call.where][made.what.status];
  return made;
}

void faulty_service::count_into(service_figures& to) const {
  to.answers = answers_;
  to.lost = lost_;
}

namespace {

constexpr unsigned ok = 200;

// After the first { of the body. An error may have any form, so only successes are touched.
void put_property(delivery& to, std::string_view property) {
  auto& body = to.what.body;
  if (to.what.status != ok || body.empty() || body.front() != '{')
    return;
  body.insert(1, std::string(property) + (body.starts_with("{}") ? "" : ","));
}

struct effect {
  delivery& to;

  void operator()(const fault::refuse&) const {}
  void operator()(const fault::wrong_host&) const {}
  void operator()(const fault::drop&) const { to.is_lost = true; }
  void operator()(const fault::status& what) const {
    to.what = problem_answer(what.code, "A fault that was asked for.");
    if (what.retry_after_s)
      to.what.headers.push_back({"Retry-After", std::to_string(*what.retry_after_s)});
  }
  void operator()(const fault::lose&) const { to.is_lost = true; }
  void operator()(const fault::delay& what) const { to.delay += what.time; }
  void operator()(const fault::slow& what) const { to.bytes_per_s = what.bytes_per_s; }
  void operator()(const fault::reset&) const { to.cut_after = to.what.body.size() / 2; }
  void operator()(const fault::content_type& what) const { to.what.content_type = what.text; }
  void operator()(const fault::truncate&) const { to.what.body.resize(to.what.body.size() / 2); }
  void operator()(const fault::huge&) const { to.padding = huge_body_bytes - to.what.body.size(); }
  void operator()(const fault::schema&) const { put_property(to, R"("what_nobody_knows":true)"); }
  void operator()(const fault::version&) const {
    constexpr std::string_view key = R"("schema_version":")";
    auto& body = to.what.body;
    const auto found = body.find(key);
    if (found == std::string::npos)
      return put_property(to, R"("schema_version":"3.0.0")");
    const auto begin = found + key.size();
    body.replace(begin, body.find('"', begin) - begin, "3.0.0");
  }
};

} // namespace

bool keeps_from_service(const fault::any& what) {
  if (const auto* status = std::get_if<fault::status>(&what))
    return !status->is_committed;
  return std::holds_alternative<fault::drop>(what);
}

void apply(const fault::any& what, delivery& to) { std::visit(effect{to}, what); }

namespace {

namespace asio = boost::asio;

constexpr std::size_t space_bytes = 64 * 1024; // of padding, at a time
constexpr std::uint64_t pieces_a_second = 10;  // of a slow answer

// Kept by whatever it waits for.
class faulty_delivery : public std::enable_shared_from_this<faulty_delivery> {
public:
  faulty_delivery(asio::io_context& io, io::http::responder to, delivery what)
      : timer_(io), to_(std::move(to)), what_(std::move(what)) {}

  void start() {
    if (what_.delay.count() == 0)
      return begin();
    wait(what_.delay, &faulty_delivery::begin);
  }

private:
  void wait(std::chrono::nanoseconds time, void (faulty_delivery::*then)()) {
    timer_.expires_after(time);
    timer_.async_wait([self = shared_from_this(), then](const boost::system::error_code& cancelled) {
      if (!cancelled)
        ((*self).*then)();
    });
  }

  void begin() {
    if (what_.is_lost)
      return to_.abort();
    if (what_.bytes_per_s == 0 && !what_.cut_after && what_.padding == 0)
      return to_.send(std::move(what_.what));
    rest_ = std::exchange(what_.what.body, {});
    const auto size = rest_.size() + what_.padding;
    if (what_.cut_after) {
      rest_.resize(*what_.cut_after);
      what_.padding = 0;
    }
    to_.start(what_.what, size, [self = shared_from_this()] { self->go_on(); });
  }

  void go_on() {
    if (rest_.empty() && what_.padding != 0) {
      rest_.assign(std::min<std::uint64_t>(space_bytes, what_.padding), ' ');
      what_.padding -= rest_.size();
    }
    if (rest_.empty())
      return what_.cut_after ? to_.abort() : to_.finish();
    const auto slow = what_.bytes_per_s;
    const auto size = slow == 0 ? rest_.size() : std::max<std::size_t>(1, slow / pieces_a_second);
    auto piece = rest_.substr(0, size);
    rest_.erase(0, size);
    to_.write(std::move(piece), [self = shared_from_this()] { self->have_written(); });
  }

  void have_written() {
    if (what_.bytes_per_s == 0)
      return go_on();
    // Fewer bytes a second than pieces: a byte at a time, and longer pauses.
    const auto pieces = std::min(pieces_a_second, what_.bytes_per_s);
    wait(std::chrono::nanoseconds(std::chrono::seconds(1)) / pieces, &faulty_delivery::go_on);
  }

  asio::steady_timer timer_;
  io::http::responder to_;
  delivery what_;
  std::string rest_; // of the body, and then of the padding
};

} // namespace

void deliver(asio::io_context& io, io::http::responder to, delivery what) {
  std::make_shared<faulty_delivery>(io, std::move(to), std::move(what))->start();
}

} // namespace godwit::sim::missions
