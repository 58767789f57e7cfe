// The helper process godwit-eyes in virtual time, whose pictures are empty: it sees what stands within its reach of the
// pose that it was told, and has the vices of the real one.
//
// It starts within start_takes_ns, says how it is each half second, and what it sees ten times a second. Between two
// things that are due nothing happens. One for each process. Thread: one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "actors/movement_detector/eyes_port.hpp"
#include "io/eyes/picture_slot.hpp"
#include "messages/movement_detector/types.hpp"

namespace godwit::drill {

// What may be wrong with eyes, from outside of the process: it outlives it.
struct eyes_faults {
  bool hangs = false; // says nothing more, also when it is started anew
  bool has_no_camera = false;
  bool shows_black = false;
  int starts = 0; // of all
  struct mover {
    std::uint32_t track = 0;
    double latitude_deg = 0;
    double longitude_deg = 0;
  };
  std::vector<mover> movers;
};

class simulated_eyes final : public movement_detector::eyes_port {
public:
  static constexpr std::int64_t never_ns = std::numeric_limits<std::int64_t>::max();
  static constexpr std::int64_t start_takes_ns = 400'000'000;
  static constexpr double reach_m = 40;

  using news = std::variant<movement_detector::helper_status, movement_detector::helper_candidates,
                            movement_detector::helper_ended>;

  // FAULTS outlives it.
  explicit simulated_eyes(eyes_faults& faults) : faults_(faults) {}

  void start(std::uint32_t run, const io::eyes::begin& how) override;
  void end(std::uint32_t upto) override;
  void tell(const io::eyes::pose& where) override { pose_ = where; }
  void keep_picture(std::uint32_t track, std::int64_t captured_ns, const std::string& id) override {
    if (pictures_)
      pictures_(id, {track, captured_ns, 1, 1, {std::byte{0xFF}, std::byte{0xD8}, std::byte{0xFF}, std::byte{0xD9}}});
  }
  using picture_taker = std::function<void(const std::string& sighting_id, io::eyes::cutout what)>;
  void give_pictures(picture_taker to) { pictures_ = std::move(to); }

  // What it has to say by then.
  [[nodiscard]] std::vector<news> on_time(std::int64_t now_ns);
  [[nodiscard]] std::int64_t next_deadline_ns() const { return next_ns_; }
  // As SIGKILL, and as bytes that are no message.
  void kill() { gone_ = "it has gone: it was ended by signal 9"; }
  void talk_garbage() { gone_ = "what it sends can not be read: it does not begin as a message"; }

private:
  [[nodiscard]] movement_detector::helper_status status(std::int64_t now_ns) const;
  [[nodiscard]] movement_detector::helper_candidates candidates(std::int64_t now_ns) const;

  eyes_faults& faults_;
  picture_taker pictures_;
  std::optional<std::uint32_t> run_;
  std::optional<io::eyes::pose> pose_;
  bool is_starting_ = false;
  std::int64_t next_ns_ = never_ns; // 0: as soon as time is known
  int beats_ = 0;
  std::string gone_;
};

} // namespace godwit::drill
