// What every importer is told and gives back. Thread: plain values.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "actors/domain/mission/convert/loss.hpp"
#include "actors/domain/mission/error.hpp"
#include "messages/mission/document.hpp"

namespace godwit::mission {

struct import_options {
  bool allow_partial = false;            // take what can be taken; else a loss is an error
  std::optional<std::string> mission_id; // UUID; absent: made from the text, so that a file always has the same
};

struct imported {
  document mission;
  loss_list losses; // empty unless allow_partial
};

struct exported {
  std::string text;
  loss_list losses;
};

struct conversion_error {
  document_error error;
  loss_list losses; // when the code is `lossy`, and what was noticed before another error

  [[nodiscard]] std::string message() const;
};

using import_result = tl::expected<imported, conversion_error>;

// The last step of every importer: MISSION if it keeps all rules and nothing was lost, or what stands in the way.
[[nodiscard]] import_result finished(const document& mission, loss_list losses, const import_options& options,
                                     std::string_view source);

// A UUID of version 8 (RFC 9562) that is always the same for the same text.
[[nodiscard]] std::string uuid_of_text(std::string_view text);

[[nodiscard]] conversion_error lossy(loss_list losses, std::string_view source);

} // namespace godwit::mission
