#include "runtime/ask_error.hpp"

#include <caf/all.hpp>

namespace godwit::runtime {

ask_error describe(const caf::error& why) {
  std::string text;
  if (why.context().match_elements<std::string>())
    text = why.context().get_as<std::string>(0);
  if (why == caf::sec::request_timeout)
    return {ask_errc::timeout, "no answer in time"};
  if (why == caf::sec::request_receiver_down)
    return {ask_errc::not_taken, text.empty() ? "the receiver has stopped" : text};
  if (why == caf::sec::unexpected_message)
    return {ask_errc::given_up, text};
  return {ask_errc::outcome_unknown, text.empty() ? to_string(why) : text};
}

} // namespace godwit::runtime
