// Where the rows of the audit are read, for those who show them. Thread: any; THEN in any, at once or later, once.
#pragma once

#include <functional>
#include <string>

#include <tl/expected.hpp>

#include "messages/operator_bridge/audit.hpp"

namespace godwit {

using audit_page_or_why = tl::expected<operator_bridge::audit_page, std::string>; // why not: a sentence for people
using audit_source =
    std::function<void(const operator_bridge::audit_query& wanted, std::function<void(const audit_page_or_why&)> then)>;

} // namespace godwit
