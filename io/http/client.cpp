#include "io/http/client.hpp"

#include <atomic>
#include <deque>
#include <unordered_map>

#include <boost/asio/post.hpp>

#include "io/http/exchange.hpp"
#include "io/http/request_head.hpp"
#include "io/http/tls.hpp"
#include "io/link/io_thread.hpp"

namespace godwit::io::http {

namespace asio = boost::asio;

// All but the constructor, taken() and post() run in the thread.
class client::engine {
public:
  engine(settings wanted, destination to, std::unique_ptr<asio::ssl::context> tls)
      : parts_{thread_.context(), std::move(wanted), std::move(to), std::move(tls), {}} {
    thread_.start();
  }
  ~engine() {
    is_closing_ = true;
    // Again while there is something: a request that a callback sent just before may still be on its way to admit().
    do
      thread_.run_inside([this] { stop_all(); });
    while (places_taken_ != 0);
    thread_.stop();
  }
  engine(const engine&) = delete;
  engine& operator=(const engine&) = delete;

  [[nodiscard]] result<request_id> take(request asked, done then);
  template <class What>
  void post(What what) {
    asio::post(thread_.context(), std::move(what));
  }
  void with(request_id id, const std::function<void(exchange&)>& what);
  [[nodiscard]] client_counters counters() const { return parts_.counters.values(); }

private:
  void admit(request_id id, request asked, const done& then);
  void start_waiting();
  void ended(request_id id);
  void stop_all();
  [[nodiscard]] done counted(done then);

  link::io_thread thread_; // first, so that its context is there until all that uses it is gone
  shared_parts parts_;
  std::atomic<bool> is_closing_{false};
  std::atomic<std::size_t> places_taken_{0};
  std::atomic<request_id> last_id_{0};
  std::unordered_map<request_id, std::shared_ptr<exchange>> exchanges_; // waiting and under way
  std::deque<request_id> waiting_;
  std::size_t under_way_ = 0;
};

result<request_id> client::engine::take(request asked, done then) {
  const auto refuse = [this](error why) {
    parts_.counters.refused.add();
    return tl::make_unexpected(std::move(why));
  };
  if (is_closing_)
    return refuse({errc::closing, "the client is being closed", parts_.to.base.origin()});
  if (auto valid = check_request(asked, parts_.to); !valid)
    return refuse({valid.error().code, valid.error().what, parts_.to.base.origin()});
  if (places_taken_.fetch_add(1) >= parts_.set.max_under_way + parts_.set.max_waiting) {
    places_taken_.fetch_sub(1);
    return refuse({errc::too_many, "too many requests wait for the service: try again when some are done",
                   parts_.to.base.origin()});
  }
  parts_.counters.accepted.add();
  const auto id = ++last_id_;
  post([this, id, asked = std::move(asked), then = std::move(then)]() mutable { admit(id, std::move(asked), then); });
  return id;
}

client::done client::engine::counted(done then) {
  return [this, then = std::move(then)](result<response> end) {
    auto& counters = parts_.counters;
    (end ? counters.answered : counters.failed).add();
    if (!end && end.error().code == errc::cancelled)
      counters.cancelled.add();
    if (!end && (end.error().code == errc::connect_timeout || end.error().code == errc::read_timeout ||
                 end.error().code == errc::total_timeout))
      counters.timed_out.add();
    if (then)
      then(std::move(end));
  };
}

void client::engine::admit(request_id id, request asked, const done& then) {
  const auto made = std::make_shared<exchange>(parts_, std::move(asked), counted(then), [this, id] { ended(id); });
  exchanges_.emplace(id, made);
  waiting_.push_back(id);
  made->wait();
  start_waiting();
}

// Through the context, so that one that fails at once does not end within the end of another.
void client::engine::start_waiting() {
  while (!waiting_.empty() && under_way_ < parts_.set.max_under_way) {
    ++under_way_;
    post([next = exchanges_.at(waiting_.front())] { next->start(); });
    waiting_.pop_front();
  }
  parts_.counters.waiting = waiting_.size();
  parts_.counters.under_way = under_way_;
}

void client::engine::ended(request_id id) {
  exchanges_.erase(id);
  places_taken_.fetch_sub(1);
  if (std::erase(waiting_, id) == 0)
    --under_way_;
  start_waiting();
}

void client::engine::with(request_id id, const std::function<void(exchange&)>& what) {
  if (const auto found = exchanges_.find(id); found != exchanges_.end()) {
    const auto still_there = found->second;
    what(*still_there);
  }
}

void client::engine::stop_all() {
  while (!exchanges_.empty()) {
    const auto next = exchanges_.begin()->second;
    next->stop(errc::cancelled, "cancelled, because the client is being closed");
  }
}

client::client(std::unique_ptr<engine> running) : engine_(std::move(running)) {}
client::~client() = default;

result<std::unique_ptr<client>> client::open(settings wanted) {
  auto to = checked(wanted);
  if (!to)
    return tl::make_unexpected(to.error());
  std::unique_ptr<asio::ssl::context> tls;
  if (to->base.is_tls) {
    auto made = make_tls_context(wanted);
    if (!made)
      return tl::make_unexpected(made.error());
    tls = std::move(*made);
  }
  return std::unique_ptr<client>(
      new client(std::make_unique<engine>(std::move(wanted), std::move(*to), std::move(tls))));
}

result<request_id> client::send(request asked, done then) { return engine_->take(std::move(asked), std::move(then)); }

void client::cancel(request_id id) {
  engine_->post([engine = engine_.get(), id] {
    engine->with(id, [](exchange& each) { each.stop(errc::cancelled, "cancelled by the caller"); });
  });
}

void client::resume(request_id id) {
  engine_->post([engine = engine_.get(), id] { engine->with(id, [](exchange& each) { each.resume(); }); });
}

client_counters client::counters() const { return engine_->counters(); }

} // namespace godwit::io::http
