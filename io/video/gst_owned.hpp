// What GStreamer hands out, given back when nobody holds it. Thread: as GStreamer's own.
#pragma once

#include <memory>

#include <gst/gst.h>

namespace godwit::io::video {

struct unref {
  void operator()(GstElement* each) const { gst_object_unref(each); }
  void operator()(GstBus* each) const { gst_object_unref(each); }
  void operator()(GstPad* each) const { gst_object_unref(each); }
  void operator()(GstSample* each) const { gst_sample_unref(each); }
  void operator()(GstMessage* each) const { gst_message_unref(each); }
  void operator()(GError* each) const { g_error_free(each); }
};

template <class T>
using owned = std::unique_ptr<T, unref>;

} // namespace godwit::io::video
