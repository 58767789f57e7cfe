#include "programs/godwitd/operator_port/waiting_answers.hpp"

#include <utility>
#include <vector>

#include "io/http/server/response_head.hpp"

namespace godwit::operator_port {

using io::http::problem_response;

std::optional<std::uint64_t> waiting_answers::add(io::http::responder answer, io::http::secret_text new_token,
                                                  std::weak_ptr<io::http::client_place> place) {
  return put({std::move(answer), std::move(new_token), {}, {}, std::move(place)});
}

std::optional<std::uint64_t> waiting_answers::add(io::http::responder answer,
                                                  std::function<void(io::http::responder)> then,
                                                  std::weak_ptr<io::http::client_place> place) {
  return put({std::move(answer), {}, {}, std::move(then), std::move(place)});
}

void waiting_answers::prove(std::uint64_t ticket, const std::string& session) {
  std::unique_lock lock(mutex_);
  const auto found = waiting_.find(ticket);
  const auto place = found == waiting_.end() ? nullptr : found->second.place.lock();
  lock.unlock();
  if (place)
    place->prove(session);
}

std::optional<std::uint64_t> waiting_answers::put(waiting one) {
  give_up_overdue();
  {
    const std::lock_guard guard(mutex_);
    if (waiting_.size() < max_waiting && !has_ended_) {
      one.until = std::chrono::steady_clock::now() + patience;
      waiting_.emplace(++last_ticket_, std::move(one));
      return last_ticket_;
    }
  }
  one.answer.send(problem_response(503, "too many requests wait for an answer; ask again in a moment"));
  return std::nullopt;
}

// RFC 6265, 4.1: with Secure a browser sends it by TLS alone.
std::string waiting_answers::cookie_of(std::string_view token, bool ends) const {
  return "godwit_session=" + std::string(token) + "; Path=/; HttpOnly; SameSite=Strict" +
         (is_secure_ ? "; Secure" : "") + (ends ? "; Max-Age=0" : "");
}

void waiting_answers::resolve(std::uint64_t ticket, io::http::server_response what, cookie with) {
  std::unique_lock lock(mutex_);
  auto found = waiting_.extract(ticket);
  lock.unlock();
  if (found.empty())
    return;
  auto& each = found.mapped();
  if (with != cookie::none)
    what.headers.push_back({"Set-Cookie", cookie_of(each.new_token.revealed(), with == cookie::ends_session)});
  each.answer.send(std::move(what));
}

void waiting_answers::let_go_on(std::uint64_t ticket) {
  std::unique_lock lock(mutex_);
  auto found = waiting_.extract(ticket);
  lock.unlock();
  if (!found.empty())
    found.mapped().then(std::move(found.mapped().answer));
}

void waiting_answers::end() {
  std::map<std::uint64_t, waiting> all;
  {
    const std::lock_guard guard(mutex_);
    has_ended_ = true;
    all = std::exchange(waiting_, {});
  }
  for (auto& [ticket, each] : all)
    each.answer.send(problem_response(503, "godwit ends"));
}

void waiting_answers::give_up_overdue() {
  std::vector<std::uint64_t> overdue;
  {
    const std::lock_guard guard(mutex_);
    const auto now = std::chrono::steady_clock::now();
    for (const auto& [ticket, each] : waiting_)
      if (each.until <= now)
        overdue.push_back(ticket);
  }
  for (const auto ticket : overdue)
    resolve(ticket, problem_response(504, "no answer came in time; check the status before you send it again"));
}

} // namespace godwit::operator_port
