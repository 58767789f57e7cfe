#include "programs/godwit-trace/signature_check.hpp"

#include <utility>

#include "programs/godwit-trace/message_name.hpp"

namespace godwit::trace_tool {

namespace {

using io::mavlink::verdict;

struct cause {
  verdict which;
  std::string_view key;
  std::string_view words; // of one, and of many
  std::string_view why;
};

constexpr cause causes[] = {
    {verdict::bad_signature, "refused_bad_signature", "frames with a wrong signature",
     "its signature is wrong: another key, or changed on the way"},
    {verdict::replayed, "refused_replayed", "replayed frames", "its timestamp is not above the last one: replayed"},
    {verdict::too_old, "refused_too_old", "signed frames from the past",
     "its timestamp is more than a minute old; are both clocks right?"},
    {verdict::too_new, "refused_too_new", "signed frames from the future",
     "its timestamp is more than two minutes ahead; are both clocks right?"},
    {verdict::unsigned_refused, "refused_unsigned", "unsigned frames", "it is not signed"},
    {verdict::too_many_streams, "refused_too_many_streams", "frames of too many signed streams",
     "there are too many signed senders and links"},
};

const cause* cause_of(verdict which) {
  for (const auto& each : causes)
    if (each.which == which)
      return &each;
  return nullptr;
}

} // namespace

signature_check::signature_check(std::optional<io::mavlink::secret_key> key)
    : streams_(std::make_unique<io::mavlink::replay_table>()),
      verifier_(key ? io::mavlink::verifier(*std::move(key), *streams_) : io::mavlink::verifier()) {}

signature_check::answer signature_check::judge(const io::mavlink::frame_view& frame, std::uint64_t time_us) {
  const auto now = io::mavlink::signing_time_at(static_cast<std::int64_t>(time_us) * 1'000);
  const auto which = verifier_.judge(frame, now);
  const auto* const why = cause_of(which);
  if (why == nullptr)
    return {};
  if (verifier_.counts().of(which) != 1)
    return {false, {}};
  return {false, "refused " + message_name(frame.id()) + " of " + std::to_string(frame.system()) + '/' +
                     std::to_string(frame.component()) + ": " + std::string(why->why) +
                     " (further ones are only counted)"};
}

std::vector<skipped> signature_check::refused() const {
  std::vector<skipped> result;
  if (verifier_.has_key())
    for (const auto& each : causes)
      result.push_back({each.key, each.words, verifier_.counts().of(each.which)});
  return result;
}

} // namespace godwit::trace_tool
