#include "io/video/pipeline.hpp"

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <gst/app/gstappsink.h>
#include <gst/gst.h>
#include <gst/video/video.h>
#include <unistd.h>

#include "io/video/frame.hpp"
#include "io/video/gst_owned.hpp"

namespace godwit::io::video {

namespace {

constexpr int rtsp_latency_ms = 100;

// A picture that GStreamer keeps as long as somebody holds it.
struct mapped_picture {
  owned<GstSample> sample;
  GstVideoFrame video{};
  bool is_mapped = false;
  mapped_picture(owned<GstSample> from, GstVideoInfo* info) : sample(std::move(from)) {
    is_mapped = gst_video_frame_map(&video, info, gst_sample_get_buffer(sample.get()), GST_MAP_READ) == TRUE;
  }
  ~mapped_picture() {
    if (is_mapped)
      gst_video_frame_unmap(&video);
  }
  mapped_picture(const mapped_picture&) = delete;
  mapped_picture& operator=(const mapped_picture&) = delete;
};

std::optional<frame> frame_of(owned<GstSample> sample) {
  GstVideoInfo info{};
  auto* const caps = gst_sample_get_caps(sample.get());
  if (caps == nullptr || gst_video_info_from_caps(&info, caps) == FALSE ||
      GST_VIDEO_INFO_FORMAT(&info) != GST_VIDEO_FORMAT_I420)
    return std::nullopt;
  const auto stream_time = GST_BUFFER_PTS(gst_sample_get_buffer(sample.get()));
  const auto mapped = std::make_shared<mapped_picture>(std::move(sample), &info);
  if (!mapped->is_mapped)
    return std::nullopt;
  frame result;
  result.captured_ns = monotonic_ns();
  if (stream_time != GST_CLOCK_TIME_NONE)
    result.stream_ns = static_cast<std::int64_t>(stream_time);
  result.width = GST_VIDEO_FRAME_WIDTH(&mapped->video);
  result.height = GST_VIDEO_FRAME_HEIGHT(&mapped->video);
  for (std::size_t i = 0; i < result.planes.size(); ++i) {
    const auto number = static_cast<guint>(i);
    result.planes.at(i) = {static_cast<const std::uint8_t*>(GST_VIDEO_FRAME_PLANE_DATA(&mapped->video, number)),
                           static_cast<std::size_t>(GST_VIDEO_FRAME_PLANE_STRIDE(&mapped->video, number))};
  }
  result.owner = mapped;
  return result;
}

std::string size_caps(const camera_uri& from) {
  std::string result = "video/x-raw";
  if (from.width_px != 0)
    result += ",width=" + std::to_string(from.width_px) + ",height=" + std::to_string(from.height_px);
  if (from.frames_per_s != 0)
    result += ",framerate=" + std::to_string(from.frames_per_s) + "/1";
  return result;
}

// Texts of people stand in none of these: they are set as properties.
std::string description_of(const camera_uri& from, bool is_paced) {
  const std::string end =
      " ! videoconvert name=convert ! video/x-raw,format=I420 ! appsink name=sink enable-last-sample=false" +
      std::string(is_paced ? " max-buffers=1 drop=true" : " max-buffers=4 drop=false") +
      (from.kind == camera_kind::file && is_paced ? " sync=true" : " sync=false");
  switch (from.kind) {
  case camera_kind::device:
    return from.width_px == 0 ? "v4l2src name=source ! decodebin" + end
                              : "v4l2src name=source ! decodebin ! videoscale ! videorate ! " + size_caps(from) + end;
  case camera_kind::test:
    return "videotestsrc name=source is-live=true ! capsfilter name=shape caps=" + size_caps(from) + end;
  case camera_kind::network:
  case camera_kind::file:
    break;
  }
  return "uridecodebin name=source" + end;
}

// By TCP: a picture is whole, and no fire wall is in the way. Old pictures are of no use.
void set_up_source(GstElement* /*bin*/, GstElement* made, gpointer /*data*/) {
  if (g_object_class_find_property(G_OBJECT_GET_CLASS(made), "drop-on-latency") == nullptr)
    return; // it is not rtspsrc
  g_object_set(made, "latency", rtsp_latency_ms, "drop-on-latency", TRUE, nullptr);
  gst_util_set_object_arg(G_OBJECT(made), "protocols", "tcp");
}

std::string why_no_device(const std::string& path) {
  if (::access(path.c_str(), F_OK) != 0)
    return "there is no " + path + ": connect the camera, or set camera.uri to the device that it has";
  if (::access(path.c_str(), R_OK | W_OK) != 0)
    return path + " may not be used: " + std::strerror(errno) + "; the user of godwitd has to be in the group video";
  return {};
}

std::string why_no_file(const std::string& uri) {
  const std::unique_ptr<gchar, decltype(&g_free)> decoded(g_filename_from_uri(uri.c_str(), nullptr, nullptr), g_free);
  if (!decoded)
    return uri + " is no address of a file of this computer";
  const std::string path = decoded.get();
  return ::access(path.c_str(), R_OK) == 0 ? std::string() : path + " can not be read: " + std::strerror(errno);
}

std::string sentence_of(const GError& error) {
  std::string text = error.message;
  if (error.domain == GST_RESOURCE_ERROR && error.code == GST_RESOURCE_ERROR_BUSY)
    return "the camera is in use by another program: " + text;
  if (error.domain == GST_RESOURCE_ERROR && error.code == GST_RESOURCE_ERROR_NOT_AUTHORIZED)
    return "the camera wants another name or password: " + text;
  if (error.domain == GST_RESOURCE_ERROR)
    return "the camera can not be reached: is it on, and in this network? GStreamer says: " + text;
  if (error.domain == GST_CORE_ERROR && error.code == GST_CORE_ERROR_MISSING_PLUGIN)
    return "GStreamer has no decoder for these pictures (H.264 and H.265 need the package gstreamer1.0-libav): " + text;
  if (error.domain == GST_STREAM_ERROR && error.code == GST_STREAM_ERROR_CODEC_NOT_FOUND)
    return "GStreamer has no decoder for these pictures (H.264 and H.265 need the package gstreamer1.0-libav): " + text;
  if (error.domain == GST_STREAM_ERROR)
    return "what comes is no video that can be shown: " + text;
  return text;
}

} // namespace

struct pipeline::parts {
  camera_uri from;
  picture_taker on_picture;
  owned<GstElement> whole;
  owned<GstBus> bus;
  std::int64_t taken = 0; // of a test; in the one thread that brings pictures

