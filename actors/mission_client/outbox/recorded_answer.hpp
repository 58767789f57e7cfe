// An answer of the service in the form in which the trace has it: a long body in parts, which a replay puts together.
// Thread: values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "actors/mission_client/planning_context.hpp"
#include "actors/mission_client/response_queue.hpp"
#include "io/fields/field_table.hpp"

namespace godwit::mission_client {

// An answer, and to which call.
struct service_news {
  std::optional<ticket> call; // none: nobody waits for it any more
  service_answer what;
};

struct recorded_answer {
  std::optional<ticket> call;
  std::uint8_t how = 0; // ending
  std::uint32_t status = 0;
  std::optional<std::int64_t> retry_after_ns;
  std::string error;
  std::uint32_t parts = 1; // the first one has all of the above
  std::string body;        // of this part
  GODWIT_FIELDS(recorded_answer, "mission_client.recorded_answer", call, how, status, retry_after_ns, error, parts,
                body);
};

// Below what the trace takes of a message.
inline constexpr std::size_t answer_part_bytes = std::size_t{48} * 1024;
// A longer body is one part, which the trace names by its size alone: a replay ends there.
inline constexpr std::size_t max_recorded_body_bytes = std::size_t{512} * 1024;

// The part that begins at FROM in the body, and FROM moved after it.
[[nodiscard]] recorded_answer next_part(const service_news& news, std::size_t& from);
[[nodiscard]] service_news news_of(recorded_answer first);

} // namespace godwit::mission_client
