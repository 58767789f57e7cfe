// The first lines of a request as they go to the service, and what is refused there.
//
// A line end in a target or header would let data write headers of its own; so each part is checked first.
//
// Errors: invalid_request. Thread: any, pure. Source: RFC 9112, 3 and 5; RFC 9110, 5 and 9.3.6 (CONNECT); RFC 6750.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "io/http/error.hpp"
#include "io/http/message.hpp"
#include "io/http/secret_file.hpp"
#include "io/http/settings.hpp"

namespace godwit::io::http {

inline constexpr std::size_t max_target_bytes = 4 * 1024;
inline constexpr std::size_t max_request_head_bytes = 16 * 1024; // besides the token
// Requests that wait hold their bodies in memory, so a long list is sent in parts; the longest mission fits.
inline constexpr std::size_t max_request_body_bytes = 16 * 1024 * 1024;

[[nodiscard]] result<void> check_request(const request& asked, const destination& to);

// Of a request that was checked. Over plain HTTP with a proxy the target is the whole URL. TOKEN may be empty.
[[nodiscard]] secret_text request_head(const request& asked, const destination& to, std::string_view token);

// Asks the proxy for a way to the service. The token is none of its business.
[[nodiscard]] std::string connect_head(const destination& to);

} // namespace godwit::io::http
