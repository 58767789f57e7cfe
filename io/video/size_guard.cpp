#include "io/video/size_guard.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/video/gst_owned.hpp"

namespace godwit::io::video {
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
