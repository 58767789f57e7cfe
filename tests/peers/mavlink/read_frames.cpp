#include "tests/peers/mavlink/read_frames.hpp"

#include "io/mavlink/scanner.hpp"
#include "io/mavlink/signing/verifier.hpp"
#include "tests/peers/mavlink/field_text.hpp"
#include "tests/peers/mavlink/peer_messages.hpp"

namespace godwit::io::mavlink::peers {

namespace {

constexpr std::size_t piece_size = 333; // longer than a frame, and no multiple of anything

std::string text_of_verdict(verdict judged) {
  switch (judged) {
  case verdict::accepted_signed:
    return "right";
  case verdict::accepted_unsigned:
    return "none";
  default:
    return std::string(name_of(judged));
  }
}

texts describe_header(const frame_view& frame, verdict judged) {
  texts result{{"id", text_of(frame.id())},
               {"sequence", text_of(frame.sequence())},
               {"system", text_of(frame.system())},
               {"component", text_of(frame.component())},
               {"signature", text_of_verdict(judged)}};
  if (frame.is_signed()) {
    const auto signature = signature_of(frame);
    result["link"] = text_of(static_cast<std::uint8_t>(signature.link));
    result["time"] = text_of(units(signature.time));
  }
  return result;
}

} // namespace

std::vector<described_frame> read_frames(byte_view bytes) {
  std::vector<described_frame> result;
  scanner frames;
  replay_table streams;
  verifier judge(test_key(), streams, unsigned_policy::accept_all());
  const auto sink = [&](const frame_view& frame) {
    const auto judged = judge.judge(frame, signing_time_at(signing_ns));
    visit_any(frame, [&]<message M>(const M& found) {
      result.push_back({std::string(type_name<M>()), describe_header(frame, judged), texts_of(found)});
    });
  };
  for (; bytes.size() > piece_size; bytes = bytes.subspan(piece_size))
    frames.feed(bytes.first(piece_size), sink);
  frames.feed_datagram(bytes, sink);
  return result;
}

} // namespace godwit::io::mavlink::peers
