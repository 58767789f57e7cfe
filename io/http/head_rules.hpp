// What is refused of an answer before its body is looked at.
//
// Errors: redirect, encoded, wrong_content_type, malformed. Thread: any, pure. Source: RFC 9110, 8.4 and 15.4.
#pragma once

#include <string>
#include <string_view>

#include "io/http/error.hpp"
#include "io/http/message.hpp"

namespace godwit::io::http {

[[nodiscard]] result<void> judge_head(const response& head, std::string_view expected_content_type);

// What a service wrote, fit for a sentence: printable, not too long, and without a query, in which a secret may stand.
[[nodiscard]] std::string quotable(std::string_view foreign);

} // namespace godwit::io::http