  void play_test() {
    ++taken;
    if (from.resize_after != 0 && taken == from.resize_after) {
      const owned<GstElement> shape(gst_bin_get_by_name(GST_BIN(whole.get()), "shape"));
      auto smaller = from;
      smaller.width_px = from.width_px / 4 * 2;
      smaller.height_px = from.height_px / 4 * 2;
      gst_util_set_object_arg(G_OBJECT(shape.get()), "caps", size_caps(smaller).c_str());
    }
  }
};

namespace {

// What the callback needs, without the private type.
struct taker {
  std::function<bool(owned<GstSample>)> take;
};

GstFlowReturn take_sample(GstAppSink* sink, gpointer data) {
  owned<GstSample> sample(gst_app_sink_pull_sample(sink));
  if (sample == nullptr)
    return GST_FLOW_EOS;
  return static_cast<taker*>(data)->take(std::move(sample)) ? GST_FLOW_OK : GST_FLOW_ERROR;
}

void forget(gpointer data) { std::unique_ptr<taker>(static_cast<taker*>(data)).reset(); }

void set_properties(const camera_uri& from, GstElement* made) {
  switch (from.kind) {
  case camera_kind::device:
    g_object_set(made, "device", from.where.c_str(), nullptr);
    return;
  case camera_kind::test:
    gst_util_set_object_arg(G_OBJECT(made), "pattern", from.where.c_str());
    if (from.stop_after != 0)
      g_object_set(made, "num-buffers", static_cast<int>(from.stop_after), nullptr);
    return;
  case camera_kind::network:
  case camera_kind::file:
    g_object_set(made, "uri", from.where.c_str(), nullptr);
    g_signal_connect(made, "source-setup", G_CALLBACK(set_up_source), nullptr);
    return;
  }
}

} // namespace

pipeline::pipeline(std::unique_ptr<parts> made) : parts_(std::move(made)) {}

pipeline::~pipeline() { gst_element_set_state(parts_->whole.get(), GST_STATE_NULL); }

tl::expected<std::unique_ptr<pipeline>, std::string> pipeline::make(const camera_uri& from, bool is_paced,
                                                                    picture_taker on_picture) {
  static std::once_flag is_begun; // GStreamer's own state is of the process
  std::call_once(is_begun, [] { gst_init(nullptr, nullptr); });
  auto absent = from.kind == camera_kind::device ? why_no_device(from.where)
                : from.kind == camera_kind::file ? why_no_file(from.where)
                                                 : std::string();
  if (!absent.empty())
    return tl::make_unexpected(std::move(absent));
  GError* failure = nullptr;
  auto made = std::make_unique<parts>();
  made->from = from;
  made->on_picture = std::move(on_picture);
  made->whole.reset(gst_parse_launch(description_of(from, is_paced).c_str(), &failure));
  const owned<GError> why(failure);
  if (!made->whole || why)
    return tl::make_unexpected("GStreamer lacks a part (the packages gstreamer1.0-plugins-base and -good): " +
                               std::string(why ? why->message : "unknown"));
  made->bus.reset(gst_element_get_bus(made->whole.get()));
  const owned<GstElement> begin(gst_bin_get_by_name(GST_BIN(made->whole.get()), "source"));
  set_properties(from, begin.get());
  guard_picture_sizes(made->whole.get());
  const owned<GstElement> sink(gst_bin_get_by_name(GST_BIN(made->whole.get()), "sink"));
  GstAppSinkCallbacks callbacks{};
  callbacks.new_sample = take_sample;
  auto* const state = made.get();
  auto taking = std::make_unique<taker>();
  taking->take = [state](owned<GstSample> sample) {
    state->play_test();
    if (state->from.hang_after != 0 && state->taken > state->from.hang_after)
      return true; // a camera that is there, and says nothing more
    if (auto picture = frame_of(std::move(sample)))
      state->on_picture(*std::move(picture));
    return true;
  };
  gst_app_sink_set_callbacks(GST_APP_SINK(sink.get()), &callbacks, taking.release(), forget);
  return std::unique_ptr<pipeline>(new pipeline(std::move(made)));
}

tl::expected<void, std::string> pipeline::play() {
  if (gst_element_set_state(parts_->whole.get(), GST_STATE_PLAYING) != GST_STATE_CHANGE_FAILURE)
    return {};
  const auto said = wait(std::chrono::milliseconds(0));
  return tl::make_unexpected(said && !said->error.empty() ? said->error : "the camera can not be opened");
}

std::optional<pipeline::news> pipeline::wait(std::chrono::milliseconds most) {
  const auto kinds = static_cast<GstMessageType>(GST_MESSAGE_ERROR | GST_MESSAGE_EOS);
  const owned<GstMessage> said(gst_bus_timed_pop_filtered(
      parts_->bus.get(), static_cast<GstClockTime>(std::chrono::nanoseconds(most).count()), kinds));
  if (!said)
    return std::nullopt;
  if (GST_MESSAGE_TYPE(said.get()) == GST_MESSAGE_EOS)
    return news{true, {}};
  GError* failure = nullptr;
  gst_message_parse_error(said.get(), &failure, nullptr);
  const owned<GError> why(failure);
  return news{false, why ? sentence_of(*why) : "GStreamer failed without a reason"};
}

namespace {

void post_error(GstPad* pad, const std::string& sentence) {
  const owned<GstElement> element(gst_pad_get_parent_element(pad));
  if (element)
    gst_element_message_full(element.get(), GST_MESSAGE_ERROR, GST_STREAM_ERROR, GST_STREAM_ERROR_FORMAT,
                             g_strdup(sentence.c_str()), nullptr, __FILE__, "guard_picture_sizes", __LINE__);
}

// None: they are of no pictures, or of such as are taken.
std::optional<std::string> objection_to(const GstCaps* caps) {
  int width = 0;
  int height = 0;
  const auto* const first = caps == nullptr || gst_caps_is_empty(caps) ? nullptr : gst_caps_get_structure(caps, 0);
  if (first == nullptr || gst_structure_get_int(first, "width", &width) == FALSE ||
      gst_structure_get_int(first, "height", &height) == FALSE)
    return std::nullopt;
  if (width <= max_side_px && height <= max_side_px && std::int64_t{width} * height <= max_area_px)
    return std::nullopt;
  return "its pictures have " + std::to_string(width) + " x " + std::to_string(height) + " pixels; at most " +
         std::to_string(max_side_px) + " on a side and " + std::to_string(max_area_px / 1'000'000) +
         " million in all are taken";
}

// Has no memory for anybody.
GType refusing_pool_type() {
  static const GType type = g_type_register_static_simple(
      GST_TYPE_BUFFER_POOL, "GodwitRefusingPool", sizeof(GstBufferPoolClass),
      [](gpointer its_class, gpointer) {
        static_cast<GstBufferPoolClass*>(its_class)->acquire_buffer =
            [](GstBufferPool*, GstBuffer**, GstBufferPoolAcquireParams*) { return GST_FLOW_ERROR; };
      },
      sizeof(GstBufferPool), nullptr, G_TYPE_FLAG_NONE);
  return type;
}

// Of a decoder, before it allocates: pictures that are too large get no memory, and there is an error.
GstPadProbeReturn refuse_memory(GstPad* pad, GstPadProbeInfo* info, gpointer /*data*/) {
  auto* const query = GST_PAD_PROBE_INFO_QUERY(info);
  if (GST_QUERY_TYPE(query) != GST_QUERY_ALLOCATION)
    return GST_PAD_PROBE_OK;
  GstCaps* caps = nullptr;
  gst_query_parse_allocation(query, &caps, nullptr);
  const auto objection = objection_to(caps);
  if (!objection)
    return GST_PAD_PROBE_OK;
  post_error(pad, *objection);
  auto* const pool = GST_BUFFER_POOL(gst_object_ref_sink(g_object_new(refusing_pool_type(), nullptr)));
  gst_query_add_allocation_pool(query, pool, 1, 0, 0);
  gst_object_unref(pool);
  return GST_PAD_PROBE_HANDLED;
}

// Of the conversion: its own pictures would be as large.
GstPadProbeReturn drop_caps(GstPad* pad, GstPadProbeInfo* info, gpointer /*data*/) {
  auto* const event = GST_PAD_PROBE_INFO_EVENT(info);
  if (GST_EVENT_TYPE(event) != GST_EVENT_CAPS)
    return GST_PAD_PROBE_OK;
  GstCaps* caps = nullptr;
  gst_event_parse_caps(event, &caps);
  const auto objection = objection_to(caps);
  if (!objection)
    return GST_PAD_PROBE_OK;
  post_error(pad, *objection);
  return GST_PAD_PROBE_DROP;
}

void guard_decoder(GstBin* /*whole*/, GstBin* /*part*/, GstElement* added, gpointer /*data*/) {
  const auto* const kind = gst_element_class_get_metadata(GST_ELEMENT_GET_CLASS(added), GST_ELEMENT_METADATA_KLASS);
  if (kind == nullptr || std::string_view(kind).find("Decoder") == std::string_view::npos)
    return;
  const owned<GstPad> source(gst_element_get_static_pad(added, "src"));
  if (source)
    gst_pad_add_probe(source.get(), GST_PAD_PROBE_TYPE_QUERY_DOWNSTREAM, refuse_memory, nullptr, nullptr);
}

} // namespace

void guard_picture_sizes(GstElement* whole) {
  g_signal_connect(whole, "deep-element-added", G_CALLBACK(guard_decoder), nullptr);
  const owned<GstElement> convert(gst_bin_get_by_name(GST_BIN(whole), "convert"));
  const owned<GstPad> entry(convert ? gst_element_get_static_pad(convert.get(), "sink") : nullptr);
  if (entry)
    gst_pad_add_probe(entry.get(), GST_PAD_PROBE_TYPE_EVENT_DOWNSTREAM, drop_caps, nullptr, nullptr);
}

} // namespace godwit::io::video
