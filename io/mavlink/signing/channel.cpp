#include "io/mavlink/signing/channel.hpp"

#include <algorithm>

#include "io/mavlink/ids.hpp"

namespace godwit::io::mavlink {

namespace {

secret_key copy_of(const secret_key& key) { return secret_key(key.bytes()); }

std::string sentence_for(verdict why) {
  switch (why) {
  case verdict::bad_signature:
    return "a frame is signed with another key, or was changed on the way";
  case verdict::replayed:
    return "a signed frame came again, or out of order";
  case verdict::too_old:
    return "a new sender signs with a clock that is more than 60 s behind ours";
  case verdict::too_new:
    return "a sender signs with a clock that is more than 10 min ahead of ours";
  case verdict::unsigned_refused:
    return "a frame is not signed, and this link takes signed ones only";
  case verdict::too_many_streams:
    return "more senders sign on this link than can be followed";
  case verdict::accepted_signed:
  case verdict::accepted_unsigned:
    break;
  }
  return {};
}

struct cause {
  const char* name;
  std::uint64_t scan_counters::*count;
};

constexpr cause causes[] = {
    {"bad_crc", &scan_counters::bad_crc},           {"unknown_id", &scan_counters::unknown_id},
    {"unknown_flag", &scan_counters::unknown_flag}, {"v1_frame", &scan_counters::v1_frames},
    {"cut_off", &scan_counters::cut_off},           {"garbage_byte", &scan_counters::garbage_bytes}};

// What says that bytes were damaged; the other causes are frames of somebody who speaks otherwise.
std::uint64_t damage(const scan_counters& c) { return c.bad_crc + c.unknown_flag + c.cut_off; }

} // namespace

channel::channel(const signing_settings& signing, signing_time ceiling)
    : key_(signing.key), security_(signing.security), replays_(signing.replays) {
  if (!key_)
    return;
  signer_.emplace(copy_of(*key_), signing.link, ceiling);
  verifier_ = verifier(copy_of(*key_), *replays_, signing.unsigned_frames);
}

scanner& channel::scanner_of(link::peer_id peer, instant now) {
  auto found = peers_.find(peer);
  if (found == peers_.end()) {
    if (peers_.size() >= max_scanned_peers) {
      const auto oldest = std::min_element(peers_.begin(), peers_.end(), [](const auto& a, const auto& b) {
        return a.second.last_ns < b.second.last_ns;
      });
      forgotten_errors_ += damage(oldest->second.scan->counters());
      peers_.erase(oldest);
    }
    found = peers_.emplace(peer, peer_entry{std::make_unique<scanner>(), now.monotonic_ns}).first;
  }
  found->second.last_ns = now.monotonic_ns;
  return *found->second.scan;
}

bool channel::is_believed(const frame_view& frame, instant now) {
  const auto ours = signer_ ? signer_->clock().now(now.wall_ns) : signing_time_at(now.wall_ns);
  const auto verdict = verifier_.judge(frame, ours);
  if (!is_accepted(verdict)) {
    last_rejection_ = sentence_for(verdict);
    return false;
  }
  ++frames_in_;
  return true;
}

std::optional<frame_buffer> channel::pack_as_said(std::uint32_t id, byte_view payload, sender who,
                                                  std::int64_t wall_ns) {
  const auto* const known = find_message(id);
  if (known == nullptr || payload.empty() || payload.size() > max_payload_size)
    return std::nullopt;
  auto& sequence = sequence_of(who);
  frame_buffer frame(id, known->crc_extra, payload, who, sequence, signer_.has_value());
  if (signer_ && !signer_->sign(frame, wall_ns))
    return std::nullopt;
  ++sequence;
  ++frames_out_;
  return frame;
}

std::optional<signing_time> channel::wanted_reservation(std::int64_t wall_ns) {
  return signer_ ? signer_->clock().wanted_reservation(wall_ns) : std::nullopt;
}

void channel::reserved(signing_time ceiling) {
  if (signer_)
    signer_->clock().reserved(ceiling);
}

std::uint64_t channel::v1_frames() const {
  std::uint64_t result = 0;
  for (const auto& [peer, each] : peers_)
    result += each.scan->counters().v1_frames;
  return result;
}

std::uint8_t& channel::sequence_of(sender who) {
  const auto found = std::find_if(speakers_.begin(), speakers_.end(), [&](const speaker& s) { return s.who == who; });
  if (found != speakers_.end())
    return found->next;
  if (speakers_.size() == max_numbered_speakers)
    speakers_.erase(speakers_.begin());
  return speakers_.emplace_back(speaker{who, 0}).next;
}

std::uint8_t channel::next_sequence(sender who) const {
  const auto found = std::find_if(speakers_.begin(), speakers_.end(), [&](const speaker& s) { return s.who == who; });
  return found == speakers_.end() ? std::uint8_t{0} : found->next;
}

channel_report channel::report(std::optional<sender> followed, link::peer_id from) const {
  channel_report result;
  result.is_signing = is_signing();
  result.frames_in = frames_in_;
  result.frames_out = frames_out_;
  result.parse_errors_total = forgotten_errors_;
  for (const auto& [name, count] : causes)
    result.parse_errors.push_back({name, 0});
  std::vector<std::uint64_t> kinds(known_id_count);
  for (const auto& [peer, each] : peers_) {
    const auto& seen = each.scan->counters();
    result.parse_errors_total += damage(seen);
    for (std::size_t i = 0; i < std::size(causes); ++i)
      result.parse_errors[i].count += seen.*causes[i].count;
    for (std::size_t i = 0; i < kinds.size(); ++i)
      kinds[i] += seen.kinds[i].bad_crc;
    for (const auto& who : each.scan->senders().all())
      if (followed && who.who == *followed && (from == link::every_peer || from == peer)) {
        result.followed_in += who.received;
        result.sequence_gaps += who.lost;
        result.last_sequence = who.last_sequence;
      }
  }
  for (const auto& info : known_ids())
    if (const auto count = kinds[slot_of(info)]; count != 0)
      result.kind_errors.push_back({std::string(info.name), count});
  result.signed_in = verifier_.counts().of(verdict::accepted_signed);
  result.signing_rejected = rejected();
  for (const auto& [why, name] : enum_names(verdict{}))
    if (!is_accepted(why))
      result.signing_errors.push_back({std::string(name), verifier_.counts().of(why)});
  return result;
}

} // namespace godwit::io::mavlink
