// Lets frames through whose signature is right, and says of the others why not: a sentence for the first of each
// cause, and their number at the end.
//
// Without a key everything passes, signed or not. The rules are those of io/mavlink/signing/verifier.hpp. Thread: one
// at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/mavlink/signing/verifier.hpp"
#include "programs/godwit-trace/traffic.hpp"

namespace godwit::trace_tool {

class signature_check {
public:
  explicit signature_check(std::optional<io::mavlink::secret_key> key);

  // What became of FRAME, and what is to be said about it, if anything.
  struct answer {
    bool is_accepted = true;
    std::string sentence;
  };
  [[nodiscard]] answer judge(const io::mavlink::frame_view& frame, std::uint64_t time_us);

  // Refused frames by cause; without a key there are no causes.
  [[nodiscard]] std::vector<skipped> refused() const;

private:
  std::unique_ptr<io::mavlink::replay_table> streams_; // stays where it is: the verifier knows it by address
  io::mavlink::verifier verifier_;
};

} // namespace godwit::trace_tool
