#include "tests/peers/mavlink/write_ours.hpp"

#include <fstream>

#include "io/mavlink/signing/signer.hpp"
#include "tests/peers/mavlink/field_text.hpp"
#include "tests/peers/mavlink/field_values.hpp"
#include "tests/peers/mavlink/peer_messages.hpp"

namespace godwit::io::mavlink::peers {

namespace {

constexpr std::size_t random_frames = 25; // of each message, and as many signed ones
constexpr std::array senders{sender{1, 1}, sender{255, 190}, sender{42, 0}, sender{254, 255}};

class frame_writer {
public:
  frame_writer(const std::filesystem::path& folder, std::uint64_t seed)
      : frames_(folder / "frames.bin", std::ios::binary), right_(folder / "frames.jsonl"),
        changed_(folder / "changed.jsonl"), random_(seed), signer_(test_key(), link_id{7}, signing_time{}) {
    for (auto* file : {&frames_, &right_, &changed_})
      file->exceptions(std::ios::failbit | std::ios::badbit);
  }

  template <message M>
  void write_all(signing sign) {
    for (const auto& each : byte_patterns)
      write(patterned<M>(each), sign);
    for (std::size_t i = 0; i < random_frames; ++i)
      write(randomised<M>(random_), sign);
  }

private:
  template <message M>
  void write(const M& message, signing sign) {
    const sender from = senders[random_() % senders.size()];
    const std::uint8_t sequence = next_sequence_++;
    auto frame = encode(message, from, sequence, sign);
    described_frame description{std::string(type_name<M>()),
                                {{"id", text_of(M::message_id)},
                                 {"sequence", text_of(sequence)},
                                 {"system", text_of(from.system)},
                                 {"component", text_of(from.component)},
                                 {"signature", "none"}},
                                texts_of(message)};
    if (sign == signing::on) {
      const auto time = signer_.sign(frame, signing_ns).value();
      description.frame["signature"] = "right";
      description.frame["link"] = text_of(static_cast<std::uint8_t>(signer_.link()));
      description.frame["time"] = text_of(units(time));
    }
    put(frame.span(), description);
  }

  void put(byte_view frame, described_frame description) {
    frames_.write(reinterpret_cast<const char*>(frame.data()), static_cast<std::streamsize>(frame.size()));
    right_ << to_line(description);
    if (!is_changed_ && description.message == "SYS_STATUS") {
      description.fields["voltage_battery"] = "changed";
      is_changed_ = true;
    }
    changed_ << to_line(description);
  }

  std::ofstream frames_;
  std::ofstream right_;
  std::ofstream changed_;
  std::mt19937_64 random_;
  signer signer_;
  std::uint8_t next_sequence_ = 0;
  bool is_changed_ = false;
};

} // namespace

void write_ours(const std::filesystem::path& folder, std::uint64_t seed) {
  std::filesystem::create_directories(folder);
  frame_writer writer(folder, seed);
  for_each_message([&]<message M>() {
    writer.write_all<M>(signing::off);
    writer.write_all<M>(signing::on);
  });
}

} // namespace godwit::io::mavlink::peers
