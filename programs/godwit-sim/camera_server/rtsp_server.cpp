#include "programs/godwit-sim/camera_server/rtsp_server.hpp"

#include <atomic>
#include <mutex>
#include <thread>
#include <utility>

#include <gst/app/gstappsrc.h>
#include <gst/gst.h>
#include <gst/rtsp-server/rtsp-server.h>

namespace godwit::sim {
namespace {

struct unref {
  template <class T>
  void operator()(T* each) const {
    g_object_unref(each);
  }
};
template <class T>
using owned = std::unique_ptr<T, unref>;

constexpr std::uint8_t no_colour = 128;

std::string launch_of(const camera_place& where) {
  return "( appsrc name=source is-live=true format=time do-timestamp=true max-bytes=4000000 "
         "caps=video/x-raw,format=I420,width=" +
         std::to_string(where.width) + ",height=" + std::to_string(where.height) +
         ",framerate=" + std::to_string(where.fps) + "/1 ! jpegenc quality=85 ! rtpjpegpay name=pay0 )";
}

} // namespace

struct rtsp_server::parts {
  camera_place where;
  GMainContext* context = nullptr;
  GMainLoop* loop = nullptr;
  owned<GstRTSPServer> server;
  std::uint16_t port = 0;
  std::thread thread;

  std::mutex mutex;
  owned<GstElement> source; // of the media that is played; all clients share it
  std::atomic<bool> is_cut{false};

  static void configured(GstRTSPMediaFactory* /*factory*/, GstRTSPMedia* media, gpointer data) {
    auto* const self = static_cast<parts*>(data);
    const owned<GstElement> whole(gst_rtsp_media_get_element(media));
    const std::lock_guard guard(self->mutex);
    self->source.reset(gst_bin_get_by_name(GST_BIN(whole.get()), "source"));
  }
};

rtsp_server::rtsp_server(std::unique_ptr<parts> made) : parts_(std::move(made)) {}

tl::expected<std::unique_ptr<rtsp_server>, std::string> rtsp_server::open(const camera_place& where) {
  gst_init(nullptr, nullptr); // once in the process, however often it is said
  auto made = std::make_unique<parts>();
  made->where = where;
  made->context = g_main_context_new();
  made->loop = g_main_loop_new(made->context, FALSE);
  made->server.reset(gst_rtsp_server_new());
  gst_rtsp_server_set_address(made->server.get(), where.host.c_str());
  gst_rtsp_server_set_service(made->server.get(), std::to_string(where.port).c_str());
  auto* const factory = gst_rtsp_media_factory_new();
  gst_rtsp_media_factory_set_launch(factory, launch_of(where).c_str());
  gst_rtsp_media_factory_set_shared(factory, TRUE);
  g_signal_connect(factory, "media-configure", G_CALLBACK(parts::configured), made.get());
  const owned<GstRTSPMountPoints> mounts(gst_rtsp_server_get_mount_points(made->server.get()));
  gst_rtsp_mount_points_add_factory(mounts.get(), where.path.c_str(), factory); // has it now
  std::unique_ptr<rtsp_server> result(new rtsp_server(std::move(made)));
  auto& all = *result->parts_;
  if (gst_rtsp_server_attach(all.server.get(), all.context) == 0)
    return tl::make_unexpected("the camera can not be served at " + where.host + ":" + std::to_string(where.port) +
                               ": is the port taken?");
  all.port = static_cast<std::uint16_t>(gst_rtsp_server_get_bound_port(all.server.get()));
  all.thread = std::thread([&all] { g_main_loop_run(all.loop); });
  return result;
}

rtsp_server::~rtsp_server() {
  // From inside of the loop, so that it ends also when it has not begun yet.
  if (parts_->thread.joinable()) {
    g_main_context_invoke(
        parts_->context,
        [](gpointer loop) -> gboolean {
          g_main_loop_quit(static_cast<GMainLoop*>(loop));
          return G_SOURCE_REMOVE;
        },
        parts_->loop);
    parts_->thread.join();
  }
  parts_->source.reset();
  parts_->server.reset();
  g_main_loop_unref(parts_->loop);
  g_main_context_unref(parts_->context);
}

void rtsp_server::push(std::span<const std::uint8_t> grey) {
  const std::lock_guard guard(parts_->mutex);
  if (!parts_->source || parts_->is_cut)
    return;
  auto* const buffer = gst_buffer_new_allocate(nullptr, grey.size() * 3 / 2, nullptr);
  gst_buffer_fill(buffer, 0, grey.data(), grey.size());
  gst_buffer_memset(buffer, grey.size(), no_colour, grey.size() / 2);
  static_cast<void>(gst_app_src_push_buffer(GST_APP_SRC(parts_->source.get()), buffer)); // nobody plays: dropped
}

void rtsp_server::set_cut(bool is_cut) { parts_->is_cut = is_cut; }

std::uint16_t rtsp_server::port() const { return parts_->port; }

} // namespace godwit::sim
