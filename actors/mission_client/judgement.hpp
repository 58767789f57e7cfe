// What an answer of the service means: docs/missions-service.md, section 7, as a table. Thread: pure.
#pragma once

#include <string>

#include "actors/mission_client/response_queue.hpp"

namespace godwit::mission_client {

enum class judgement {
  success,       // 2xx
  transient,     // no answer, 408, 429, 5xx: the same again, later
  not_allowed,   // 401, 403: not again until a person says so
  not_found,     // 404: no such mission, or a mistyped address
  gone,          // 410
  conflict,      // 409: meant for another state
  wrong,         // 400, 413, 422 and all others: the request is wrong
  misconfigured, // TLS, a redirect, the token file
  bad_answer,    // not what the contract says
};

[[nodiscard]] judgement judge(const service_answer& answer);

// What a person has to know of an answer that is no success: the status and what the service says about it, or why
// there was none. At most max_error_text bytes.
[[nodiscard]] std::string sentence_of(const service_answer& answer);

} // namespace godwit::mission_client
