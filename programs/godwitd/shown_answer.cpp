#include "programs/godwitd/shown_answer.hpp"

#include <string>

#include "programs/common/printable.hpp"

namespace godwit::daemon {

// As deep as control::ask_daemon reads.
nlohmann::json shown_answer(nlohmann::json answer) { // NOLINT(misc-no-recursion)
  if (answer.is_string())
    return programs::one_line(answer.get_ref<const std::string&>());
  if (answer.is_structured())
    for (auto& each : answer)
      each = shown_answer(std::move(each));
  return answer;
}

} // namespace godwit::daemon
