// Requests that wait for their answer, over the incarnations of the actor.
#include <algorithm>
#include <utility>

#include "runtime/address/stable_address.hpp"

namespace godwit::runtime {

void stable_address::requester::fail(caf::error why) const {
  if (who && mid.is_request()) // a tell has nobody who waits
    who->enqueue(nullptr, mid.response_id(), caf::make_message(std::move(why)), nullptr);
}

caf::error stable_address::is_down() const {
  return caf::make_error(caf::sec::request_receiver_down, options_.name + " takes no more messages");
}

void stable_address::answer_failure(const requester& r, caf::sec code, const std::string& what) const {
  r.fail(caf::make_error(code, options_.name + ' ' + what));
}

bool stable_address::expect_answer(std::uint64_t message_id, requester r) {
  {
    const std::unique_lock guard(mutex_);
    if (waiting_answers_.size() < max_waiting_answers) {
      waiting_answers_[message_id] = {std::move(r), incarnation_.load(std::memory_order_relaxed)};
      return true;
    }
    ++counters_.refused;
  }
  r.fail(is_down());
  return false;
}

stable_address::requester stable_address::take_requester(std::uint64_t message_id) {
  const std::unique_lock guard(mutex_);
  const auto found = waiting_answers_.find(message_id);
  if (found == waiting_answers_.end())
    return {};
  auto result = std::move(found->second.from);
  waiting_answers_.erase(found);
  return result;
}

std::optional<caf::message_id> stable_address::awaited_mid(std::uint64_t message_id) const {
  const std::shared_lock guard(mutex_);
  const auto found = waiting_answers_.find(message_id);
  return found == waiting_answers_.end() ? std::nullopt : std::optional(found->second.from.mid);
}

void stable_address::give_up_answers(const std::vector<std::uint64_t>& keep, std::uint64_t incarnation) {
  std::vector<requester> abandoned;
  {
    const std::unique_lock guard(mutex_);
    for (auto each = waiting_answers_.begin(); each != waiting_answers_.end();) {
      if (each->second.incarnation > incarnation || std::find(keep.begin(), keep.end(), each->first) != keep.end()) {
        ++each;
        continue;
      }
      abandoned.push_back(std::move(each->second.from));
      each = waiting_answers_.erase(each);
    }
  }
  for (const auto& each : abandoned)
    each.fail(caf::make_error(caf::sec::runtime_error,
                              options_.name + " crashed before it answered; whether it acted is not known"));
}

} // namespace godwit::runtime
