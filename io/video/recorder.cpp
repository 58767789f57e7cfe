#include "io/video/recorder.hpp"

#include <algorithm>
#include <array>
#include <ctime>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include <gst/app/gstappsrc.h>
#include <gst/gst.h>

#include "io/video/gst_owned.hpp"

namespace godwit::io::video {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t ns_in_s = 1'000'000'000;
constexpr std::int64_t retry_ns = 10 * ns_in_s;
constexpr std::uint64_t max_waiting_bytes = 8 * 1024 * 1024; // of pictures that the disk has not taken
constexpr GstClockTime finish_limit = 1 * GST_SECOND;
constexpr std::string_view name_begins = "godwit-eyes-";

std::string utc_text() {
  const auto now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y%m%dT%H%M%SZ", &parts)};
}

// The oldest go first until no more than MAX are left; what is left.
std::uint64_t keep_within(const std::string& folder, std::uint64_t max) {
  std::vector<std::pair<std::string, std::uint64_t>> all;
  std::error_code failed;
  std::uint64_t sum = 0;
  for (const auto& each : fs::directory_iterator(folder, failed)) {
    if (!each.path().filename().string().starts_with(name_begins) || each.path().extension() != ".mkv")
      continue;
    std::error_code unreadable;
    const auto size = each.file_size(unreadable);
    all.emplace_back(each.path().string(), unreadable ? 0 : size);
    sum += all.back().second;
  }
  std::ranges::sort(all); // names begin with the time
  for (const auto& [path, size] : all) {
    if (sum <= max)
      break;
    if (fs::remove(path, failed))
      sum -= size;
  }
  return sum;
}

// One file.
class segment {
public:
  segment(const std::string& path, std::int64_t first_ns, std::int32_t width, std::int32_t height)
      : first_ns_(first_ns), width_(width), height_(height) {
    gst_init(nullptr, nullptr); // once in the process, however often it is said
    GError* failure = nullptr;
    whole_.reset(gst_parse_launch("appsrc name=in format=time is-live=true ! matroskamux ! "
                                  "filesink name=out buffer-mode=unbuffered sync=false",
                                  &failure));
    const owned<GError> why(failure);
    if (!whole_ || why) {
      error_ = "GStreamer can not write Matroska (the package gstreamer1.0-plugins-good)";
      return;
    }
    in_.reset(gst_bin_get_by_name(GST_BIN(whole_.get()), "in"));
    bus_.reset(gst_element_get_bus(whole_.get()));
    const owned<GstElement> out(gst_bin_get_by_name(GST_BIN(whole_.get()), "out"));
    g_object_set(out.get(), "location", path.c_str(), nullptr);
    auto* const caps = gst_caps_new_simple("image/jpeg", "width", G_TYPE_INT, width, "height", G_TYPE_INT, height,
                                           "framerate", GST_TYPE_FRACTION, 0, 1, nullptr);
    g_object_set(in_.get(), "caps", caps, nullptr);
    gst_caps_unref(caps);
    if (gst_element_set_state(whole_.get(), GST_STATE_PLAYING) == GST_STATE_CHANGE_FAILURE)
      look();
  }
  ~segment() {
    if (!whole_)
      return;
    if (error_.empty() && in_) {
      gst_app_src_end_of_stream(GST_APP_SRC(in_.get()));
      const owned<GstMessage> done(gst_bus_timed_pop_filtered(
          bus_.get(), finish_limit, static_cast<GstMessageType>(GST_MESSAGE_EOS | GST_MESSAGE_ERROR)));
    }
    gst_element_set_state(whole_.get(), GST_STATE_NULL);
  }
  segment(const segment&) = delete;
  segment& operator=(const segment&) = delete;

  [[nodiscard]] const std::string& error() const { return error_; }
  [[nodiscard]] std::int64_t first_ns() const { return first_ns_; }
  [[nodiscard]] bool has_size(std::int32_t width, std::int32_t height) const {
    return width == width_ && height == height_;
  }

  // False: the disk is too slow.
  [[nodiscard]] bool add(std::span<const std::byte> jpeg, std::int64_t captured_ns) {
    look();
    if (!error_.empty())
      return true;
    auto* const source = GST_APP_SRC(in_.get());
    if (gst_app_src_get_current_level_bytes(source) > max_waiting_bytes)
      return false;
    auto* const buffer = gst_buffer_new_memdup(jpeg.data(), jpeg.size());
    GST_BUFFER_PTS(buffer) = static_cast<GstClockTime>(std::max<std::int64_t>(0, captured_ns - first_ns_));
    if (gst_app_src_push_buffer(source, buffer) != GST_FLOW_OK)
      look();
    return true;
  }

private:
  void look() {
    const owned<GstMessage> said(gst_bus_pop_filtered(bus_.get(), GST_MESSAGE_ERROR));
    if (!said)
      return;
    GError* failure = nullptr;
    gst_message_parse_error(said.get(), &failure, nullptr);
    const owned<GError> why(failure);
    error_ = why ? why->message : "GStreamer failed without a reason";
  }

  const std::int64_t first_ns_;
  const std::int32_t width_;
  const std::int32_t height_;
  owned<GstElement> whole_;
  owned<GstElement> in_;
  owned<GstBus> bus_;
  std::string error_;
};

} // namespace

struct recorder::parts {
  recorder_settings wanted;
  recorder_report now;
  std::unique_ptr<segment> open;
  std::int64_t not_before_ns = 0;

  void begin(std::int64_t at_ns, std::int32_t width, std::int32_t height) {
    open.reset();
    std::error_code failed;
    fs::create_directories(wanted.folder, failed);
    std::array<char, 16> number{};
    std::snprintf(number.data(), number.size(), "-%04u.mkv", static_cast<unsigned>(now.segments % 10'000));
    const auto path = wanted.folder + '/' + std::string(name_begins) + utc_text() + number.data();
    now.bytes = keep_within(wanted.folder, wanted.max_bytes);
    open = std::make_unique<segment>(path, at_ns, width, height);
    ++now.segments;
  }

  void look(std::int64_t at_ns) {
    now.error = open->error();
    if (now.error.empty())
      return;
    now.error = "the pictures can not be recorded in " + wanted.folder + ": " + now.error;
    open.reset();
    not_before_ns = at_ns + retry_ns;
  }
};

recorder::recorder(recorder_settings wanted) : parts_(std::make_unique<parts>()) { parts_->wanted = std::move(wanted); }

recorder::~recorder() = default;

void recorder::add(std::span<const std::byte> jpeg, std::int64_t captured_ns, std::int32_t width, std::int32_t height) {
  auto& all = *parts_;
  if (captured_ns < all.not_before_ns)
    return;
  const auto most_ns = std::chrono::nanoseconds(all.wanted.segment).count();
  if (!all.open || captured_ns - all.open->first_ns() >= most_ns || !all.open->has_size(width, height))
    all.begin(captured_ns, width, height);
  if (!all.open->add(jpeg, captured_ns))
    ++all.now.dropped;
  all.look(captured_ns);
}

const recorder_report& recorder::report() const { return parts_->now; }

} // namespace godwit::io::video
