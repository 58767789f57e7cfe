#include "programs/godwit-eyes/look/look.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>

#include "programs/godwit-eyes/detection/classifier.hpp"
#include "programs/godwit-eyes/look/drawing.hpp"
#include "programs/godwit-eyes/look/look_files.hpp"

namespace godwit::eyes {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t ns_in_s = 1'000'000'000;

// Nothing that is there is written over.
tl::expected<void, std::string> make_folder(const std::string& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed)
    return tl::make_unexpected(folder + " can not be made: " + failed.message());
  const bool is_empty = fs::is_empty(folder, failed);
  if (failed)
    return tl::make_unexpected(folder + " can not be read: " + failed.message());
  if (!is_empty)
    return tl::make_unexpected(folder + " is not empty: name another folder, or empty it");
  return {};
}

void keep(std::vector<double>& in, double value) {
  if (in.size() < look_summary::max_values)
    in.push_back(value);
}

class looking {
public:
  looking(const look_settings& wanted, const std::shared_ptr<classifier>& asked)
      : wanted_(wanted), reader_(wanted.from), detector_(detector_settings{}, asked) {}

  tl::expected<look_summary, std::string> run() {
    if (auto opened = tables_.open(wanted_.boxes, wanted_.use); !opened)
      return tl::make_unexpected(std::move(opened.error()));
    auto seen = read();
    if (auto closed = tables_.close(); seen && !closed)
      return tl::make_unexpected(std::move(closed.error()));
    return seen;
  }

private:
  tl::expected<look_summary, std::string> read() {
    while (const auto picture = reader_.next()) {
      const auto at_ns = time_of(*picture);
      const auto at_s = static_cast<double>(at_ns) / ns_in_s;
      if (at_s < wanted_.begin_s)
        continue;
      if (wanted_.seconds > 0 && at_s > wanted_.begin_s + wanted_.seconds)
        return sum_;
      if (auto looked = look(*picture, at_ns); !looked)
        return tl::make_unexpected(std::move(looked.error()));
    }
    if (sum_.pictures == 0)
      return tl::make_unexpected(reader_.problem().empty() ? "there is no picture in it" : reader_.problem());
    sum_.ended_early = reader_.problem();
    return sum_;
  }

  // Since the beginning; a recording is read faster than it was made.
  std::int64_t time_of(const io::video::frame& picture) {
    const auto stands_at = picture.stream_ns >= 0 ? picture.stream_ns : picture.captured_ns;
    if (!first_ns_)
      first_ns_ = stands_at;
    last_ns_ = std::max(stands_at - *first_ns_, last_ns_ + 1);
    return last_ns_;
  }

  tl::expected<void, std::string> look(const io::video::frame& picture, std::int64_t at_ns) {
    const frame_view frame = view_of(picture, at_ns + ns_in_s); // the detector takes a time of 0 for none
    const auto seen = detector_.look(frame, std::nullopt);
    ways_.add(seen);
    const picture_label label{sum_.pictures + 1, static_cast<double>(at_ns) / ns_in_s};
    add(seen, frame, label);
    tables_.add(label.number, seen);
    const bool is_due = (label.number - 1) % static_cast<std::uint64_t>(wanted_.every) == 0;
    if (wanted_.folder.empty() || !is_due || sum_.drawn >= wanted_.most_drawn)
      return {};
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "/picture-%06llu.png", static_cast<unsigned long long>(label.number));
    ++sum_.drawn;
    return write_png(wanted_.folder + name.data(), drawn(frame, seen, ways_, label));
  }

  void add(const verdict& seen, const frame_view& frame, const picture_label& label) {
    if (++sum_.pictures == 1)
      sum_.begin_s = label.at_s;
    sum_.end_s = label.at_s;
    sum_.width = frame.width;
    sum_.height = frame.height;
    ++sum_.reasons[static_cast<std::size_t>(seen.why)];
    keep(sum_.milliseconds, static_cast<double>(seen.figures.microseconds) * 1e-3);
    if (seen.figures.homography) {
      keep(sum_.residuals_px, seen.figures.residual_px);
      keep(sum_.corner_shifts_px, seen.figures.corner_shift_px);
    }
    for (const auto& each : seen.confirmed) {
      const bool is_new = !sum_.tracks.contains(each.track);
      if (is_new && sum_.tracks.size() >= look_summary::max_tracks)
        continue;
      auto& track = sum_.tracks[each.track];
      if (is_new)
        track.first_s = label.at_s;
      track.last_s = label.at_s;
      ++track.pictures;
      track.size_px = std::max({track.size_px, each.box.width_px, each.box.height_px});
      track.speed_px_s = each.speed_px_s;
      track.confidence = std::max(track.confidence, each.confidence);
      track.looks_like = each.looks_like;
    }
  }

  const look_settings& wanted_;
  picture_reader reader_;
  detector detector_;
  trails ways_;
  boxes_file tables_;
  look_summary sum_;
  std::optional<std::int64_t> first_ns_;
  std::int64_t last_ns_ = -1;
};

} // namespace

tl::expected<look_summary, std::string> look_through(const look_settings& wanted) {
  use_one_thread();
  if (!wanted.folder.empty())
    if (auto made = make_folder(wanted.folder); !made)
      return tl::make_unexpected(std::move(made.error()));
  std::shared_ptr<classifier> asked;
  if (!wanted.model.empty()) {
    auto made = io::eyes::read_model(wanted.model).and_then(classifier::make);
    if (!made)
      return tl::make_unexpected("the model can not be used: " + made.error());
    asked = *std::move(made);
  }
  return looking(wanted, asked).run();
}

} // namespace godwit::eyes
