#include "actors/vehicle_link/channel.hpp"

#include <algorithm>

namespace godwit::vehicle_link {

namespace {

mavlink::secret_key copy_of(const mavlink::secret_key& key) { return mavlink::secret_key(key.bytes()); }

std::string sentence_for(mavlink::verdict why) {
  switch (why) {
  case mavlink::verdict::bad_signature:
    return "a frame is signed with another key, or was changed on the way";
  case mavlink::verdict::replayed:
    return "a signed frame came again, or out of order";
  case mavlink::verdict::too_old:
    return "a new sender signs with a clock that is more than 60 s behind ours";
  case mavlink::verdict::too_new:
    return "a sender signs with a clock that is more than 120 s ahead of ours";
  case mavlink::verdict::unsigned_refused:
    return "a frame is not signed, and this link takes signed ones only";
  case mavlink::verdict::too_many_streams:
    return "more senders sign on this link than can be followed";
  case mavlink::verdict::accepted_signed:
  case mavlink::verdict::accepted_unsigned:
    break;
  }
  return {};
}

struct cause {
  const char* name;
  std::uint64_t mavlink::scan_counters::*count;
};

constexpr cause causes[] = {
    {"bad_crc", &mavlink::scan_counters::bad_crc},           {"unknown_id", &mavlink::scan_counters::unknown_id},
    {"unknown_flag", &mavlink::scan_counters::unknown_flag}, {"v1_frame", &mavlink::scan_counters::v1_frames},
    {"cut_off", &mavlink::scan_counters::cut_off},           {"garbage_byte", &mavlink::scan_counters::garbage_bytes}};

// What says that bytes were damaged; the other causes are frames of somebody who speaks otherwise.
std::uint64_t damage(const mavlink::scan_counters& c) { return c.bad_crc + c.unknown_flag + c.cut_off; }

} // namespace

channel::channel(const signing_settings& signing, mavlink::signing_time ceiling)
    : key_(signing.key), security_(signing.security) {
  if (!key_)
    return;
  signer_.emplace(copy_of(*key_), signing.link, ceiling);
  verifier_ = mavlink::verifier(copy_of(*key_), replays_, signing.unsigned_frames);
}

mavlink::scanner& channel::scanner_of(io::link::peer_id peer, instant now) {
  auto found = peers_.find(peer);
  if (found == peers_.end()) {
    if (peers_.size() >= max_scanned_peers) {
      const auto oldest = std::min_element(peers_.begin(), peers_.end(), [](const auto& a, const auto& b) {
        return a.second.last_ns < b.second.last_ns;
      });
      forgotten_errors_ += damage(oldest->second.scanner->counters());
      peers_.erase(oldest);
    }
    found = peers_.emplace(peer, peer_entry{std::make_unique<mavlink::scanner>(), now.monotonic_ns}).first;
  }
  found->second.last_ns = now.monotonic_ns;
  return *found->second.scanner;
}

bool channel::is_believed(const mavlink::frame_view& frame, instant now) {
  const auto ours = signer_ ? signer_->clock().now(now.wall_ns) : mavlink::signing_time_at(now.wall_ns);
  const auto verdict = verifier_.judge(frame, ours);
  if (!mavlink::is_accepted(verdict)) {
    last_rejection_ = sentence_for(verdict);
    return false;
  }
  ++frames_in_;
  return true;
}

std::optional<mavlink::signing_time> channel::wanted_reservation(std::int64_t wall_ns) {
  return signer_ ? signer_->clock().wanted_reservation(wall_ns) : std::nullopt;
}

void channel::reserved(mavlink::signing_time ceiling) {
  if (signer_)
    signer_->clock().reserved(ceiling);
}

std::uint64_t channel::v1_frames() const {
  std::uint64_t result = 0;
  for (const auto& [peer, each] : peers_)
    result += each.scanner->counters().v1_frames;
  return result;
}

void channel::describe(connection& out, std::optional<mavlink::sender> vehicle) const {
  out.tx_seq = tx_sequence_;
  out.signing_enabled = is_signing();
  out.frames_in = frames_in_;
  out.frames_out = frames_out_;
  out.parse_errors_total = forgotten_errors_;
  for (const auto& [name, count] : causes)
    out.parse_errors.push_back({name, 0});
  std::vector<std::uint64_t> kinds(mavlink::known_id_count);
  for (const auto& [peer, each] : peers_) {
    const auto& seen = each.scanner->counters();
    out.parse_errors_total += damage(seen);
    for (std::size_t i = 0; i < std::size(causes); ++i)
      out.parse_errors[i].count += seen.*causes[i].count;
    for (std::size_t i = 0; i < kinds.size(); ++i)
      kinds[i] += seen.kinds[i].bad_crc;
    for (const auto& who : each.scanner->senders().all())
      if (vehicle && who.who == *vehicle) {
        out.sequence_gaps += who.lost;
        out.rx_seq = who.last_sequence;
      }
  }
  for (const auto& info : mavlink::known_ids())
    if (const auto count = kinds[mavlink::slot_of(info)]; count != 0)
      out.kind_errors.push_back({std::string(info.name), count});
  out.signing_rejected = rejected();
  for (const auto& [verdict, name] : enum_names(mavlink::verdict{}))
    if (!mavlink::is_accepted(verdict))
      out.signing_errors.push_back({std::string(name), verifier_.counts().of(verdict)});
}

} // namespace godwit::vehicle_link
