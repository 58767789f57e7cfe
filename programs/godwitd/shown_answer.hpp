// What the running godwitd answers, before a person is shown it: every text in it is one line without effects. Names,
// reasons and sentences in it came from strangers, stations and services. Thread: pure.
#pragma once

#include <nlohmann/json.hpp>

namespace godwit::daemon {

[[nodiscard]] nlohmann::json shown_answer(nlohmann::json answer);

} // namespace godwit::daemon
