#include "actors/mission_client/settings.hpp"

namespace godwit::mission_client {

namespace {

constexpr int most_tries = 20;                     // with pauses of up to 5 min that is more than an hour
constexpr std::chrono::seconds longest_poll{120};  // what routers on the way let live
constexpr std::uint32_t most_rows_of_page = 2'000; // the contract's bounds
constexpr std::uint32_t most_rows_of_batch = 500;

} // namespace

std::optional<std::string> objection_to(const settings& given) {
  if (given.max_tries < 1 || given.max_tries > most_tries)
    return "max_tries is " + std::to_string(given.max_tries) + "; allowed: 1 to " + std::to_string(most_tries);
  if (given.call_timeout.count() <= 0 || given.total_timeout < given.call_timeout)
    return "the time-outs have to be above 0, and total_timeout at least as long as call_timeout";
  if (given.poll_wait.count() < 1 || given.poll_wait > longest_poll)
    return "poll_wait is " + std::to_string(given.poll_wait.count()) + " s; allowed: 1 to " +
           std::to_string(longest_poll.count());
  if (given.page_limit < 1 || given.page_limit > most_rows_of_page)
    return "page_limit is " + std::to_string(given.page_limit) + "; allowed: 1 to " + std::to_string(most_rows_of_page);
  if (given.batch_limit < 1 || given.batch_limit > most_rows_of_batch)
    return "batch_limit is " + std::to_string(given.batch_limit) + "; allowed: 1 to " +
           std::to_string(most_rows_of_batch);
  return std::nullopt;
}

} // namespace godwit::mission_client
