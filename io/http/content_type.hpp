// Whether a Content-Type is the one that was expected.
//
// Thread: any, pure. Source: RFC 9110, 8.3 (media type, parameters); RFC 6839 (+json).
#pragma once

#include <string_view>

namespace godwit::io::http {

// "application/json" for "Application/JSON; charset=utf-8". Of what is no media type: empty.
[[nodiscard]] std::string_view media_type(std::string_view content_type);

// Type and subtype agree in any case, and the character set, where there is one, is UTF-8. Other parameters are not
// looked at.
[[nodiscard]] bool has_content_type(std::string_view content_type, std::string_view expected);

// application/json, and what ends in +json, such as application/geo+json and application/problem+json.
[[nodiscard]] bool is_json(std::string_view content_type);

} // namespace godwit::io::http
