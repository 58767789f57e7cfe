// The first lines of an answer, and the answers that the server gives itself.
//
// Thread: pure. Source: RFC 9112, 4 and 6; RFC 9110, 15 (the reason phrases); RFC 9457 (problem documents).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/http/server/message.hpp"

namespace godwit::io::http {

// "Not Found"; of a status that is not known: empty.
[[nodiscard]] std::string_view reason_phrase(unsigned status);

// Without a body, whatever the client asked.
[[nodiscard]] bool has_no_body(unsigned status);

// BODY_BYTES: none when the body ends with the connection. What a header can not have, such as the end of a line, is
// written as a question mark: data must not write headers of its own.
[[nodiscard]] std::string response_head(const server_response& what, std::optional<std::uint64_t> body_bytes,
                                        bool is_last);

// DETAIL: a sentence of ours, without quotes and backslashes.
[[nodiscard]] server_response problem_response(unsigned status, std::string_view detail);

} // namespace godwit::io::http
