// Pages that programs write for people: one file, no script, nothing from elsewhere, so that they are shown the same in
// ten years and on a machine without a network. Thread: any.
#pragma once

#include <string>
#include <string_view>

namespace godwit::programs {

// From the doctype to the begin of the body, with the style that all pages have. TITLE is text.
[[nodiscard]] std::string html_head(std::string_view title);
// TEXT for between tags and in attributes.
[[nodiscard]] std::string html_escaped(std::string_view text);

} // namespace godwit::programs
